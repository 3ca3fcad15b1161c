// SPDX-License-Identifier: GPL-3.0-or-later
// Operations on companions, by identities between their arrays.
#include "formats/companion/operations.hpp"

#include <cmath>

#include "common/error.hpp"
#include "common/math/rotation.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Applies `change` to every existing matrix over coordinates except H.
template <class Change>
void for_each_matrix(Companion& c, const Change& change) {
  if (c.has_second_order()) {
    for (MatrixXd& C : c.C) change(C);
    for (auto* arrays : {&c.E, &c.N, &c.T})
      for (MatrixXd& matrix : *arrays) change(matrix);
    if (c.has_relative_turns())
      for (MatrixXd& W : c.W) change(W);
    for (MatrixXd& Lambda : c.Lambda) change(Lambda);
  }
  for (LoadCase& load : c.load_cases)
    if (load.stiffness.size() > 0) change(load.stiffness);
}

/// Multiplies left and right by diag(row), in place.
void scale_rows(const Eigen::VectorXd& row, MatrixXd& matrix) {
  matrix = (row.asDiagonal() * matrix * row.asDiagonal()).eval();
}

/// Substitutes y_k = row_k y_k' in every index over coordinates.
void scale_coordinates(Companion& c, const Eigen::VectorXd& row) {
  for_each_matrix(c, [&](MatrixXd& matrix) { scale_rows(row, matrix); });
  for (std::size_t j = 0; j < c.H.size(); ++j) {
    scale_rows(row, c.H[j]);
    c.H[j] *= row[static_cast<Index>(j)];
  }
  if (c.S1.cols() > 0) c.S1 = (c.S1 * row.asDiagonal()).eval();
  for (LoadCase& load : c.load_cases)
    if (load.force.size() > 0) load.force = load.force.cwiseProduct(row).eval();
}

}  // namespace

void drop_modes(Companion& c, const MatrixXd& mass, const MatrixXd& R, const std::vector<int>& rows,
                const Eigen::VectorXd& omega_squared) {
  TISSERAND_ENSURE(static_cast<Index>(rows.size()) == omega_squared.size(), "{} rows, {} eigenvalues", rows.size(),
                   omega_squared.size());
  const MatrixXd MR = mass * R;
  std::array<MatrixXd, 3> CR;  // C_kᵀ R_R, n x 3
  if (c.has_second_order())
    for (int k = 0; k < 3; ++k) CR[k] = c.C[k].transpose() * R.rightCols<3>();
  std::vector<bool> dropped(static_cast<std::size_t>(mass.rows()), false);
  for (std::size_t at = 0; at < rows.size(); ++at) {
    const int i = rows[at];
    const double flexibility = 1.0 / omega_squared[at];
    dropped[i] = true;
    for (LoadCase& load : c.load_cases)
      if (load.stiffness.size() > 0 && c.has_second_order()) load.stiffness -= flexibility * load.force[i] * c.H[i];
    if (!c.has_second_order()) continue;
    for (int a = 0; a < 6; ++a) c.N[a] -= flexibility * MR(i, a) * c.H[i];
    for (int pair = 0; pair < 6; ++pair) {
      const auto [j, k] = axis_pairs[pair];
      c.T[pair] -= 0.5 * flexibility * (CR[k](i, j) + CR[j](i, k)) * c.H[i];
    }
  }
  std::vector<int> kept;
  for (int i = 0; i < mass.rows(); ++i)
    if (!dropped[i]) kept.push_back(i);
  for_each_matrix(c, [&](MatrixXd& matrix) { matrix = MatrixXd(matrix(kept, kept)); });
  std::vector<MatrixXd> H;
  for (const int j : kept)
    if (c.has_second_order()) H.push_back(c.H[j](kept, kept));
  c.H = std::move(H);
  if (c.S1.cols() > 0) c.S1 = Eigen::Matrix3Xd(c.S1(Eigen::all, kept));
  for (LoadCase& load : c.load_cases)
    if (load.force.size() > 0) load.force = Eigen::VectorXd(load.force(kept));
}

void galilean_step(Companion& c, const MatrixXd& mass, const MatrixXd& R) {
  const MatrixXd momentum = mass * R.leftCols<3>() / c.mass;
  std::array<MatrixXd, 3> P, d;  // 3 x n each
  for (int k = 0; k < 3; ++k) {
    P[k] = R.leftCols<3>().transpose() * c.C[k];
    d[k] = skew<double>(Vector3d::Unit(k)) * c.S1 - P[k];
    c.C[k] += momentum * d[k];
  }
  for (int pair = 0; pair < 6; ++pair) {
    const auto [j, k] = axis_pairs[pair];
    const MatrixXd X = P[j].transpose() * d[k] + d[j].transpose() * P[k] + d[j].transpose() * d[k];
    c.E[pair] += 0.5 / c.mass * (X + X.transpose());
  }
}

void move_reference(Companion& c, const Vector3d& point) {
  const Vector3d d = point - c.reference_point;
  c.reference_point = point;
  c.S0 -= c.mass * d;
  std::array<Vector3d, 3> arm;  // e_j × d
  for (int j = 0; j < 3; ++j) arm[j] = Vector3d::Unit(j).cross(d);
  // D_Aᵀ M [e_k x] w₂ = Σ_b ε_akb N_b with a = arm: (arm × e_k) . (N_1, N_2, N_3).
  for (int pair = 0; pair < 6; ++pair) {
    const auto [j, k] = axis_pairs[pair];
    const Vector3d turned = 0.5 * (arm[j].cross(Vector3d::Unit(k)) + arm[k].cross(Vector3d::Unit(j)));
    for (int b = 0; b < 3; ++b) c.T[pair] -= turned[b] * c.N[b];
  }
  for (int j = 0; j < 3; ++j)
    for (int a = 0; a < 3; ++a) c.N[3 + j] -= arm[j][a] * c.N[a];
}

void congruence(Companion& c, const MatrixXd& A) {
  const Index n = A.rows(), kept = A.cols();
  for_each_matrix(c, [&](MatrixXd& matrix) { matrix = (A.transpose() * matrix * A).eval(); });
  std::vector<MatrixXd> turned;
  for (const MatrixXd& H : c.H) turned.emplace_back(A.transpose() * H * A);
  std::vector<MatrixXd> mixed(c.H.empty() ? 0 : static_cast<std::size_t>(kept), MatrixXd::Zero(kept, kept));
  for (Index j = 0; j < static_cast<Index>(mixed.size()); ++j)
    for (Index i = 0; i < n; ++i)
      if (A(i, j) != 0.0) mixed[j] += A(i, j) * turned[i];
  c.H = std::move(mixed);
  if (c.S1.cols() > 0) c.S1 = (c.S1 * A).eval();
  for (LoadCase& load : c.load_cases)
    if (load.force.size() > 0) load.force = (A.transpose() * load.force).eval();
}

void mirror(Companion& c, const Vector3d& axes, const Superelement& image) {
  const Vector3d axial = axes.prod() * axes;
  Eigen::VectorXd sign = Eigen::VectorXd::Ones(image.size());
  for (Index row = 0; row < image.size(); ++row) {
    const int component = image.dof_component[row];
    if (image.dof_node[row] >= 0) sign[row] = component < 3 ? axes[component] : axial[component - 3];
  }
  scale_coordinates(c, sign);
  for (int k = 0; k < 3; ++k) {
    c.C[k] *= axial[k];
    c.N[k] *= axes[k];
    c.N[3 + k] *= axial[k];
    c.W[k] *= axial[k];
  }
  for (int pair = 0; pair < 6; ++pair) {
    const auto [j, k] = axis_pairs[pair];
    c.E[pair] *= axial[j] * axial[k];
    c.T[pair] *= axial[j] * axial[k];
  }
  c.reference_point = c.reference_point.cwiseProduct(axes).eval();
  c.S0 = c.S0.cwiseProduct(axes).eval();
  c.S1 = (axes.asDiagonal() * c.S1).eval();
  c.content_id = image.content_id;
}

void convert(Companion& c, const UnitConversion& units, const std::vector<bool>& translation) {
  Eigen::VectorXd row(static_cast<Index>(translation.size()));
  for (Index k = 0; k < row.size(); ++k) row[k] = translation[k] ? 1.0 / units.length : 1.0;
  scale_coordinates(c, row);
  const double moment = units.mass * units.length, inertia = moment * units.length;
  const double energy = inertia / (units.time * units.time);
  c.reference_point *= units.length;
  c.mass *= units.mass;
  c.S0 *= moment;
  c.S1 *= moment;
  for (MatrixXd& H : c.H) H *= energy;
  for (MatrixXd& Lambda : c.Lambda) Lambda *= std::sqrt(energy);
  for (MatrixXd& C : c.C) C *= inertia;
  for (MatrixXd& W : c.W) W *= inertia;
  for (int i = 0; i < 6; ++i) {
    c.E[i] *= inertia;
    c.N[i] *= i < 3 ? moment : inertia;
    c.T[i] *= inertia;
  }
  for (LoadCase& load : c.load_cases) {
    load.force *= energy;
    load.stiffness *= energy;
  }
}

}  // namespace tisserand::formats
