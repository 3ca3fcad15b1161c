// SPDX-License-Identifier: GPL-3.0-or-later
// Forms of faces as a table of text.
#pragma once

#include <string>
#include <vector>

#include "reducer/survey/survey.hpp"

namespace tisserand::reducer {

/// Text of a point, such as "[1, 2.5, 0]", with four digits and zero for round-off.
std::string point_text(const Eigen::Vector3d& x);

/// Text table with one row per face: form, side, radius, normal or axis, and a point of the axis (apex of a cone,
/// centre of a sphere or torus). It is empty without faces.
std::string form_table(const std::vector<SurveyedFace>& faces, const std::string& title, const Units& units);

}  // namespace tisserand::reducer
