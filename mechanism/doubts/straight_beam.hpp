// Superelements whose boundary nodes stand on a line: their axes, and what holds their turning about them.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// The line through the nodes of a body, from one end to the other; the ends have rotations.
struct Axis {
  int first = 0, last = 0;
  double span = 0.0;
  Eigen::Vector3d direction;  ///< axes of the body
};

/// None where nodes stand beside the line between the two that are farthest from one another, or where one is alone.
std::optional<Axis> axis_of(const SuperelementBody& body);

/// Sum of e·S e, e·M e of the turns of two nodes about the axis.
double along(const Eigen::MatrixXd& matrix, const SuperelementNode& a, const SuperelementNode& b, const Axis& axis);

/// The turning of nodes about the axes of the superelements that they are on.
struct Twist {
  std::vector<int> place;  ///< per node: one number for all that are welded together
  std::vector<bool> held;  ///< per place: something else than a weld works on that turning
};
/// After evaluate().
Twist twist_of(const Model& model, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
