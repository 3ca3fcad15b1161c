// SPDX-License-Identifier: GPL-3.0-or-later
// Full models of a bent frame and a network of springs, and their reduction.
#include "tests/support/bodies/reduced_frames.hpp"

#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "common/math/rotation.hpp"

namespace tisserand::test_support {

namespace {

bool is_kept(Keep keep, int component) {
  return keep == Keep::all || keep == (component < 3 ? Keep::translations : Keep::rotations);
}

}  // namespace

Eigen::MatrixXd craig_bampton_basis(const FullModel& model, const std::vector<Keep>& keep, int modes) {
  std::vector<int> boundary, internal;
  for (int node = 0; node < static_cast<int>(keep.size()); ++node)
    for (int c = 0; c < model.components; ++c)
      (is_kept(keep[node], c) ? boundary : internal).push_back(model.components * node + c);
  const auto nb = static_cast<Eigen::Index>(boundary.size());
  Eigen::MatrixXd Phi = Eigen::MatrixXd::Zero(model.S.rows(), nb + modes);
  Phi(boundary, Eigen::seqN(0, nb)).setIdentity();
  if (internal.empty()) return Phi;
  const Eigen::MatrixXd S_II = model.S(internal, internal), M_II = model.M(internal, internal);
  const Eigen::MatrixXd S_IB = model.S(internal, boundary);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(S_II, M_II);
  Phi(internal, Eigen::seqN(0, nb)) = -S_II.ldlt().solve(S_IB);
  Phi(internal, Eigen::seqN(nb, modes)) = eigen.eigenvectors().leftCols(modes);
  return Phi;
}

formats::Superelement craig_bampton(const FullModel& model, const std::vector<Keep>& keep, int modes) {
  formats::Superelement e;
  e.name = "frame";
  e.method = "craig_bampton";
  e.units = Units::si();
  std::vector<int> boundary_nodes;
  for (int node = 0; node < static_cast<int>(keep.size()); ++node) {
    const Keep k = keep[node];
    if (k != Keep::nothing) boundary_nodes.push_back(node);
    for (int c = 0; c < model.components; ++c) {
      if (!is_kept(k, c)) continue;
      e.dof_node.push_back(static_cast<int>(boundary_nodes.size()) - 1);
      e.dof_component.push_back(c);
    }
  }
  e.node_position = model.position(boundary_nodes, Eigen::all);
  for (std::size_t i = 0; i < boundary_nodes.size(); ++i)
    e.node_name.push_back("n" + std::to_string(boundary_nodes[i]));
  for (int k = 0; k < modes; ++k) {
    e.dof_node.push_back(-1);
    e.dof_component.push_back(k);
  }
  const Eigen::MatrixXd Phi = craig_bampton_basis(model, keep, modes);
  e.stiffness = Phi.transpose() * model.S * Phi;
  e.mass = Phi.transpose() * model.M * Phi;
  e.stiffness = (0.5 * (e.stiffness + e.stiffness.transpose())).eval();
  e.mass = (0.5 * (e.mass + e.mass.transpose())).eval();
  return e;
}

BeamData soft_beam() {
  BeamData beam;
  beam.young = 1.0e3;
  beam.shear_modulus = 4.0e2;
  beam.density = 1.0;
  beam.area = 1.0;
  beam.Iy = 0.02;
  beam.Iz = 0.03;
  beam.J = 0.04;
  return beam;
}

FullModel bent_frame() {
  FullModel model;
  model.position.resize(6, 3);
  model.position << 0, 0, 0, 0.8, 0, 0, 1.5, 0, 0, 1.5, 0.5, 0, 1.5, 1, 0, 1.5, 1, 0.7;
  model.S.setZero(36, 36);
  model.M.setZero(36, 36);
  for (int k = 0; k < 5; ++k) {
    const Eigen::Vector3d along = (model.position.row(k + 1) - model.position.row(k)).transpose();
    BeamData piece = soft_beam();
    piece.length = along.norm();
    const formats::Superelement element = beam_superelement(piece);
    const Eigen::Vector3d axis = Eigen::Vector3d::UnitX().cross(along).normalized();
    const Eigen::Matrix3d R = exp_so3<double>(std::acos(along.x() / piece.length) * axis);
    Eigen::MatrixXd T = Eigen::MatrixXd::Zero(12, 12);
    for (int block = 0; block < 4; ++block) T.block<3, 3>(3 * block, 3 * block) = R;
    model.S.block<12, 12>(6 * k, 6 * k) += T * element.stiffness * T.transpose();
    model.M.block<12, 12>(6 * k, 6 * k) += T * element.mass * T.transpose();
  }
  return model;
}

FullModel spring_network() {
  FullModel model;
  model.components = 3;
  model.position.resize(6, 3);
  model.position << 0, 0, 0, 1.2, 0, 0, 0, 1, 0, 0.1, 0.2, 0.9, 0.4, 0.3, 0.2, 0.3, 0.2, 0.5;
  const std::array<double, 6> mass{0.5, 0.8, 0.6, 0.7, 1.1, 0.9};
  model.S.setZero(18, 18);
  model.M.setZero(18, 18);
  for (int i = 0; i < 6; ++i) {
    model.M.block<3, 3>(3 * i, 3 * i) = mass[i] * Eigen::Matrix3d::Identity();
    for (int j = 0; j < i; ++j) {
      const Eigen::Vector3d direction = (model.position.row(i) - model.position.row(j)).transpose().normalized();
      const Eigen::Matrix3d k = (50.0 + 3.0 * i + 7.0 * j) * direction * direction.transpose();
      model.S.block<3, 3>(3 * i, 3 * i) += k;
      model.S.block<3, 3>(3 * j, 3 * j) += k;
      model.S.block<3, 3>(3 * i, 3 * j) -= k;
      model.S.block<3, 3>(3 * j, 3 * i) -= k;
    }
  }
  return model;
}

formats::Superelement test_superelement(const std::string& name) {
  using enum Keep;
  if (name == "beam") return craig_bampton_beam(soft_beam(), 4);
  if (name == "frame") return craig_bampton(bent_frame(), {all, nothing, all, nothing, nothing, all}, 5);
  if (name == "guyan") return craig_bampton(bent_frame(), {all, nothing, all, nothing, nothing, all}, 0);
  if (name == "mixed")
    return craig_bampton(bent_frame(), {all, nothing, rotations, translations, translations, all}, 6);
  return craig_bampton(spring_network(), {all, all, all, all, nothing, nothing}, 6);  // "network"
}

}  // namespace tisserand::test_support
