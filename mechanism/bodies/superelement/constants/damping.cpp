// SPDX-License-Identifier: GPL-3.0-or-later
// Damping of a superelement body: matrices on the deformation rates from the options of the scene.
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "mechanism/bodies/superelement/constants/body.hpp"

namespace tisserand::mechanism {
namespace {

struct WholeMatrices {
  Eigen::MatrixXd S, M;
};

WholeMatrices whole_matrices(const SuperelementBody& body) {
  const int nb = body.boundary_size, m = body.modes;
  WholeMatrices whole{Eigen::MatrixXd::Zero(nb + m, nb + m), Eigen::MatrixXd::Identity(nb + m, nb + m)};
  whole.S.topLeftCorner(nb, nb) = body.S_BB;
  whole.S.diagonal().tail(m) = body.S_II;
  whole.M.topLeftCorner(nb, nb) = body.M_BB;
  whole.M.topRightCorner(nb, m) = body.M_BI;
  whole.M.bottomLeftCorner(m, nb) = body.M_IB;
  return whole;
}

void require_ratios(const std::vector<double>& ratios, Eigen::Index modes, const char* noun, const std::string& where) {
  if (static_cast<Eigen::Index>(ratios.size()) > modes)
    throw Error(fmt::format("damping: {} ratios for {} {} modes", ratios.size(), modes, noun), where,
                "give at most one ratio per mode");
}

double ratio_of(const std::vector<double>& ratios, double others, Eigen::Index k) {
  return k < static_cast<Eigen::Index>(ratios.size()) ? ratios[k] : others;
}

/// The bracket of THEORY (41), a (M̄ − M̄R (RᵀM̄R)⁻¹ RᵀM̄) with the rigid motions R: a M̄ on what is M̄-orthogonal to them.
/// The choice of the frame adds a rigid motion to the rates of deformation; this has no effect here. Every elastic mode
/// of the free body has the ratio a/2ω.
Eigen::MatrixXd mass_damping(const SuperelementBody& body, double factor) {
  const Eigen::MatrixXd M = whole_matrices(body).M, R = rigid_columns(body), MR = M * R;
  return factor * (M - MR * (R.transpose() * MR).completeOrthogonalDecomposition().pseudoInverse() * MR.transpose());
}

}  // namespace

Eigen::VectorXd coordinate_units(const SuperelementBody& body) {
  double square = 0.0;
  for (const SuperelementNode& node : body.node) square = std::max(square, node.X.squaredNorm());
  const double length = square > 0.0 ? std::sqrt(square) : 1.0;
  Eigen::VectorXd unit = Eigen::VectorXd::Constant(body.boundary_size + body.modes, length * std::sqrt(body.mass));
  for (const SuperelementNode& node : body.node) {
    if (node.has_translation()) unit.segment(node.translation_row, body.translations()).setConstant(length);
    if (node.has_rotation()) unit.segment(node.rotation_row, body.rotations()).setOnes();
  }
  return unit;
}

Eigen::MatrixXd rigid_columns(const SuperelementBody& body) {
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(body.boundary_size + body.modes, 6);
  for (const SuperelementNode& node : body.node) {
    if (node.has_translation()) {
      R.block(node.translation_row, 0, body.translations(), 3).setIdentity();
      R.block(node.translation_row, 3, body.translations(), 3) = -skew<double>(node.X).topRows(body.translations());
    }
    if (node.has_rotation())
      R.block(node.rotation_row, 6 - body.rotations(), body.rotations(), body.rotations()).setIdentity();
  }
  return R;
}

FreeModes free_modes(const SuperelementBody& body, const std::string& where) {
  constexpr double massless = 1e-13;  // relative to the largest 1/ω²: round-off of the products below
  const Eigen::Index n = body.boundary_size + body.modes;
  FreeModes modes;
  modes.force.resize(n, 0);
  if (n <= 6) return modes;
  const WholeMatrices whole = whole_matrices(body);
  const Eigen::VectorXd unit = coordinate_units(body);
  const Eigen::MatrixXd R = unit.cwiseInverse().asDiagonal() * rigid_columns(body);
  const Eigen::MatrixXd S = unit.asDiagonal() * whole.S * unit.asDiagonal();
  const Eigen::MatrixXd M = unit.asDiagonal() * whole.M * unit.asDiagonal();
  // Deformations: Z is normal to the rigid motions R. Rigid motions are then added so that RᵀM φ = 0.
  const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(R).householderQ();
  const Eigen::MatrixXd Z = Q.rightCols(n - 6), MR = M * R, coupling = MR.transpose() * Z;
  Eigen::MatrixXd S_Z = Z.transpose() * S * Z;
  S_Z = (0.5 * (S_Z + S_Z.transpose())).eval();
  const Eigen::MatrixXd inertia = R.transpose() * MR;
  const Eigen::MatrixXd M_Z =
      Z.transpose() * M * Z - coupling.transpose() * inertia.completeOrthogonalDecomposition().solve(coupling);
  if (Eigen::LLT<Eigen::MatrixXd>(S_Z).info() != Eigen::Success)
    throw Error(fmt::format("damping: '{}' has motions without strain in addition to rigid-body motions, so its "
                            "elastic modes cannot be counted",
                            body.name),
                where, "give the damping by 'stiffness', or that of its internal modes by 'ratio_internal'");
  // 1/ω² of M_Z a = (1/ω²) S_Z a, ascending. Soft modes keep all digits, and massless ones come first as zeros.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (M_Z + M_Z.transpose()), S_Z);
  const Eigen::VectorXd& inverse = solver.eigenvalues();
  const Eigen::Index count = (inverse.array() > massless * inverse.maxCoeff()).count();
  modes.omega = inverse.reverse().head(count).cwiseSqrt().cwiseInverse();
  modes.force = whole.S * (unit.asDiagonal() * (Z * solver.eigenvectors().rowwise().reverse().leftCols(count)));
  return modes;
}

void set_damping(const formats::Damping& given, const std::string& where, SuperelementBody& body) {
  const auto require = [&](double value, const char* what) {
    if (!(value >= 0.0)) throw Error(fmt::format("damping: {} is {:g}", what, value), where, "choose 0 or more");
  };
  require(given.mass, "mass");
  require(given.stiffness, "stiffness");
  require(given.ratio, "ratio");
  require(given.ratio_internal, "ratio_internal");
  for (const std::vector<double>* ratios : {&given.ratios, &given.ratios_internal})
    for (const double ratio : *ratios) require(ratio, "ratio of a mode");
  require_ratios(given.ratios_internal, static_cast<Eigen::Index>(body.file.internal_row.size()), "internal", where);

  SuperelementDamping& damping = body.damping;
  damping.stiffness = given.stiffness;
  damping.internal.resize(body.modes);
  for (Eigen::Index k = 0; k < body.modes; ++k)
    damping.internal[k] = given.stiffness * body.S_II[k] +
                          2.0 * ratio_of(given.ratios_internal, given.ratio_internal, k) * std::sqrt(body.S_II[k]);
  damping.active = given.stiffness > 0.0 || (damping.internal.array() > 0.0).any();
  if (given.mass == 0.0 && given.ratio == 0.0 && given.ratios.empty()) return;

  const int nb = body.boundary_size, m = body.modes;
  Eigen::MatrixXd D = mass_damping(body, given.mass);
  if (given.ratio > 0.0 || !given.ratios.empty()) {
    const FreeModes modes = free_modes(body, where);
    require_ratios(given.ratios, modes.omega.size(), "elastic", where);
    Eigen::VectorXd factor(modes.omega.size());
    for (Eigen::Index k = 0; k < factor.size(); ++k)
      factor[k] = 2.0 * ratio_of(given.ratios, given.ratio, k) / modes.omega[k];
    D += modes.force * factor.asDiagonal() * modes.force.transpose();
  }
  if (D.isZero(0.0)) return;
  D = (0.5 * (D + D.transpose())).eval();
  damping.BB = D.topLeftCorner(nb, nb);
  damping.BI = D.topRightCorner(nb, m);
  damping.IB = D.bottomLeftCorner(m, nb);
  damping.II = D.bottomRightCorner(m, m);
  damping.active = true;
}

}  // namespace tisserand::mechanism
