// SPDX-License-Identifier: GPL-3.0-or-later
// A superelement and the arrays of its companion from full matrices and a geometric stiffness, by the definitions of
// COMPANION.md.
#pragma once

#include <functional>
#include <string>
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

/// Adds a load case from its forces on all coordinates of the model; `body`: of the same model, `keep` as there.
void add_load_case(const FullModel& model, const GeometricStiffness& geometric_stiffness, const std::vector<Keep>& keep,
                   const std::string& name, const Eigen::VectorXd& load, SecondOrderBody& body);

}  // namespace tisserand::test_support
