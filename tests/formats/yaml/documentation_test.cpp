// SPDX-License-Identifier: GPL-3.0-or-later
// The Python snippets of SUPERELEMENT.md, COMPANION.md and RESULTS.md, run as they stand there.
#include <cstdlib>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/text.hpp"
#include "formats/companion/companion.hpp"
#include "formats/results/results.hpp"
#include "formats/superelement/superelement.hpp"
#include "tests/support/results_rows.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::formats::documentation_test {
namespace {

using test_support::TemporaryFolder;
using test_support::text_of;

std::string snippet(const std::string& page) {
  const std::string text = text_of(std::string(TISSERAND_SOURCE_DIR) + "/formats/" + page);
  const std::string open = "```python\n";
  const std::size_t begin = text.find(open) + open.size();
  return text.substr(begin, text.find("```", begin) - begin);
}

/// Exit code of the snippet, run in the folder by the Python that has Debian's h5py.
int run(const std::string& code, const TemporaryFolder& folder, const std::string& arguments) {
  write_text_file(folder.file("snippet.py"), code);
  const std::string command =
      "cd " + folder.path().string() + " && /usr/bin/python3 snippet.py " + arguments + " > out.txt 2>&1";
  return std::system(command.c_str());
}

bool has_h5py() { return std::system("/usr/bin/python3 -c 'import h5py' > /dev/null 2>&1") == 0; }

TEST(Documentation, PythonWritesASuperelement) {
  if (!has_h5py()) GTEST_SKIP() << "python3-h5py is not installed";
  const TemporaryFolder folder;
  ASSERT_EQ(run(snippet("SUPERELEMENT.md"), folder, ""), 0) << text_of(folder.file("out.txt"));
  const LoadedSuperelement loaded = read_superelement(folder.file("tetrahedron.superelement.h5"));
  EXPECT_THAT(loaded.report.warnings, ::testing::IsEmpty());
  EXPECT_DOUBLE_EQ(loaded.report.rigid.mass, 2.0);
  EXPECT_EQ(loaded.superelement.units.length.label, "m");
}

// After the lines of SUPERELEMENT.md, as the page says.
TEST(Documentation, PythonWritesACompanion) {
  if (!has_h5py()) GTEST_SKIP() << "python3-h5py is not installed";
  const TemporaryFolder folder;
  ASSERT_EQ(run(snippet("SUPERELEMENT.md") + snippet("COMPANION.md"), folder, ""), 0)
      << text_of(folder.file("out.txt"));
  const LoadedSuperelement loaded = read_superelement(folder.file("tetrahedron.superelement.h5"));
  const Companion companion = read_companion(folder.file("tetrahedron.companion.h5"), loaded.superelement);
  EXPECT_DOUBLE_EQ(companion.mass, 2.0);
  // Node b, at (1, 0, 0), moved by 1 along x: its springs to a, c, d carry 1e6 (1, 1/√2, 1/√2), over their lengths 1e6
  // (1, 1/2, 1/2), and hold b along y with the part of that across each, 1, 1/2, 1; all that a has of it is the first.
  const int bx = 3, by = 4, ay = 1;
  EXPECT_NEAR(companion.H[bx](by, by), 1e6 * (1.0 + 0.25 + 0.5), 1e-3);
  EXPECT_NEAR(companion.H[bx](ay, by), -1e6, 1e-3);
  EXPECT_DOUBLE_EQ(companion.C[2](by, bx), 0.5);  // half a kilogram at b: e_z x e_x = e_y
}

TEST(Documentation, PythonReadsResults) {
  if (!has_h5py()) GTEST_SKIP() << "python3-h5py is not installed";
  const TemporaryFolder folder;
  const ResultsLayout layout = test_support::example_layout();
  ResultsWriter writer(folder.file("run.results.h5"), layout);
  ResultsRow row;
  row.resize(layout);
  test_support::fill_row(0, row);
  writer.append(row);
  writer.finish(true, "", R"({"steps": 1})");
  ASSERT_EQ(run(snippet("RESULTS.md"), folder, "run.results.h5"), 0) << text_of(folder.file("out.txt"));
  // Values 3, 4, 5 of the first row (test_support::row_value).
  EXPECT_EQ(text_of(folder.file("out.txt")), "example completed\nunit m rows 1\n0.001 3.25 4.25 5.25\n{'steps': 1}\n");
}

TEST(Documentation, PythonReadsARunningFile) {
  if (!has_h5py()) GTEST_SKIP() << "python3-h5py is not installed";
  const TemporaryFolder folder;
  const ResultsLayout layout = test_support::example_layout();
  ResultsWriter writer(folder.file("run.results.h5"), layout);
  const std::string code = "import h5py\nprint(h5py.File('run.results.h5.part', 'r', swmr=True)['time'].shape)\n";
  ASSERT_EQ(run(code, folder, ""), 0) << text_of(folder.file("out.txt"));
  EXPECT_EQ(text_of(folder.file("out.txt")), "(0,)\n");
}

}  // namespace
}  // namespace tisserand::formats::documentation_test
