// SPDX-License-Identifier: GPL-3.0-or-later
// Sums in other axes and of other modes, and checks of the couplings that they omit.
#include "mechanism/bodies/planar/planar_modal_body.hpp"

#include <cmath>

namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A sum Σ a bᵀ, stored as nine numbers in a column.
using Block = Eigen::Map<Matrix3d>;

void turn_sums(const Matrix3d& axes, ModalBody& body, const std::vector<ModalNode*>& nodes) {
  const auto tensor = [&axes](auto&& A) { A = (axes.transpose() * A * axes).eval(); };
  const auto vectors = [&axes](auto& v) { v = (axes.transpose() * v).eval(); };
  vectors(body.c0);
  vectors(body.C1);
  vectors(body.N_mu);
  tensor(body.P0);
  tensor(body.J_mu);
  for (Index j = 0; j < body.modes; ++j) {
    tensor(Block(body.P1.data() + 9 * j));
    for (Index i = 0; i < body.modes; ++i) tensor(Block(body.P2.col(i).data() + 9 * j));
  }
  for (ModalNode* node : nodes) {
    vectors(node->x);
    vectors(node->Xd);
    vectors(node->Xt);
  }
}

/// Rows of the sums Σ a bᵀ within the plane, and those that couple with it; zz has no effect in it.
const std::vector<int> rows_in_plane{0, 1, 3, 4}, rows_across{2, 5, 6, 7};

/// Units in which a mode of mass 1 has entries of at most 1.
struct ModeUnits {
  double mass, arm, inertia;  ///< units of C1, of P1, of N_mu

  explicit ModeUnits(const ModalBody& body)
      : mass(std::sqrt(body.mass)), arm(std::sqrt(body.P0.trace())), inertia(std::sqrt(body.J_mu.trace())) {}
};

/// Returns `part` over `unit`, or zero if the unit is zero.
MatrixXd in_units(const MatrixXd& part, double unit) {
  return unit > 0.0 ? MatrixXd(part / unit) : MatrixXd(MatrixXd::Zero(part.rows(), part.cols()));
}

ModePulls pulls_of(const ModalBody& body, const std::vector<ModalNode*>& nodes, double reach) {
  const ModeUnits unit(body);
  const Eigen::Map<const MatrixXd> P1(body.P1.data(), 9, body.modes);
  const auto stack = [&](const std::vector<MatrixXd>& parts) {
    Index rows = 0;
    for (const MatrixXd& part : parts) rows += part.rows();
    MatrixXd all(rows, body.modes);
    rows = 0;
    for (const MatrixXd& part : parts) {
      all.middleRows(rows, part.rows()) = part;
      rows += part.rows();
    }
    return all;
  };
  std::vector<MatrixXd> in{in_units(body.C1.topRows<2>(), unit.mass), in_units(P1(rows_in_plane, Eigen::all), unit.arm),
                           in_units(body.N_mu.bottomRows<1>(), unit.inertia)},
      out{in_units(body.C1.bottomRows<1>(), unit.mass), in_units(P1(rows_across, Eigen::all), unit.arm),
          in_units(body.N_mu.topRows<2>(), unit.inertia)};
  for (const ModalNode* node : nodes) {
    if (std::abs(node->x.z()) > planar_share * reach) continue;
    in.emplace_back(unit.mass * node->Xd.topRows<2>());
    in.emplace_back(unit.arm * node->Xt.bottomRows<1>());
    out.emplace_back(unit.mass * node->Xd.bottomRows<1>());
    out.emplace_back(unit.arm * node->Xt.topRows<2>());
  }
  return {stack(in), stack(out)};
}

/// Checks the second moments of the modes, mass-normalised: of modes in the plane, and of one in it with one out of it.
/// Spin and its changes drive the modes through them.
void require_apart(const MatrixXd& P2, const Split& modes) {
  const Index m = modes.in.rows();
  const auto product = [&](int a, const MatrixXd& left, const MatrixXd& right) {
    MatrixXd A(m, m);
    for (Index i = 0; i < m; ++i)
      for (Index j = 0; j < m; ++j) A(i, j) = P2(9 * j + a, i);
    return MatrixXd(left.transpose() * A * right);
  };
  for (const int a : rows_across) require_nothing(product(a, modes.in, modes.in), 1.0, "a second moment of its modes");
  require_nothing(product(0, modes.in, modes.out) + product(4, modes.in, modes.out), 1.0,
                  "the effect of rotation on its modes");
  require_nothing(product(1, modes.in, modes.out) - product(3, modes.in, modes.out), 1.0,
                  "the effect of angular acceleration on its modes");
}

/// Transforms the sums to the modes w_p of w = W w_p.
void keep_modes(const MatrixXd& W, ModalBody& body) {
  const Index m = body.modes, kept = W.cols();
  body.C1 = (body.C1 * W).eval();
  body.N_mu = (body.N_mu * W).eval();
  const MatrixXd P1 = Eigen::Map<const MatrixXd>(body.P1.data(), 9, m) * W;
  body.P1 = P1.reshaped();
  MatrixXd half(9 * kept, m);
  for (Index i = 0; i < m; ++i) {
    const MatrixXd column = Eigen::Map<const MatrixXd>(body.P2.col(i).data(), 9, m) * W;
    half.col(i) = column.reshaped();
  }
  body.P2 = half * W;
  body.stiffness = (W.transpose() * body.stiffness.asDiagonal() * W).diagonal().eval();
  body.damping = (W.transpose() * body.damping.asDiagonal() * W).diagonal().eval();
  body.modes = static_cast<int>(kept);
  body.lift = W;
  body.planar = true;
}

/// Trace and spin of each of the blocks (9 rows each, one below the other).
MatrixXd traces_and_spins(const MatrixXd& blocks) {
  const Index m = blocks.rows() / 9;
  MatrixXd out(2 * m, blocks.cols());
  for (Index j = 0; j < m; ++j) {
    out.row(2 * j) = blocks.row(9 * j) + blocks.row(9 * j + 4);
    out.row(2 * j + 1) = blocks.row(9 * j + 3) - blocks.row(9 * j + 1);
  }
  return out;
}

/// Sets entries that count as zero to exactly zero.
void clear_normal(ModalBody& body) {
  const auto clear = [](auto&& A) {
    A.row(2).setZero();
    A.col(2).setZero();
  };
  body.c0.z() = body.gravity.z() = 0.0;
  body.C1.row(2).setZero();
  body.N_mu.topRows<2>().setZero();
  const double J = body.J_mu(2, 2);
  body.J_mu.setZero();
  body.J_mu(2, 2) = J;
  clear(body.P0);
  body.P1 = traces_and_spins(body.P1);
  body.P2 = traces_and_spins(body.P2);
}

}  // namespace

void make_planar(const Matrix3d& axes, double reach, ModalBody& body, const std::vector<ModalNode*>& nodes) {
  turn_sums(axes, body, nodes);
  body.axes = (body.axes * axes).eval();
  const double inertia = body.P0.trace() + body.J_mu.trace();
  require_nothing(body.c0.tail<1>(), std::sqrt(body.mass * body.P0.trace()), "its centre of mass");
  require_nothing(body.P0.col(2).head<2>() - body.J_mu.col(2).head<2>(), inertia, "a product of inertia");
  const Split modes = split_modes(pulls_of(body, nodes, reach), body.stiffness, "mode");
  require_apart(body.P2, modes);
  const double damping = body.modes > 0 ? body.damping.maxCoeff() : 0.0;
  MatrixXd of_others = modes.in.transpose() * body.damping.asDiagonal() * modes.in;
  of_others.diagonal().setZero();
  require_nothing(of_others, damping, "its damping");
  require_nothing(modes.in.transpose() * body.damping.asDiagonal() * modes.out, damping, "its damping");
  for (ModalNode* node : nodes) {
    node->Xd = (node->Xd * modes.in).eval();
    node->Xt = (node->Xt * modes.in).eval();
    if (std::abs(node->x.z()) > planar_share * reach) continue;
    node->x.z() = 0.0;
    node->Xd.row(2).setZero();
    node->Xt.topRows<2>().setZero();
  }
  keep_modes(modes.in, body);
  clear_normal(body);
}

}  // namespace tisserand::mechanism
