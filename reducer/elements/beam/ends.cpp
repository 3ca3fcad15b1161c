// SPDX-License-Identifier: GPL-3.0-or-later
// Condensation of released coordinates, and transformation along rigid arms.
#include "reducer/elements/beam/ends.hpp"

#include <vector>

#include <Eigen/Eigenvalues>

#include "common/math/rotation.hpp"

namespace tisserand::reducer {

Released release(std::uint16_t released, const Matrix12& stiffness) {
  std::vector<int> r;
  for (int k = 0; k < 12; ++k)
    if ((released >> k & 1) != 0 && stiffness(k, k) > 0.0) r.push_back(k);
  Released result;
  for (int k = 0; k < 12; ++k)
    if ((released >> k & 1) != 0) result.T(k, k) = 0.0;
  if (r.empty()) return result;
  const Eigen::VectorXd scale = stiffness(r, r).diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd S_rr = scale.asDiagonal() * stiffness(r, r) * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(S_rr);
  Eigen::VectorXd inverse = solver.eigenvalues();
  for (double& value : inverse) {
    const bool resists = value > 1e-10;
    result.loose += resists ? 0 : 1;
    value = resists ? 1.0 / value : 0.0;
  }
  const Eigen::MatrixXd S_rr_inverse = scale.asDiagonal() * solver.eigenvectors() * inverse.asDiagonal() *
                                       solver.eigenvectors().transpose() * scale.asDiagonal();
  const Eigen::Matrix<double, Eigen::Dynamic, 12> S_r = stiffness(r, Eigen::all);
  result.T(r, Eigen::all) -= S_rr_inverse * S_r * result.T;
  return result;
}

int release_ends(std::uint16_t released, BeamMatrices& matrices) {
  const auto [T, loose] = release(released, matrices.stiffness);
  matrices.stiffness = (T.transpose() * matrices.stiffness * T).eval();
  matrices.mass = (T.transpose() * matrices.mass * T).eval();
  return loose;
}

void move_to_nodes(const Eigen::Vector3d& first_arm, const Eigen::Vector3d& second_arm, Matrix12& matrix) {
  Matrix12 T = Matrix12::Identity();
  T.block<3, 3>(0, 3) = -skew<double>(first_arm);
  T.block<3, 3>(6, 9) = -skew<double>(second_arm);
  const Matrix12 moved = T.transpose() * matrix * T;
  matrix = 0.5 * (moved + moved.transpose());
}

}  // namespace tisserand::reducer
