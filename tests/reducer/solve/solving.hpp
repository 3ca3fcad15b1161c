// SPDX-License-Identifier: GPL-3.0-or-later
// Parts written as text, solved in memory: what the tests of statics and supported modes look at.
#pragma once

#include <string>
#include <vector>

#include "reducer/solve/solve.hpp"

namespace tisserand::testing {

/// The part of this text (units m, kg, s unless it says otherwise), read from a file.
formats::Part part_of_text(const std::string& text);

reducer::Solution solved(const formats::Part& part, int modes);
inline reducer::Solution solved(const std::string& text) { return solved(part_of_text(text), 0); }

/// What reading or solving throws.
std::string solve_error(const std::string& text, int modes);

/// Row of Mesh::node_label.
int node_of(const reducer::Solution& solution, const std::string& label);

/// [translation; rotation] of a node in a load case.
Eigen::Matrix<double, 6, 1> motion_of(const reducer::Solution& solution, const std::string& label, int load_case);

}  // namespace tisserand::testing
