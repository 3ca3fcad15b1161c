// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness and mass of solid elements for assembly, from nodes, material and shape.
//
// With H_kl(a, b) = ∫ ∂N_a/∂x_k ∂N_b/∂x_l dV and constant elasticity c_ikjl in the element, the stiffness is S(3a + i,
// 3b + j) = Σ_kl c_ikjl H_kl(a, b). So quadrature handles numbers per pair of functions, not strains.
//
// Eight-node hexahedra and six-node prisms have incompatible displacements in addition to those of the nodes. They are
// eliminated inside the element and make bending exact in parallelepipeds. Their gradients are det J0/det J J0⁻ᵀ g with
// ∫ g dξ = 0 over the reference element (J0 at its centre). They are orthogonal to constant stress, so the patch test
// holds on any mesh ([TBW76]). [SR90] section 4 shows that this is the enhanced strain of the Hu-Washizu principle.
#include <Eigen/Core>

#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/solid/gradients.hpp"

namespace tisserand::reducer {
namespace {

/// Eliminates the rows from `kept` on, last first. The leading rows become S_uu − S_ua S_aa⁻¹ S_au of the nodes.
template <int Size>
void eliminate_modes(int kept, Eigen::Matrix<double, Size, Size>& S) {
  for (int p = Size - 1; p >= kept; --p) {
    const Eigen::Matrix<double, Size, 1> pivot = S.col(p);
    for (int j = 0; j < p; ++j) S.col(j).head(p) -= (pivot[j] / pivot[p]) * pivot.head(p);
  }
}

template <SolidShape shape>
void stiffness(const NodePositions<count_of(SolidBasis<shape>::nodes)>& x, const Eigen::Matrix<double, 6, 6>& C, int id,
               Eigen::MatrixXd& S) {
  constexpr int nodes = count_of(SolidBasis<shape>::nodes);
  constexpr int modes = static_cast<int>(IncompatibleModes<shape>::size), functions = nodes + modes;
  const auto G = weighted_gradients<shape>(x, id);
  Eigen::Matrix<double, 3 * functions, 3 * functions> H;
  gram(G.slope, H);
  Eigen::Matrix<double, 3 * functions, 3 * functions> all = contract<functions>(C, H);
  if constexpr (modes > 0) eliminate_modes(3 * nodes, all);
  S = all.template topLeftCorner<3 * nodes, 3 * nodes>();
  for (int j = 0; j < 3 * nodes; ++j)
    for (int i = 0; i < j; ++i) S(i, j) = S(j, i);
}

/// Mass. Consistent: ρ ∫ N_a N_b dV. Lumped: its diagonal scaled to the mass of the element ([HRZ76]). This is positive
/// for every shape, whereas row sums are negative at the corners of quadratic shapes.
template <SolidShape shape>
void mass(const NodePositions<count_of(SolidBasis<shape>::nodes)>& x, const SolidProperty& property,
          Eigen::MatrixXd& M) {
  static constexpr auto table = tabulate<shape>(mass_rule<shape>());
  constexpr int points = count_of(table.weight);
  constexpr int nodes = count_of(SolidBasis<shape>::nodes);
  const Eigen::Map<const Eigen::Matrix<double, nodes, points>> N(table.value[0].data());
  Eigen::Matrix<double, points, 1> dm;
  for (int q = 0; q < points; ++q) {
    dm[q] = property.material.density * table.weight[q] * jacobian<nodes>(x, table.gradient[q]).determinant();
  }
  M.setZero(3 * nodes, 3 * nodes);
  Eigen::Matrix<double, nodes, nodes> m;
  switch (property.mass_matrix) {
    case formats::MassMatrix::consistent:
      gram(N * dm.cwiseSqrt().asDiagonal(), m);
      break;
    case formats::MassMatrix::lumped:
      m = Eigen::Matrix<double, nodes, 1>(N.cwiseAbs2() * dm).asDiagonal();
      if (const double trace = m.trace(); trace > 0.0) m *= dm.sum() / trace;
      break;
  }
  for (int b = 0; b < nodes; ++b)
    for (int a = b; a < nodes; ++a)
      for (int i = 0; i < 3; ++i) M(3 * a + i, 3 * b + i) = M(3 * b + i, 3 * a + i) = m(a, b);
}

template <SolidShape shape>
void matrices(const Mesh& mesh, const SolidElement& solid, ElementMatrices& out) {
  const auto x = node_positions<shape>(mesh, solid);
  const SolidProperty& property = mesh.solid_properties[solid.property];
  stiffness<shape>(x, property.material.C, solid.id, out.S);
  mass<shape>(x, property, out.M);
}

}  // namespace

int node_count(SolidShape shape) {
  return with_shape(shape, []<SolidShape s>() { return count_of(SolidBasis<s>::nodes); });
}

void element_matrices(const Mesh& mesh, const SolidElement& solid, ElementMatrices& out) {
  with_shape(solid.shape, [&]<SolidShape shape>() { matrices<shape>(mesh, solid, out); });
}

}  // namespace tisserand::reducer
