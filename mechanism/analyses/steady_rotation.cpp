// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's iteration in rotating axes.
#include "mechanism/analyses/steady_rotation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>

#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/analyses/linearise.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "mechanism/equations/round_off.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double turning_floor = 1e-13;
/// Round-off of forces against a rotation of the whole scene, relative to the largest stiffness.
constexpr double turn_resistance = 1e-13;

/// Largest internal force of any single term, including the inertia of the boundary, which excites internal modes.
double internal_scale(const Model& model, const Evaluation& evaluation) {
  double scale = evaluation.force_scale[2];
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    if (body.modes == 0) continue;
    const VectorXd acceleration = evaluation.superelements[i].motion.acceleration_B.cwiseAbs();
    scale = std::max(scale, (body.M_IB.cwiseAbs() * acceleration).maxCoeff());
  }
  return scale;
}

/// Convergence test: largest force (moments over the length) and internal force relative to their scales.
bool is_balanced(const Linearisation& l, EquilibriumSearch& search) {
  auto& [model, options, interrupted, state, workspace, report] = search;
  const Evaluation& evaluation = workspace.now;
  const auto boundary = l.r.head(model.sizes.boundary);
  const auto internal = l.r.tail(l.r.size() - model.sizes.boundary);
  report.residual = 0.0;
  for (Eigen::Index i = 0; i < boundary.size(); ++i)
    report.residual = std::max(report.residual, std::abs(boundary[i]) * model.equation_scale[i]);
  report.constraint = evaluation.constraint.size() > 0 ? evaluation.constraint.cwiseAbs().maxCoeff() : 0.0;
  const double largest_internal = internal.size() > 0 ? internal.cwiseAbs().maxCoeff() : 0.0;
  return report.residual <= allowed_force(model, state, evaluation, options.tolerance) &&
         largest_internal <=
             std::max(options.tolerance * internal_scale(model, evaluation), internal_round_off(model, evaluation)) &&
         report.constraint <= options.tolerance * model.length;
}

/// Matrix [K Bᵀ; B 0] in scaled equations and unknowns.
struct Saddle {
  MatrixXd A;
  VectorXd scale;
  double stiffness = 1.0;  ///< the divisor of K
};

/// Scales of equations and unknowns: those of the model for boundary coordinates, 1 for internal ones.
VectorXd scale_of(const Model& model) {
  VectorXd scale = VectorXd::Ones(model.sizes.velocities());
  scale.head(model.sizes.boundary) = model.equation_scale.head(model.sizes.boundary).matrix();
  return scale;
}

Saddle saddle(const Model& model, const State& state, const Linearisation& l) {
  const Eigen::Index n = l.K.rows(), m = l.B.rows();
  Saddle s{MatrixXd::Zero(n + m, n + m), VectorXd(n + m),
           std::max(l.K.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min())};
  s.scale << scale_of(model), active_part(state, model.equation_scale.matrix().tail(model.sizes.constraints));
  s.A.topLeftCorner(n, n) = l.K / s.stiffness;
  s.A.topRightCorner(n, m) = l.B.transpose();
  s.A.bottomLeftCorner(m, n) = l.B;
  s.A = s.scale.asDiagonal() * s.A * s.scale.asDiagonal();
  return s;
}

/// Name of the joint coordinate or node that moves most in a null vector of the system, found by inverse iteration.
std::string name_of_null_vector(const Model& model, const State& state, Saddle s, Evaluation& evaluation) {
  const Eigen::Index n = model.sizes.velocities();
  s.A.diagonal().head(n).array() += 1e-13 * s.A.cwiseAbs().maxCoeff();
  const Eigen::PartialPivLU<MatrixXd> factors(s.A);
  VectorXd d = VectorXd::Ones(s.A.rows());
  for (int iteration = 0; iteration < 3; ++iteration) d = factors.solve(d).normalized();
  return name_of_direction(model, state, s.scale.cwiseProduct(d).head(n), evaluation);
}

/// Solves [K Bᵀ; B 0][ξ; δλ] = [−r; −Φ] and moves the state. Returns ξ. If the matrix is singular, ξ is empty and the
/// report names the direction.
VectorXd improve(const Linearisation& l, EquilibriumSearch& search) {
  auto& [model, options, interrupted, state, workspace, report] = search;
  const Saddle s = saddle(model, state, l);
  const Eigen::PartialPivLU<MatrixXd> factors(s.A);
  if (!(factors.rcond() > free_motion_condition)) {
    report.explanation = name_of_null_vector(model, state, s, workspace.now);
    return {};
  }
  VectorXd right(s.A.rows());
  right << -l.r / s.stiffness, -active_part(state, workspace.now.constraint);
  const VectorXd d = s.scale.cwiseProduct(factors.solve(s.scale.cwiseProduct(right)));
  const VectorXd xi = d.head(l.K.rows());
  move_by(model, xi, s.stiffness * d.tail(l.B.rows()), workspace.now, state);
  return xi;
}

/// The rotation about a fixed axis, in the axes of the model.
struct SteadyTurn {
  const Model& model;
  Vector3d omega, about;  ///< ω and a point p of the axis

  SteadyTurn(const Model& turning, const formats::RotationSpec& rotation)
      : model(turning),
        omega(to_axes(model, rotation.angular_velocity)),
        about(to_axes(model, rotation.about - model.origin)) {}
};

/// Sets ẋ = ω×(x − p), Ω = Rᵀω, ẍ = ω×ẋ, Ω̇ = 0, with internal coordinates at rest.
void set_velocities(const SteadyTurn& turn, State& state) {
  state.v().setZero();
  state.vdot().setZero();
  for (std::size_t i = 0; i < turn.model.nodes.size(); ++i) {
    const Node& node = turn.model.nodes[i];
    const auto column = static_cast<Eigen::Index>(i);
    if (node.translation >= 0) {
      const Vector3d velocity = turn.omega.cross(state.x().col(column) - turn.about);
      set_translation(turn.model, velocity, node.translation, state.v());
      set_translation(turn.model, turn.omega.cross(velocity), node.translation, state.vdot());
    }
    if (node.rotation >= 0)
      set_rotation(turn.model, quaternion(state.Q().col(column)).conjugate() * turn.omega, node.rotation, state.v());
  }
}

/// Linearises in the steady rotation. If the reactions are unknown, those of least residual are set first: they hold a
/// hinged blade against flapping.
Linearisation linearise_turning(const SteadyTurn& turn, State& state, Evaluation& evaluation) {
  set_velocities(turn, state);
  Linearisation l = linearise(turn.model, state, turn.omega, evaluation);
  if (l.B.rows() == 0 || !state.lambda().isZero(0.0) || !l.r.allFinite()) return l;
  const VectorXd scale = scale_of(turn.model);
  const MatrixXd BT = scale.asDiagonal() * l.B.transpose();
  add_to_multipliers(BT.colPivHouseholderQr().solve(-scale.cwiseProduct(l.r)), state);
  return linearise(turn.model, state, turn.omega, evaluation);
}

/// Name of what opens or has other forces after the scene has turned by a radian, in which the time `passed` elapses.
std::string change_by_turn(const SteadyTurn& steady, double passed, const VectorXd& before, State& state,
                           Evaluation& evaluation) {
  constexpr double share = 1e-6;
  const auto& [model, omega, about] = steady;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.0, omega.normalized()));
  const auto turn_columns = [&turn](auto quaternions) {
    for (Eigen::Index i = 0; i < quaternions.cols(); ++i)
      quaternions.col(i) = wxyz(turn * quaternion(quaternions.col(i)));
  };
  for (Eigen::Index i = 0; i < state.x().cols(); ++i) state.x().col(i) = about + turn * (state.x().col(i) - about);
  turn_columns(state.Q());
  turn_columns(state.frames());
  state.time() += passed;
  state.load_time() = state.time();
  set_velocities(steady, state);
  evaluate(model, state, evaluation);
  for (int row = 0; row < model.sizes.constraints; ++row) {
    const bool drive = std::ranges::any_of(
        model.couplings, [&](const Coupling& coupling) { return coupling.row == row && coupling.motion >= 0; });
    if (!drive && violation_of(model, evaluation.constraint, row) > share)
      return fmt::format("'{}' does not rotate with the scene", constraint_name(model, row));
  }
  // Moments have material axes and stay, forces turn. Forces on joints and drives do not matter.
  VectorXd change = evaluation.residual - before;
  for (const Node& node : model.nodes)
    if (const int row = node.translation; row >= 0)
      set_translation(model,
                      translation_at(model, evaluation.residual, row) - turn * translation_at(model, before, row), row,
                      change);
  const VectorXd scale = model.equation_scale.matrix().head(model.sizes.boundary);
  change = change.cwiseProduct(scale);
  const MatrixXd BT =
      scale.asDiagonal() * active_jacobian(model, state, evaluation).leftCols(model.sizes.boundary).transpose();
  if (BT.cols() > 0) change -= BT * BT.colPivHouseholderQr().solve(change);
  const double allowed = std::max(share * force_size(model, evaluation), 1e3 * force_round_off(model, state));
  Eigen::Index at = 0;
  if (change.size() == 0 || !(change.cwiseAbs().maxCoeff(&at) > allowed)) return {};
  return fmt::format("Gravity, a load, a spring or a bushing does not rotate with the scene: its force on {} changes",
                     coordinate_name(model, static_cast<int>(at)));
}

}  // namespace

StepOutcome balance_turning(EquilibriumSearch& search) {
  auto& [model, options, interrupted, state, workspace, report] = search;
  formats::RotationSpec rotation = *options.rotation;
  rotation.angular_velocity *= std::sqrt(workspace.now.load_factor);
  const SteadyTurn turn(model, rotation);
  VectorXd xi;
  for (int iteration = 0;; ++iteration) {
    const Linearisation l = linearise_turning(turn, state, workspace.now);
    const bool done = is_balanced(l, search);
    if (iteration > 0 && (done || xi.cwiseAbs().maxCoeff() < turning_floor * model.length))
      return StepOutcome::accepted;
    if (!l.r.allFinite()) return StepOutcome::diverged;
    report.interrupted = interrupted && interrupted();
    if (iteration == options.max_iterations || report.interrupted) return StepOutcome::too_many_iterations;
    xi = improve(l, search);
    if (xi.size() == 0) return iteration == 0 ? StepOutcome::singular : StepOutcome::diverged;
    ++report.iterations;
  }
}

std::string free_turn_name(const Model& model, const formats::RotationSpec& rotation, State state,
                           Evaluation& evaluation) {
  if (rotation.angular_velocity.isZero(0.0)) return {};
  state.v().setZero();
  state.vdot().setZero();
  const Linearisation l = linearise(model, state, Vector3d::Zero(), evaluation);
  const Vector3d axis = to_axes(model, rotation.angular_velocity.normalized()),
                 about = to_axes(model, rotation.about - model.origin);
  VectorXd turn = VectorXd::Zero(l.r.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.translation >= 0)
      set_translation(model, axis.cross(state.x().col(static_cast<Eigen::Index>(i)) - about), node.translation, turn);
    if (node.rotation >= 0) set_rotation(model, axis, node.rotation, turn);
  }
  const double motion = turn.cwiseAbs().maxCoeff();
  const double gap = l.B.rows() > 0 ? (l.B * turn).cwiseAbs().maxCoeff() : 0.0;
  const double force = (l.K * turn).cwiseAbs().maxCoeff();
  if (gap > 1e-9 * motion || force > turn_resistance * l.K.cwiseAbs().maxCoeff() * motion) return {};
  return name_of_direction(model, state, std::move(turn), evaluation);
}

std::string free_motion_name(const Model& model, const formats::RotationSpec& rotation, State state,
                             Evaluation& evaluation) {
  const Linearisation l = linearise_turning(SteadyTurn(model, rotation), state, evaluation);
  const Saddle s = saddle(model, state, l);
  if (Eigen::PartialPivLU<MatrixXd>(s.A).rcond() > free_motion_condition) return {};
  return name_of_null_vector(model, state, s, evaluation);
}

std::string what_does_not_turn(const Model& model, const formats::RotationSpec& rotation, State state,
                               Evaluation& evaluation) {
  constexpr double round_off = 1e-7;
  const double rate = rotation.angular_velocity.norm();
  if (rate == 0.0) return {};
  const SteadyTurn turn(model, rotation);
  set_velocities(turn, state);
  evaluate(model, state, evaluation);
  for (int row = 0; row < model.sizes.constraints; ++row)
    if (violation_of(model, evaluation.constraint_rate, row) > round_off * rate)
      return fmt::format("'{}' does not allow the velocities of this rotation", constraint_name(model, row));
  const VectorXd before = evaluation.residual;
  const State begin = state;
  std::string found;
  for (const double passed : {1.0 / rate, 0.0}) {  // forces may turn as functions of time, or not depend on it
    state.block() = begin.block();
    found = change_by_turn(turn, passed, before, state, evaluation);
    if (found.empty()) break;
  }
  return found;
}

}  // namespace tisserand::mechanism
