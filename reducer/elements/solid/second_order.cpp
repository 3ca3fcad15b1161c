// SPDX-License-Identifier: GPL-3.0-or-later
// Second-order strain of solid elements: Green's strain at the points of the stiffness, with stresses that include the
// incompatible displacements.
//
// V3 = ∫ σ(w) : ½ ∇dᵀ ∇d dV, so K_G,ab = (∫ ∇N_a · σ ∇N_b dV) 1. Incompatible displacements contribute to σ but not to
// ∇d: nodal forces are ∫ Bᵀ σ with the gradients of the nodes alone. So a rigid rotation adds no energy.
#include <Eigen/Cholesky>

#include "reducer/elements/second_order.hpp"
#include "reducer/elements/solid/gradients.hpp"

namespace tisserand::reducer {
namespace {

/// Amplitudes of all functions from the nodes: 1, and −S_aa⁻¹ S_au for the incompatible ones.
template <int Functions, int Nodes>
Eigen::MatrixXd follow(const Eigen::Matrix<double, 3 * Functions, 3 * Functions>& S) {
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(3 * Functions, 3 * Nodes);
  if constexpr (Functions > Nodes) {
    constexpr int modes = 3 * (Functions - Nodes);
    const Eigen::Matrix<double, modes, modes> S_aa = S.template bottomRightCorner<modes, modes>();
    T.bottomRows<modes>() = -S_aa.ldlt().solve(S.template bottomLeftCorner<modes, 3 * Nodes>());
  }
  return T;
}

template <SolidShape shape>
void green(const Mesh& mesh, const SolidElement& solid, SecondOrderRows& out) {
  constexpr int nodes = count_of(SolidBasis<shape>::nodes);
  constexpr int functions = nodes + static_cast<int>(IncompatibleModes<shape>::size);
  const auto x = node_positions<shape>(mesh, solid);
  const Eigen::Matrix<double, 6, 6>& C = mesh.solid_properties[solid.property].material.C;
  const auto G = weighted_gradients<shape>(x, solid.id);
  constexpr int points = static_cast<int>(decltype(G.root)::RowsAtCompileTime);
  Eigen::Matrix<double, 3 * functions, 3 * functions> S;
  if constexpr (functions > nodes) {
    Eigen::Matrix<double, 3 * functions, 3 * functions> H;
    gram(G.slope, H);
    S = contract<functions>(C, H);
  }
  const Eigen::MatrixXd T = follow<functions, nodes>(S);
  out.start({{&green_strain(), points}}, 3 * nodes);
  for (int q = 0; q < points; ++q) {
    const Eigen::Map<const Eigen::Matrix<double, functions, 3>> slope(G.slope.col(q).data());  // times √weight
    out.stress.middleRows<6>(6 * q).noalias() = C / G.root[q] * strain_rows<functions>(slope) * T;
    for (int a = 0; a < nodes; ++a)
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) out.gradient(9 * q + 3 * k + i, 3 * a + i) = slope(a, k);
  }
}

}  // namespace

void second_order(const Mesh& mesh, const SolidElement& solid, SecondOrderRows& out) {
  with_shape(solid.shape, [&]<SolidShape shape>() { green<shape>(mesh, solid, out); });
}

}  // namespace tisserand::reducer
