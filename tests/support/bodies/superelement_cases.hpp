// SPDX-License-Identifier: GPL-3.0-or-later
// States of superelement bodies and their residuals, for the tests of the superelement body.
#pragma once

#include <array>
#include <numeric>
#include <random>
#include <vector>

#include <Eigen/Core>

#include "mechanism/bodies/superelement/evaluate.hpp"
#include "mechanism/frames/motion.hpp"

namespace tisserand::test_support {

/// Nodes and internal coordinates of one body at one instant.
struct BodyState {
  std::vector<mechanism::NodeMotion> nodes;
  Eigen::VectorXd y, yd, ydd;
  Eigen::Matrix3d R0_reference = Eigen::Matrix3d::Identity();
};

Eigen::Vector3d random_vector(std::mt19937& random, double size);

Eigen::VectorXd random_vector_n(std::mt19937& random, Eigen::Index n, double size);

/// The nodes as the body numbers them.
template <class Node>
mechanism::NodeView<Node> in_order(const std::vector<Node>& nodes) {
  static constexpr std::array<int, 100> index = [] {
    std::array<int, 100> numbers{};
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
  }();
  return {nodes.data(), index.data()};
}

/// A random pose with deformations of relative size `deformation` and rates of order 1.
BodyState random_state(const mechanism::SuperelementBody& body, unsigned seed, double deformation);

/// update_kinematics() and residual() in one go.
void evaluate(const mechanism::SuperelementBody& body, const BodyState& state, const Eigen::Vector3d& gravity,
              mechanism::SuperelementScratch& scratch);

/// (r_B, r_I) of a state.
Eigen::VectorXd residual_vector(const mechanism::SuperelementBody& body, const BodyState& state,
                                const Eigen::Vector3d& gravity);

/// |a − b| / |b| in the largest component.
double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace tisserand::test_support
