// Newton's iteration in turning axes.
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
/// Forces against a turn of the whole scene, relative to the largest stiffness, that are round-off.
constexpr double turn_resistance = 1e-13;

/// Largest internal force of any single term: also the inertia of the boundary, which excites internal modes.
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

/// What the iteration tests: largest force (moments over the length) and internal force against their scales.
bool balanced(const Model& model, const formats::StaticsSpec& options, const State& state, const Linearisation& l,
              const Evaluation& evaluation, StaticsReport& report) {
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

/// [K Bᵀ; B 0] in scaled equations and unknowns.
struct Saddle {
  MatrixXd A;
  VectorXd scale;
  double stiffness = 1.0;  ///< by which K was divided
};

Saddle saddle(const Model& model, const State& state, const Linearisation& l) {
  const Eigen::Index n = l.K.rows(), m = l.B.rows();
  Saddle s{MatrixXd::Zero(n + m, n + m), VectorXd::Ones(n + m),
           std::max(l.K.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min())};
  s.scale.head(model.sizes.boundary) = model.equation_scale.head(model.sizes.boundary).matrix();
  const std::vector<int> rows = active_rows(state);
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (rows[row] >= 0)
      s.scale[n + rows[row]] = model.equation_scale[model.sizes.boundary + static_cast<Eigen::Index>(row)];
  s.A.topLeftCorner(n, n) = l.K / s.stiffness;
  s.A.topRightCorner(n, m) = l.B.transpose();
  s.A.bottomLeftCorner(m, n) = l.B;
  s.A = s.scale.asDiagonal() * s.A * s.scale.asDiagonal();
  return s;
}

/// The joint coordinate, or the node, that moves most in a null vector of the system, which inverse iteration finds.
std::string name_of_null_vector(const Model& model, const State& state, Saddle s, Evaluation& evaluation) {
  const Eigen::Index n = model.sizes.velocities();
  s.A.diagonal().head(n).array() += 1e-13 * s.A.cwiseAbs().maxCoeff();
  const Eigen::PartialPivLU<MatrixXd> factors(s.A);
  VectorXd d = VectorXd::Ones(s.A.rows());
  for (int iteration = 0; iteration < 3; ++iteration) d = factors.solve(d).normalized();
  return name_of_direction(model, state, s.scale.cwiseProduct(d).head(n), evaluation);
}

/// Solves [K Bᵀ; B 0][ξ; δλ] = [−r; −Φ]. False, with the name of the direction, if it is singular.
bool solve(const Model& model, const State& state, const Linearisation& l, Evaluation& evaluation, VectorXd& xi,
           VectorXd& multipliers, std::string& free) {
  const Eigen::Index n = l.K.rows(), m = l.B.rows();
  const Saddle s = saddle(model, state, l);
  const Eigen::PartialPivLU<MatrixXd> factors(s.A);
  if (!(factors.rcond() > free_motion_condition)) {
    free = name_of_null_vector(model, state, s, evaluation);
    return false;
  }
  VectorXd right(n + m);
  right.head(n) = -l.r / s.stiffness;
  const std::vector<int> rows = active_rows(state);
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (rows[row] >= 0) right[n + rows[row]] = -evaluation.constraint[row];
  const VectorXd d = s.scale.cwiseProduct(factors.solve(s.scale.cwiseProduct(right)));
  xi = d.head(n);
  multipliers = s.stiffness * d.tail(m);
  return true;
}

/// The linearisation in the steady rotation. Where no reactions are known, those that balance it best come first: it is
/// they that hold a blade on a hinge against flapping.
Linearisation linearise_turning(const Model& model, const formats::RotationSpec& rotation, State& state,
                                Evaluation& evaluation) {
  turn_steadily(model, rotation, state);
  Linearisation l = linearise(model, state, to_axes(model, rotation.angular_velocity), evaluation);
  if (l.B.rows() == 0 || !state.lambda().isZero(0.0) || !l.r.allFinite()) return l;
  VectorXd scale = VectorXd::Ones(l.r.size());
  scale.head(model.sizes.boundary) = model.equation_scale.head(model.sizes.boundary).matrix();
  const MatrixXd BT = scale.asDiagonal() * l.B.transpose();
  const VectorXd multipliers = BT.colPivHouseholderQr().solve(-scale.cwiseProduct(l.r));
  const std::vector<int> rows = active_rows(state);
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (rows[row] >= 0) state.lambda()[row] = multipliers[rows[row]];
  return linearise(model, state, to_axes(model, rotation.angular_velocity), evaluation);
}

StepOutcome balance(const Model& model, const formats::StaticsSpec& options, const Interrupt& interrupted, State& state,
                    Evaluation& evaluation, StaticsReport& report) {
  formats::RotationSpec rotation = *options.rotation;
  rotation.angular_velocity *= std::sqrt(evaluation.load_factor);
  VectorXd xi, multipliers;
  for (int iteration = 0;; ++iteration) {
    const Linearisation l = linearise_turning(model, rotation, state, evaluation);
    const bool done = balanced(model, options, state, l, evaluation, report);
    if (iteration > 0 && (done || xi.cwiseAbs().maxCoeff() < turning_floor * model.length))
      return StepOutcome::accepted;
    if (!l.r.allFinite()) return StepOutcome::diverged;
    report.interrupted = interrupted && interrupted();
    if (iteration == options.max_iterations || report.interrupted) return StepOutcome::too_many_iterations;
    if (!solve(model, state, l, evaluation, xi, multipliers, report.explanation))
      return iteration == 0 ? StepOutcome::singular : StepOutcome::diverged;
    move_by(model, xi, multipliers, evaluation, state);
    ++report.iterations;
  }
}

}  // namespace

void turn_steadily(const Model& model, const formats::RotationSpec& rotation, State& state) {
  const Vector3d omega = to_axes(model, rotation.angular_velocity),
                 about = to_axes(model, rotation.about - model.origin);
  state.v().setZero();
  state.vdot().setZero();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    const auto column = static_cast<Eigen::Index>(i);
    if (node.translation >= 0) {
      const Vector3d velocity = omega.cross(state.x().col(column) - about);
      set_translation(model, velocity, node.translation, state.v());
      set_translation(model, omega.cross(velocity), node.translation, state.vdot());
    }
    if (node.rotation >= 0) {
      const Eigen::Vector4d Q = state.Q().col(column);
      set_rotation(model, Eigen::Quaterniond(Q[0], Q[1], Q[2], Q[3]).conjugate() * omega, node.rotation, state.v());
    }
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
  const Linearisation l = linearise_turning(model, rotation, state, evaluation);
  const Saddle s = saddle(model, state, l);
  if (Eigen::PartialPivLU<MatrixXd>(s.A).rcond() > free_motion_condition) return {};
  return name_of_null_vector(model, state, s, evaluation);
}

namespace {

/// What is open or has other forces once the scene has turned by a radian, in which `passed` of time passes.
std::string change_by_turn(const Model& model, const formats::RotationSpec& rotation, double passed,
                           const VectorXd& before, State& state, Evaluation& evaluation) {
  constexpr double share = 1e-6;
  const Vector3d about = to_axes(model, rotation.about - model.origin);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.0, to_axes(model, rotation.angular_velocity).normalized()));
  const auto turn_columns = [&](auto quaternions) {
    for (Eigen::Index i = 0; i < quaternions.cols(); ++i) {
      const Eigen::Vector4d Q = quaternions.col(i);
      quaternions.col(i) = wxyz(turn * Eigen::Quaterniond(Q[0], Q[1], Q[2], Q[3]));
    }
  };
  for (Eigen::Index i = 0; i < state.x().cols(); ++i) state.x().col(i) = about + turn * (state.x().col(i) - about);
  turn_columns(state.Q());
  turn_columns(state.frames());
  state.time() += passed;
  state.load_time() = state.time();
  turn_steadily(model, rotation, state);
  evaluate(model, state, evaluation);
  for (int row = 0; row < model.sizes.constraints; ++row) {
    const bool drive = std::ranges::any_of(
        model.couplings, [&](const Coupling& coupling) { return coupling.row == row && coupling.motion >= 0; });
    if (!drive && violation_of(model, evaluation.constraint, row) > share)
      return fmt::format("'{}' does not turn with the scene", constraint_name(model, row));
  }
  // Moments have material axes and stay, forces turn. What joints and drives take does not move anything.
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
  return fmt::format("Gravity, a load, a spring or a bushing does not turn with the scene: what it does to {} changes",
                     coordinate_name(model, static_cast<int>(at)));
}

}  // namespace

std::string what_does_not_turn(const Model& model, const formats::RotationSpec& rotation, State state,
                               Evaluation& evaluation) {
  constexpr double round_off = 1e-7;
  const double rate = rotation.angular_velocity.norm();
  if (rate == 0.0) return {};
  turn_steadily(model, rotation, state);
  evaluate(model, state, evaluation);
  for (int row = 0; row < model.sizes.constraints; ++row)
    if (violation_of(model, evaluation.constraint_rate, row) > round_off * rate)
      return fmt::format("'{}' forbids the velocities of the turn", constraint_name(model, row));
  const VectorXd before = evaluation.residual;
  const State begin = state;
  std::string found;
  for (const double passed : {1.0 / rate, 0.0}) {  // forces may turn by functions of time, or not depend on it
    state.block() = begin.block();
    found = change_by_turn(model, rotation, passed, before, state, evaluation);
    if (found.empty()) break;
  }
  return found;
}

StaticsReport solve_steady_rotation(const Model& model, const formats::StaticsSpec& options,
                                    const Interrupt& interrupted, State& state, Evaluation& evaluation) {
  StaticsReport report;
  ramp_loads(model, options, state, evaluation, report,
             [&] { return balance(model, options, interrupted, state, evaluation, report); });
  return report;
}

}  // namespace tisserand::mechanism
