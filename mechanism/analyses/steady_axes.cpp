// SPDX-License-Identifier: GPL-3.0-or-later
// The state a moment later if it is steady, and the rotation of internal coordinates by the nodes they move with.
#include "mechanism/analyses/steady_axes.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "common/math/rotation.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/model/element_map.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Internal coordinates of one body, which are columns of a linearisation.
struct Internal {
  std::string name;
  int first = 0;
  VectorXd frequency_squared;  ///< ascending
  Vector3d spin = Vector3d::Zero();
  int superelement = -1, modal = -1;  ///< index of one of them; the other is −1
};

/// Angular velocity of a node relative to axes that turn with ω.
Vector3d spin_of(const Evaluation& evaluation, int node, const Vector3d& omega) {
  const NodeMotion& m = evaluation.motion[node];
  return m.R * m.Omega - omega;
}

std::vector<Internal> internal_coordinates(const Model& model, const Evaluation& evaluation, const Vector3d& omega) {
  std::vector<Internal> list;
  for (int i = 0; i < std::ssize(model.superelements); ++i) {
    Internal body{model.superelements[i].name, model.sizes.boundary + model.internal_offset[i], body_of(model, i).S_II,
                  Vector3d::Zero(), i};
    for (const int node : model.superelements[i].nodes)
      if (const Vector3d spin = spin_of(evaluation, node, omega);
          model.nodes[node].rotation >= 0 && spin.norm() > body.spin.norm())
        body.spin = spin;
    list.push_back(body);
  }
  for (int i = 0; i < std::ssize(model.modal_bodies); ++i) {
    const ModalBody& body = model.modal_bodies[i];
    list.push_back({body.name, model.sizes.first_modal() + body.offset, body.stiffness,
                    spin_of(evaluation, body.node, omega), -1, i});
  }
  return list;
}

/// The state `time` later, if it is steady in axes that turn with ω. Positions and velocities turn with the axes, and
/// each node spins about its own position. Floating frames do not change.
State moved_on(const Model& model, const State& state, const Vector3d& omega, double time,
               const Evaluation& evaluation) {
  const Vector3d turn = omega * time;
  const Matrix3d Q = exp_so3(turn), W = skew(turn);
  const AngleFunctions<double> f(turn.squaredNorm());
  const Matrix3d along = time * (Matrix3d::Identity() + f.c * W + f.d * W * W);  // ∫ exp(ω~s) ds
  VectorXd step = VectorXd::Zero(model.sizes.velocities());
  for (int i = 0; i < std::ssize(model.nodes); ++i) {
    const Node& node = model.nodes[i];
    const NodeMotion& m = evaluation.motion[i];
    if (node.translation >= 0) set_translation(model, along * m.xd, node.translation, step);
    if (node.rotation < 0) continue;
    const Vector3d own = spin_of(evaluation, i, omega) * time;
    set_rotation(model, m.R.transpose() * log_so3<double>(Q * exp_so3(own)), node.rotation, step);
  }
  State later = state;
  retract(model, state, step, later);
  for (int i = 0; i < std::ssize(model.nodes); ++i) {
    const Node& node = model.nodes[i];
    const NodeMotion& m = evaluation.motion[i];
    if (node.translation >= 0) {
      set_translation(model, Q * m.xd, node.translation, later.v());
      set_translation(model, Q * m.xdd, node.translation, later.vdot());
    }
    if (node.rotation < 0) continue;
    const Vector3d own = spin_of(evaluation, i, omega) * time;
    const Matrix3d back = m.R.transpose() * exp_so3<double>(-own) * m.R;  // R₂ᵀ Q R
    set_rotation(model, back * m.Omega, node.rotation, later.v());
    set_rotation(model, back * m.Omegad, node.rotation, later.vdot());
  }
  return later;
}

/// Adds the multipliers that minimise the residual, because rows whose directions turned with a body need other ones.
void balance(const Linearisation& l, State& state) {
  if (l.B.rows() == 0) return;
  add_to_multipliers(l.B.transpose().completeOrthogonalDecomposition().solve(-l.r), state);
}

/// Transforms coordinates and equations from world axes to axes that are turned by Q.
void turn_axes(const Model& model, const Matrix3d& Q, Linearisation& l) {
  for (const Node& node : model.nodes)
    for (const auto& [first, size] :
         {std::pair{node.translation, translations_of(model)}, std::pair{node.rotation, rotations_of(model)}}) {
      if (first < 0 || size == 1) continue;
      const MatrixXd T = Q.topLeftCorner(size, size);
      for (MatrixXd* A : {&l.M, &l.C, &l.K, &l.B}) A->middleCols(first, size) = (A->middleCols(first, size) * T).eval();
      for (MatrixXd* A : {&l.M, &l.C, &l.K})
        A->middleRows(first, size) = (T.transpose() * A->middleRows(first, size)).eval();
    }
}

/// The skew matrix log E of an orthogonal E near 1, by the eigenvalues i tan(φ/2) of its Cayley transform.
MatrixXd logarithm(const MatrixXd& E) {
  const MatrixXd one = MatrixXd::Identity(E.rows(), E.cols());
  const MatrixXd cayley = (E + one).partialPivLu().solve(E - one);
  const std::complex<double> i(0.0, 1.0);
  const Eigen::SelfAdjointEigenSolver<MatrixXcd> eigen(-0.5 * i *
                                                       (cayley - cayley.transpose()).cast<std::complex<double>>());
  const VectorXd angle = 2.0 * eigen.eigenvalues().array().atan();
  return (eigen.eigenvectors() * (i * angle).asDiagonal() * eigen.eigenvectors().adjoint()).real();
}

/// Coupling of the internal coordinates of a body to other parts, in axes that are turned by Q. It contains M between
/// them and all other coordinates; for modal bodies also the motion of the nodes on the axis of the spin.
MatrixXd coupling(const Model& model, const Internal& body, const Linearisation& l, const Matrix3d& Q,
                  const Evaluation& evaluation) {
  const auto m = body.frequency_squared.size();
  MatrixXd rows = l.M.middleCols(body.first, m);
  rows.middleRows(body.first, m).setZero();
  rows.topRows(model.sizes.boundary).array().colwise() *= model.equation_scale.head(model.sizes.boundary);
  if (body.modal < 0) return rows;
  const ModalBody& modal = model.modal_bodies[body.modal];
  for (int i = 0; i < std::ssize(model.nodes); ++i) {
    const int follower = modal_node(model, i);
    if (follower < 0 || model.modal_nodes[follower].body != body.modal || !model.modal_nodes[follower].active) continue;
    const NodeMotion& node = evaluation.motion[i];
    const NodeMotion& frame = motion_of(evaluation, modal.node);
    if ((node.x - frame.x).cross(body.spin).norm() > 1e-6 * model.length * body.spin.norm()) continue;
    const MatrixXd T = modal.mass * evaluation.modal_nodes[follower].T.rightCols(m);
    rows.conservativeResize(rows.rows() + 6, Eigen::NoChange);
    rows.bottomRows(6).topRows(3) = Q.transpose() * T.topRows(3);
    rows.bottomRows(3) = model.length * Q.transpose() * node.R * T.bottomRows(3);
  }
  return rows;
}

/// Rotation E that best satisfies A E = B for coordinates of one frequency; none if A and B do not determine it.
std::optional<MatrixXd> procrustes(const MatrixXd& A, const MatrixXd& B, double least) {
  const Eigen::JacobiSVD<MatrixXd> svd(A.transpose() * B, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const auto m = A.cols();
  if (m == 1) return MatrixXd::Identity(1, 1);
  MatrixXd E = svd.matrixU() * svd.matrixV().transpose();
  if (!(svd.singularValues()[m - 1] > least) || E.determinant() < 0.0) return {};
  return E;
}

/// Rotation E = exp(−Γ time) of a body from its couplings, in blocks of coordinates with nearly equal frequency.
std::optional<MatrixXd> turn_of(const Internal& body, const MatrixXd& now, const MatrixXd& later) {
  constexpr double alike = 1e-2;   // neighbours in ω²: a mesh separates the two planes of a round shaft a little
  constexpr double least = 1e-10;  // of the square of the largest coupling
  const auto m = body.frequency_squared.size();
  const double largest = now.colwise().squaredNorm().maxCoeff();
  MatrixXd E = MatrixXd::Identity(m, m);
  for (Eigen::Index from = 0, to = 0; from < m; from = to) {
    for (to = from + 1; to < m && body.frequency_squared[to] <= (1.0 + alike) * body.frequency_squared[to - 1];) ++to;
    const auto block = procrustes(later.middleCols(from, to - from), now.middleCols(from, to - from), least * largest);
    if (!block) return {};
    E.block(from, from, to - from, to - from) = *block;
  }
  return E;
}

/// Replaces the internal coordinates q = E exp(−Γt) η of a body by η.
void take_in_axes(const Internal& body, const MatrixXd& E, const MatrixXd& Gamma, Linearisation& l) {
  const int first = body.first;
  const auto m = E.rows();
  const MatrixXd M = l.M.middleCols(first, m) * E, C = l.C.middleCols(first, m) * E, K = l.K.middleCols(first, m) * E;
  l.M.middleCols(first, m) = M;
  l.C.middleCols(first, m) = C - 2.0 * M * Gamma;
  l.K.middleCols(first, m) = K - C * Gamma + M * Gamma * Gamma;
  l.B.middleCols(first, m) = (l.B.middleCols(first, m) * E).eval();
  for (MatrixXd* A : {&l.M, &l.C, &l.K}) A->middleRows(first, m) = (E.transpose() * A->middleRows(first, m)).eval();
}

}  // namespace

FastestSpin fastest_spin(const Model& model, const Vector3d& omega, const Evaluation& evaluation) {
  FastestSpin fastest;
  for (int i = 0; i < std::ssize(model.nodes); ++i)
    if (const Vector3d spin = spin_of(evaluation, i, omega);
        model.nodes[i].rotation >= 0 && spin.norm() > (1.0 + 1e-9) * fastest.spin.norm())
      fastest = {spin, i};
  return fastest;
}

SteadyLinearisation linearise_steady(const Model& model, const State& state, const Vector3d& omega, Linearisation now,
                                     Evaluation& evaluation) {
  SteadyLinearisation steady;
  steady.now = std::move(now);
  const double fastest = std::max(omega.norm(), fastest_spin(model, omega, evaluation).spin.norm());
  const double time = turned_by / fastest;
  const std::vector<Internal> internal = internal_coordinates(model, evaluation, omega);
  const Matrix3d Q = exp_so3<double>(omega * time);
  State moved = moved_on(model, state, omega, time, evaluation);
  for (const Internal& body : internal)
    if (body.superelement >= 0) {
      auto frame = moved.frames().col(body.superelement);
      const Vector3d own = body.spin * time;
      frame = wxyz((Eigen::Quaterniond(Q * exp_so3(own)) * quaternion(frame)).normalized());
    }
  std::vector<MatrixXd> couplings;
  for (const Internal& body : internal)
    couplings.push_back(coupling(model, body, steady.now, Matrix3d::Identity(), evaluation));
  balance(linearise(model, moved, omega, evaluation), moved);
  Linearisation later = linearise(model, moved, omega, evaluation);
  turn_axes(model, Q, later);
  for (std::size_t i = 0; i < internal.size(); ++i) {
    const Internal& body = internal[i];
    if (body.frequency_squared.size() == 0 || !(body.spin.norm() > 1e-6 * fastest)) continue;
    const std::optional<MatrixXd> E = turn_of(body, couplings[i], coupling(model, body, later, Q, evaluation));
    if (!E && steady.undecided.empty()) steady.undecided = body.name;
    if (!E) continue;
    const MatrixXd Gamma = logarithm(*E) / -time;
    take_in_axes(body, MatrixXd::Identity(E->rows(), E->cols()), Gamma, steady.now);
    take_in_axes(body, *E, Gamma, later);
  }
  steady.later = std::move(later);
  evaluate(model, state, evaluation);
  return steady;
}

double largest_change(const QuadraticProblem& now, const QuadraticProblem& later, double s, int count) {
  const Eigen::Index n = now.M.rows(), first = std::max<Eigen::Index>(0, n - count);
  const auto difference = [&](const MatrixXd& a, const MatrixXd& b) {
    return (b - a).bottomRightCorner(n - first, n - first).cwiseAbs().array().eval();
  };
  const Eigen::ArrayXd mass = now.M.diagonal().tail(n - first).array().abs().max(1e-300).sqrt();
  const Eigen::ArrayXd stiffness = now.K.diagonal().tail(n - first).array().abs().sqrt().max(s * mass);
  const Eigen::ArrayXd damping = (mass * stiffness).sqrt();
  double largest = 0.0;
  const auto compare = [&](const MatrixXd& a, const MatrixXd& b, const Eigen::ArrayXd& size) {
    if (n > first)
      largest = std::max(largest, (difference(a, b) / (size.matrix() * size.matrix().transpose()).array()).maxCoeff());
  };
  compare(now.M, later.M, mass);
  compare(now.C, later.C, damping);
  compare(now.K, later.K, stiffness);
  return largest;
}

}  // namespace tisserand::mechanism
