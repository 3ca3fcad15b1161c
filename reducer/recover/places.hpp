// SPDX-License-Identifier: GPL-3.0-or-later
// Places in a part: texts for reports, elements and stress points around nodes.
#pragma once

#include <string>
#include <vector>

#include "formats/recovery/recovery.hpp"

namespace tisserand::reducer {

/// Relative difference up to which two stresses count as equal. Stresses at symmetric places differ by round-off only;
/// the first of them is reported.
inline constexpr float equal_by_symmetry = 2e-6f;

/// Name of an element for reports, such as "shell 17 of 'skin'".
std::string element_text(const formats::Recovery& recovery, int element);

/// Mean position of the nodes of an element, in the part frame and in units of the recovery file.
Eigen::Vector3d element_middle(const formats::Recovery& recovery, int element);

/// Stress points at the nodes of each solid, in the order of the nodes. Those of element e are `point`[`first`[e]] to
/// `point`[`first`[e + 1] − 1].
struct SolidPoints {
  std::vector<int> first, point;
};
SolidPoints solid_points(const formats::Recovery& recovery);

/// Finds the node with the boundary name or label `point`, or the node nearest to `point` = "x,y,z" [units of the
/// recovery file]. Throws Error with similar names of boundary nodes if there is none. `where`: place for the message.
int find_node(const formats::Recovery& recovery, const std::string& point, const std::string& where);

}  // namespace tisserand::reducer
