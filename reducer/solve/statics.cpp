// SPDX-License-Identifier: GPL-3.0-or-later
// Solution of the static equations, and refinement.
#include "reducer/solve/statics.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "common/error.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// |A| |X| with the magnitudes of both.
MatrixXd multiply_magnitudes(const SymmetricRows& A, const MatrixXd& X) {
  MatrixXd Y = MatrixXd::Zero(X.rows(), X.cols());
  for (Index c = 0; c < X.cols(); ++c)
    for (int i = 0; i < A.size; ++i)
      for (int k = A.begin[i]; k < A.begin[i + 1]; ++k) {
        const int j = A.column[k];
        const double a = std::abs(A.value[k]);
        Y(i, c) += a * std::abs(X(j, c));
        if (j != i) Y(j, c) += a * std::abs(X(i, c));
      }
  return Y;
}

/// Componentwise backward error of each column (Oettli and Prager).
Eigen::VectorXd backward_error(const Matrix& S, const MatrixXd& u, const MatrixXd& f, const MatrixXd& residual) {
  const MatrixXd size = multiply_magnitudes(symmetric_rows(S), u) + f.cwiseAbs();
  Eigen::VectorXd error = Eigen::VectorXd::Zero(f.cols());
  for (Index c = 0; c < f.cols(); ++c)
    for (Index i = 0; i < f.rows(); ++i)
      if (size(i, c) > 0.0) error[c] = std::max(error[c], std::abs(residual(i, c)) / size(i, c));
  return error;
}

void check_balanced(const Mesh& mesh, const System& system, const LoadVectors& loads) {
  constexpr double balanced = 1e-8;
  const MatrixXd R = rigid_motions_about(system, system.middle);
  for (Index c = 0; c < loads.q.cols(); ++c) {
    const Eigen::Matrix<double, 6, 1> rest = R.transpose() * loads.q.col(c);
    const double force = rest.head<3>().norm(), moment = rest.tail<3>().norm();
    if (force + moment / system.length <= balanced * loads.size[c]) continue;
    const MeshLoadCase& load = mesh.load_cases[c];
    throw Error(fmt::format("the part has no supports, and load case '{}' is not in equilibrium: its resultant is a "
                            "force of {:.6g} and a moment of {:.6g} about the middle, which is {:.1e} of its forces",
                            load.name, force, moment, (force + moment / system.length) / loads.size[c]),
                load.where, "add supports, or use loads in equilibrium");
  }
}

void take_out_mean_motion(const System& system, MatrixXd& q) {
  const bool has_mass = (system.R.transpose() * system.MR).llt().info() == Eigen::Success;
  const MatrixXd& MR = has_mass ? system.MR : system.R;
  q -= system.R * (system.R.transpose() * MR).ldlt().solve(MR.transpose() * q);
}

}  // namespace

Statics statics(const Supported& s, const LoadVectors& loads) {
  const System& system = s.system;
  if (s.is_free) check_balanced(s.mesh, system, loads);
  constexpr int most_steps = 5;
  const MatrixXd f = rows(loads.q, s.partition.internal);
  Statics result;
  MatrixXd u = s.factor.solve(f), r = f - multiply(s.S, u);
  result.residual = backward_error(s.S, u, f, r);
  for (int step = 0; step < most_steps && result.residual.size() > 0; ++step) {
    const MatrixXd better = u + s.factor.solve(r), left = f - multiply(s.S, better);
    const Eigen::VectorXd error = backward_error(s.S, better, f, left);
    if (!(error.maxCoeff() < 0.5 * result.residual.maxCoeff())) break;
    u = better;
    r = left;
    result.residual = error;
  }
  if (!u.allFinite())
    throw Error("the displacements are not finite numbers", s.where,
                "check the loads and the materials: their numbers are too large");
  result.q.setZero(system.size(), f.cols());
  result.q(s.partition.internal, Eigen::all) = u;
  const MatrixXd Sq = multiply(symmetric_rows(system.matrices, system.matrices.S), result.q);
  result.reaction = rows(Sq - loads.q, s.partition.boundary);
  result.energy = 0.5 * (result.q.array() * Sq.array()).colwise().sum().transpose();
  if (s.is_free) take_out_mean_motion(system, result.q);
  return result;
}

}  // namespace tisserand::reducer
