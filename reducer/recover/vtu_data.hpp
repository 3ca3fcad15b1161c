// SPDX-License-Identifier: GPL-3.0-or-later
// Recovered fields of one instant as arrays of a VTU file.
#pragma once

#include <vector>

#include "formats/vtk/vtu.hpp"
#include "reducer/recover/instant_values.hpp"

namespace tisserand::reducer {

std::vector<formats::VtuArray> vtu_cell_data(const formats::Recovery& recovery, const RecoveredFields& fields,
                                             const InstantValues& values, Eigen::Index instant);

/// Arrays of the nodes for a VTU file at one instant. `axes`: axes of the displacements in the file.
std::vector<formats::VtuArray> vtu_point_data(const formats::Recovery& recovery, const RecoveredFields& fields,
                                              const InstantValues& values, const Eigen::Matrix3d& axes,
                                              Eigen::Index instant);

}  // namespace tisserand::reducer
