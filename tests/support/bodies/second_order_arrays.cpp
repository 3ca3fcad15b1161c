// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays of the second order by their definitions, dense.
#include "tests/support/bodies/second_order_arrays.hpp"

#include <algorithm>

#include <Eigen/Cholesky>

#include "common/math/rotation.hpp"

namespace tisserand::test_support {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// [e_k x] on the translations, and the rotations, of every node.
MatrixXd crossed(int k, const MatrixXd& columns) {
  MatrixXd result(columns.rows(), columns.cols());
  for (Index node = 0; node < columns.rows() / 3; ++node)
    result.middleRows<3>(3 * node) = skew<double>(Vector3d::Unit(k)) * columns.middleRows<3>(3 * node);
  return result;
}

MatrixXd rigid_vectors(const FullModel& model, const Vector3d& origin) {
  MatrixXd D(model.S.rows(), 6);
  for (Index node = 0; node < model.position.rows(); ++node) {
    const Index row = model.components * node;
    D.middleRows<3>(row) << Matrix3d::Identity(), -skew<double>(model.position.row(node).transpose() - origin);
    if (model.components == 6) D.middleRows<3>(row + 3) << Matrix3d::Zero(), Matrix3d::Identity();
  }
  return D;
}

/// K_II⁻¹ g − Φ_I Λ⁻¹ Φ_Iᵀ g, zero at the boundary.
VectorXd residual_flexibility(const FullModel& model, const std::vector<int>& internal, const MatrixXd& modes,
                              const VectorXd& omega_squared, const VectorXd& g) {
  const MatrixXd S_II = model.S(internal, internal);
  const VectorXd g_I = g(internal);
  const MatrixXd Phi_I = modes(internal, Eigen::all);
  VectorXd w = VectorXd::Zero(g.size());
  w(internal) = S_II.ldlt().solve(g_I) - Phi_I * omega_squared.cwiseInverse().asDiagonal() * (Phi_I.transpose() * g_I);
  return w;
}

std::vector<int> internal_rows(const FullModel& model, const std::vector<Keep>& keep) {
  std::vector<int> internal;
  for (std::size_t node = 0; node < keep.size(); ++node)
    for (int c = 0; c < model.components; ++c)
      if (keep[node] == Keep::nothing) internal.push_back(model.components * static_cast<int>(node) + c);
  return internal;
}

}  // namespace

SecondOrderBody second_order_by_definition(const FullModel& model, const GeometricStiffness& geometric_stiffness,
                                           const std::vector<Keep>& keep, int modes, const VectorXd& weights) {
  SecondOrderBody body;
  body.element = craig_bampton(model, keep, modes);
  body.element.content_id = formats::content_id(body.element);
  body.omega_squared = body.element.stiffness.diagonal().tail(modes);
  const std::vector<int> internal = internal_rows(model, keep);

  formats::Companion& c = body.companion;
  c.content_id = body.element.content_id;
  c.producer = "test";
  c.units = body.element.units;
  c.weights = weights;
  c.reference_point = body.element.node_position.transpose() * weights;
  const MatrixXd Phi = craig_bampton_basis(model, keep, modes), D = rigid_vectors(model, c.reference_point);
  const MatrixXd &M = model.M, MD = M * D;
  const auto reduced = [&](const MatrixXd& K) -> MatrixXd {
    const MatrixXd A = Phi.transpose() * K * Phi;
    return 0.5 * (A + A.transpose());
  };
  c.mass = MD.col(0).dot(D.col(0));
  for (int k = 0; k < 3; ++k)  // D_Tᵀ M D_R = −[S0 x], whose entry (k + 1, k + 2) is S0_k
    c.S0[k] = D.col((k + 1) % 3).dot(MD.col(3 + (k + 2) % 3));
  c.S1 = MD.leftCols<3>().transpose() * Phi;
  for (Index j = 0; j < Phi.cols(); ++j) c.H.push_back(reduced(geometric_stiffness(Phi.col(j))));
  for (int k = 0; k < 3; ++k) c.C[k] = Phi.transpose() * M * crossed(k, Phi);
  const auto second_order = [&](const VectorXd& g) -> MatrixXd {
    return -reduced(
        geometric_stiffness(residual_flexibility(model, internal, Phi.rightCols(modes), body.omega_squared, g)));
  };
  for (int i = 0; i < 6; ++i) {
    const auto [j, k] = formats::axis_pairs[i];
    const MatrixXd E = crossed(j, Phi).transpose() * M * crossed(k, Phi);
    c.E[i] = 0.5 * (E + E.transpose());
    c.N[i] = second_order(MD.col(i));
    c.T[i] = second_order(-0.5 * (crossed(k, MD.col(3 + j)) + crossed(j, MD.col(3 + k))));
  }
  const VectorXd load = VectorXd::LinSpaced(M.rows(), 0.1, 0.1 * static_cast<double>(M.rows()));
  c.load_cases.push_back({"push", Phi.transpose() * load, second_order(load)});
  return body;
}

void add_load_case(const FullModel& model, const GeometricStiffness& geometric_stiffness, const std::vector<Keep>& keep,
                   const std::string& name, const VectorXd& load, SecondOrderBody& body) {
  const Index modes = body.omega_squared.size();
  const MatrixXd Phi = craig_bampton_basis(model, keep, static_cast<int>(modes));
  const VectorXd w =
      residual_flexibility(model, internal_rows(model, keep), Phi.rightCols(modes), body.omega_squared, load);
  const MatrixXd K = -Phi.transpose() * geometric_stiffness(w) * Phi;
  std::vector<formats::LoadCase>& cases = body.companion.load_cases;
  cases.push_back({name, Phi.transpose() * load, 0.5 * (K + K.transpose())});
  std::ranges::sort(cases, {}, &formats::LoadCase::name);
}

}  // namespace tisserand::test_support
