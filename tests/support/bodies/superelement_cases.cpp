// SPDX-License-Identifier: GPL-3.0-or-later
// Random states of superelement bodies and their residuals.
#include "tests/support/bodies/superelement_cases.hpp"

#include "common/math/rotation.hpp"

namespace tisserand::test_support {

Eigen::Vector3d random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  const double x = uniform(random), y = uniform(random), z = uniform(random);
  return {x, y, z};
}

Eigen::VectorXd random_vector_n(std::mt19937& random, Eigen::Index n, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  Eigen::VectorXd v(n);
  for (Eigen::Index i = 0; i < n; ++i) v[i] = uniform(random);
  return v;
}

BodyState random_state(const mechanism::SuperelementBody& body, unsigned seed, double deformation) {
  std::mt19937 random(seed);
  const Eigen::Matrix3d R = exp_so3<double>(random_vector(random, 2.0));
  const Eigen::Vector3d c = random_vector(random, 3.0);
  BodyState state;
  state.R0_reference = R;
  for (const mechanism::SuperelementNode& node : body.node) {
    mechanism::NodeMotion motion;
    motion.x = c + R * (node.X + random_vector(random, deformation));
    motion.R = R * exp_so3<double>(random_vector(random, deformation));
    motion.xd = random_vector(random, 1.0);
    motion.Omega = random_vector(random, 1.0);
    motion.xdd = random_vector(random, 1.0);
    motion.Omegad = random_vector(random, 1.0);
    state.nodes.push_back(motion);
  }
  state.y = random_vector_n(random, body.modes, deformation);
  state.yd = random_vector_n(random, body.modes, 1.0);
  state.ydd = random_vector_n(random, body.modes, 1.0);
  return state;
}

void evaluate(const mechanism::SuperelementBody& body, const BodyState& state, const Eigen::Vector3d& gravity,
              mechanism::SuperelementScratch& scratch) {
  mechanism::update_kinematics(body, in_order(state.nodes), state.y.data(), state.yd.data(), state.ydd.data(),
                               state.R0_reference, scratch);
  mechanism::residual(body, scratch, gravity);
}

Eigen::VectorXd residual_vector(const mechanism::SuperelementBody& body, const BodyState& state,
                                const Eigen::Vector3d& gravity) {
  mechanism::SuperelementScratch scratch = mechanism::make_scratch(body);
  evaluate(body, state, gravity, scratch);
  Eigen::VectorXd r(body.boundary_size + body.modes);
  r << scratch.forces.r_B, scratch.forces.r_I;
  return r;
}

double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

}  // namespace tisserand::test_support
