// SPDX-License-Identifier: GPL-3.0-or-later
// Superelements whose boundary nodes lie on a line: their axes, and what holds their rotation about them.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// Line through the nodes of a body, from one end to the other. The ends have rotations.
struct Axis {
  int first = 0, last = 0;
  double span = 0.0;
  Eigen::Vector3d direction;  ///< in axes of the body
};

/// Axis of a body; none if nodes are off the line between the two most distant ones, or if there is one node.
std::optional<Axis> axis_of(const SuperelementBody& body);

/// Sum of e·S e or e·M e over the rotations of two nodes about the axis.
double along(const Eigen::MatrixXd& matrix, const SuperelementNode& a, const SuperelementNode& b, const Axis& axis);

/// Rotation of nodes about the axes of their superelements.
struct Twist {
  std::vector<int> place;  ///< per node: a common number for all that are welded together
  std::vector<bool> held;  ///< per place: an element other than a weld acts on this rotation
};
/// Twist at an evaluated state.
Twist twist_of(const Model& model, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
