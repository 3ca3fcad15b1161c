// SPDX-License-Identifier: GPL-3.0-or-later
// Second-order strain of every kind of straight beam, from the exact solution along the axis.
//
// The section forces n, m of w and the axis and rotations of d come from the element's own exact solution (flexibility
// method; Hermite's cubics for a prismatic Euler-Bernoulli beam, those of [FK93] with shear):
//   V3 = ∫ [ n · (u' × ψ + ½ (ψ ψ₁ − e₁ |ψ|²)) + ½ m · (ψ' × ψ) + ½ W ψ₁'² ] ds,
// the second order of Rᵀ x' − e₁ and of the material curvature. With the axial force alone, ½ N (v'² + w'²), the energy
// of a bent beam that turns would change at first order of the turn. n, m and the fields include tapers, and shear
// centres and centroids off the axis. Released ends slide and turn in axes that the node carries along; rigid arms turn
// with their node. At both ends force and moment work on the second order of arm, slide and turn. Rods (no bending
// stiffness) are corotated: (N/l)(1 − e eᵀ), and a torque that turns with the line of the nodes. Wagner's term is W = N
// (I_p/A + |s|²) + β_y M_y − β_z M_z. By it columns of open sections buckle in torsion. Beams of unsymmetric sections
// turn over earlier for one sign of the moment. If the outline is unknown (constants, tapers), β holds the shear centre
// only.
#include "reducer/elements/second_order.hpp"
#include "common/math/rotation.hpp"
#include "reducer/elements/beam/ends.hpp"
#include "reducer/elements/beam/mesh_beam.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {
namespace {

/// diag(Rᵀ, Rᵀ, Rᵀ, Rᵀ): turns coordinates from part axes to element axes.
Matrix12 to_element(const Eigen::Matrix3d& R_PE) {
  Matrix12 Q = Matrix12::Zero();
  for (int i = 0; i < 4; ++i) Q.block<3, 3>(3 * i, 3 * i) = R_PE.transpose();
  return Q;
}

/// Adds gradients of both ends, whose forces work on arm a = ψ × r, slide and relative turn: f · (½ ψ × a + ψ × slide)
/// + ½ m · ψ × turn.
void add_ends(const BeamElement& beam, const Matrix12& nodes, const Matrix12& ends, Eigen::Index gradient,
              SecondOrderRows& out) {
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d r = beam.R_PE.transpose() * (end == 0 ? beam.first_offset : beam.second_offset);
    const Eigen::Matrix<double, 3, 12> u = nodes.middleRows<3>(6 * end), psi = nodes.middleRows<3>(6 * end + 3);
    const Eigen::Matrix<double, 3, 12> arm = -skew<double>(r) * psi;
    auto point = out.gradient.middleRows<9>(gradient + 9 * end);
    point.topRows<3>() = psi;
    point.middleRows<3>(3) = -(ends.middleRows<3>(6 * end) - u - 0.5 * arm);
    point.bottomRows<3>() = -0.5 * (ends.middleRows<3>(6 * end + 3) - psi);
  }
}

void rod(const Mesh& mesh, const BeamElement& beam, SecondOrderRows& out) {
  ElementMatrices matrices;
  element_matrices(mesh, beam, matrices);
  Eigen::Matrix3Xd X(3, 2);
  X << mesh.position.col(beam.first), mesh.position.col(beam.second);
  X.colwise() -= Eigen::Vector3d(X.rowwise().mean());
  out.start({{&turned_point(), 2}}, 12);
  add_corotated(matrices.S, X, turn_of_pair(X.col(1) - X.col(0)), out);
}

}  // namespace

void second_order(const Mesh& mesh, const BeamElement& beam, SecondOrderRows& out) {
  const BeamElementData data = data_of(mesh, beam);
  if (is_rod(data)) return rod(mesh, beam, out);
  const bool has_ends = beam.released != 0 || !beam.first_offset.isZero(0.0) || !beam.second_offset.isZero(0.0);
  const std::vector<BeamField> fields = beam_fields(data);
  const int points = count_of(fields);
  std::vector<StrainSection> sections{{&beam_point(), points}};
  if (has_ends) sections.push_back({&turned_point(), 2});
  out.start(sections, 12);

  const Matrix12 nodes = to_element(beam.R_PE);
  Matrix12 ends = nodes;
  if (has_ends) {
    Matrix12 arms = Matrix12::Identity();
    arms.block<3, 3>(0, 3) = -skew<double>(Eigen::Vector3d(beam.R_PE.transpose() * beam.first_offset));
    arms.block<3, 3>(6, 9) = -skew<double>(Eigen::Vector3d(beam.R_PE.transpose() * beam.second_offset));
    const Matrix12 stiffness = at_the_ends(data).stiffness;
    ends = release(beam.released, stiffness).T * arms * nodes;
    out.stress.middleRows<12>(7 * points) = stiffness * ends;
    add_ends(beam, nodes, ends, 9 * points, out);
  }
  for (int p = 0; p < points; ++p) {
    const BeamField& field = fields[p];
    const Eigen::Matrix<double, 6, 12> motion = field.motion * ends, gradient = field.gradient * ends;
    out.stress.middleRows<6>(7 * p) = field.weight * field.force * ends;
    out.stress.row(7 * p + 6) = field.weight * field.wagner * ends;
    out.gradient.middleRows<3>(9 * p) = gradient.topRows<3>();
    out.gradient.middleRows<3>(9 * p + 3) = motion.bottomRows<3>();
    out.gradient.middleRows<3>(9 * p + 6) = gradient.bottomRows<3>();
  }
}

}  // namespace tisserand::reducer
