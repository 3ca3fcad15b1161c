// SPDX-License-Identifier: GPL-3.0-or-later
// Superelements whose boundary nodes lie on a line: their axes, and what holds their rotation about them.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// Axis of a superelement whose nodes lie on a line, from one end to the other. The end nodes have rotations.
struct Axis {
  int first = 0, last = 0;    ///< indices of the end nodes in the body
  double span = 0.0;          ///< length between the ends
  Eigen::Vector3d direction;  ///< unit vector from first to last, in axes of the body
};

/// Axis of a body, through its two most distant nodes. Absent if there is only one node, if an end has no rotations, or
/// if nodes are off the line.
std::optional<Axis> axis_of(const SuperelementBody& body);

/// Entry of a stiffness or mass matrix for rotations of two nodes about the axis: e·A e. A is the 3 x 3 block of
/// `matrix` for the rotations of `a` and `b`, and e is the direction of the axis.
double along(const Eigen::MatrixXd& matrix, const SuperelementNode& a, const SuperelementNode& b, const Axis& axis);

/// Rotation of nodes about the axes of their superelements: what is welded together, and what is held.
struct Twist {
  std::vector<int> place;  ///< per node: number that all nodes welded to it share
  /// Per number in `place`: whether an element other than a weld acts on this rotation.
  std::vector<bool> held;
};
/// Finds welded and held rotations at an evaluated state.
Twist twist_of(const Model& model, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
