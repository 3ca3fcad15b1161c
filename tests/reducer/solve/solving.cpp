// SPDX-License-Identifier: GPL-3.0-or-later
// Files of the tests live as long as a call.
#include "tests/reducer/solve/solving.hpp"

#include <algorithm>

#include "common/text.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::testing {

formats::Part part_of_text(const std::string& text) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.file("part.yaml");
  write_text_file(path, text);
  return formats::read_part(path, {});
}

reducer::Solution solved(const formats::Part& part, int modes) {
  start_solvers();
  return reducer::solve(part, {modes, {}}, [](const std::string&) {});
}

std::string solve_error(const std::string& text, int modes) {
  return test_support::error_of([&] { solved(part_of_text(text), modes); });
}

int node_of(const reducer::Solution& s, const std::string& label) {
  const auto found = std::ranges::find(s.mesh.node_label, label);
  if (found == s.mesh.node_label.end()) throw Error("no node '" + label + "'", "test", "");
  return static_cast<int>(found - s.mesh.node_label.begin());
}

Eigen::Matrix<double, 6, 1> motion_of(const reducer::Solution& s, const std::string& label, int load_case) {
  return reducer::node_motions(s.system, s.statics.q.col(load_case)).middleRows<6>(6 * node_of(s, label));
}

}  // namespace tisserand::testing
