// SPDX-License-Identifier: GPL-3.0-or-later
// Rotation of a shell element as a whole.
#pragma once

#include "reducer/elements/shell/geometry.hpp"

namespace tisserand::reducer {

using ShellTurn = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Rotation of the mean plane of the middle surface for the coordinates of the nodes, both in part axes (3 x (6
/// corners)). `offset`: height of the middle surface above the nodes. A rigid rotation gives itself.
template <int Corners>
ShellTurn shell_turn(const ShellGeometry<Corners>& geometry, double offset);

}  // namespace tisserand::reducer
