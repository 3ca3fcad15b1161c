// A superelement and the arrays of its companion from full matrices and a geometric stiffness, by the definitions of
// COMPANION.md.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "formats/companion/companion.hpp"
#include "tests/support/bodies/reduced_frames.hpp"

namespace tisserand::test_support {

struct SecondOrderBody {
  formats::Superelement element;
  formats::Companion companion;
  Eigen::VectorXd omega_squared;  ///< of its internal coordinates
};

/// K_G of the stress of a displacement of all coordinates of the model.
using GeometricStiffness = std::function<Eigen::MatrixXd(const Eigen::VectorXd&)>;

/// Dense. `weights`: of the boundary nodes, sum 1. A load case "push" has the full vector 0.1, 0.2, ... and its second
/// order.
SecondOrderBody second_order_by_definition(const FullModel& model, const GeometricStiffness& geometric_stiffness,
                                           const std::vector<Keep>& keep, int modes, const Eigen::VectorXd& weights);

}  // namespace tisserand::test_support
