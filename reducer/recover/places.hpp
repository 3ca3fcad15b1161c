// Where in a part something is: texts for reports, elements and stress points around nodes.
#pragma once

#include <string>
#include <vector>

#include "formats/recovery/recovery.hpp"

namespace tisserand::reducer {

/// Relative difference up to which two stresses count as equal. Stresses at symmetric places differ by round-off alone;
/// the first of them is then named.
inline constexpr float equal_by_symmetry = 2e-6f;

/// "shell 17 of 'skin'".
std::string element_text(const formats::Recovery& recovery, int element);

/// Mean of the nodes of an element, part frame, units of the recovery file.
Eigen::Vector3d element_middle(const formats::Recovery& recovery, int element);

/// Stress points of the nodes of each solid, in its order: (elements + 1) offsets and points; nothing for others.
struct SolidPoints {
  std::vector<int> first, point;
};
SolidPoints solid_points(const formats::Recovery& recovery);

/// A node by its label, by the name of a boundary node, or nearest to "x,y,z" [units of the recovery file]. Throws
/// Error with the nearest labels.
int find_node(const formats::Recovery& recovery, const std::string& point, const std::string& where);

}  // namespace tisserand::reducer
