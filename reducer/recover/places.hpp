// SPDX-License-Identifier: GPL-3.0-or-later
// Places in a part: texts for reports, elements and stress points around nodes.
#pragma once

#include <string>
#include <vector>

#include "formats/recovery/recovery.hpp"

namespace tisserand::reducer {

/// Relative difference up to which two stresses count as equal. Stresses at symmetric places differ by round-off only,
/// and the first one is named.
inline constexpr float equal_by_symmetry = 2e-6f;

/// Name of an element: "shell 17 of 'skin'".
std::string element_text(const formats::Recovery& recovery, int element);

/// Mean of the nodes of an element, part frame, units of the recovery file.
Eigen::Vector3d element_middle(const formats::Recovery& recovery, int element);

/// Stress points of the nodes of each solid, in its order: (elements + 1) offsets, and points.
struct SolidPoints {
  std::vector<int> first, point;
};
SolidPoints solid_points(const formats::Recovery& recovery);

/// Node with a label, with the name of a boundary node, or nearest to "x,y,z" [units of the recovery file]. Throws
/// Error with the nearest labels.
int find_node(const formats::Recovery& recovery, const std::string& point, const std::string& where);

}  // namespace tisserand::reducer
