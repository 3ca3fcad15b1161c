// SPDX-License-Identifier: GPL-3.0-or-later
// Shared folders in which somebody has put links in the places of temporary files, and names that are commands.
#include <filesystem>

#include "common/child.hpp"
#include "tests/cli/scenes.hpp"

namespace tisserand::cli::planted_links_test {
namespace {

namespace fs = std::filesystem;

class PlantedLinks : public Folder {
 protected:
  PlantedLinks() {
    fs::create_directory(file("shared"));
    write_text(file("victim"), "precious");
  }
  /// The command, when its own process number, which temporary files bear, is that of a link to the victim.
  Outcome planted(const std::string& link, std::vector<std::string> words) const {
    words.insert(words.begin(), {"/bin/sh", "-c",
                                 "ln -s ../victim \"shared/$1.tmp-$$-$2\" && shift 2 && exec \"$@\"", "sh", link, "0"});
    return call(words, where);
  }
};

// The trial: the file behind the link was overwritten where the kernel does not protect links.
TEST_F(PlantedLinks, AreNotFollowed) {
  ASSERT_EQ(mechanism({"run", "arm.scene.yaml", "-o", "arm.results.h5"}).code, 0);
  const std::string program_file = program("mechanism");
  struct Case {
    const char* link;
    std::vector<std::string> words;
  };
  std::vector<Case> cases{
      {"a.csv", {program_file, "export", "arm.results.h5", "-c", "energy", "-o", "shared/a.csv"}},
      {"a.html", {program_file, "view", "arm.results.h5", "-o", "shared/a.html"}},
      {"a.results.h5.part", {program_file, "run", "arm.scene.yaml", "-o", "shared/a.results.h5"}}};
  if (is_program("gnuplot"))
    cases.push_back({"a.png", {program_file, "plot", "arm.results.h5", "-c", "energy/total", "-o", "shared/a.png"}});
  if (fs::exists(program("reducer"))) {
    fs::copy_file(TISSERAND_SOURCE_DIR "/tests/verification/references/trials/stress_cantilever.part.yaml",
                  file("bar.part.yaml"));
    const std::vector<std::string> reduce{program("reducer"), "run", "bar.part.yaml", "-o",
                                          "shared/bar.superelement.h5"};
    cases.push_back({"bar.recovery.h5", reduce});
    cases.push_back({"a.msh", {program("reducer"), "mesh", "bar.part.yaml", "-o", "shared/a.msh"}});
  }
  for (const auto& [link, words] : cases) {
    const Outcome outcome = planted(link, words);
    EXPECT_EQ(read_text(file("victim")), "precious") << link;
    expect_error(outcome, {"cannot create the file", "File exists"});
    EXPECT_FALSE(fs::exists(fs::path(file("shared")) / link)) << link;
  }
}

// gnuplot takes "|command" for a pipe. `reducer groups` draws by it, as `mechanism plot` does.
TEST_F(PlantedLinks, NamesOfPicturesOfFacesAreNoCommands) {
  if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
  if (!is_program("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  const std::string name = "|touch EXECUTED;'.png";
  const Outcome drawn =
      call({program("reducer"), "groups", TISSERAND_SOURCE_DIR "/meshes/square.step", "-o", name}, where);
  EXPECT_EQ(drawn.code, 0) << drawn.error;
  EXPECT_TRUE(fs::exists(file(name)));
  EXPECT_FALSE(fs::exists(file("EXECUTED")));
}

}  // namespace
}  // namespace tisserand::cli::planted_links_test
