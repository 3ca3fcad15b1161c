// SPDX-License-Identifier: GPL-3.0-or-later
// Newton's iteration: residuals of the stages, increments, tests that end it.
#include "mechanism/radau/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/math/rotation.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/round_off.hpp"
#include "mechanism/model/bodies.hpp"
#include "mechanism/model/node_coordinates.hpp"
#include "mechanism/step/step_control.hpp"
#include "mechanism/step/tuning.hpp"

namespace tisserand::mechanism::radau {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Largest rotation of a node to a stage [rad]. Beyond it rotation vectors are poor unknowns.
constexpr double farthest_turn = 3.0;
/// Largest turn [rad] at which stalled multipliers are accepted. With fresh parts they contract by 2 sin(θ/2) for a
/// turn θ. Below half a radian a stall shows round-off, beyond it the step turns too far.
constexpr double safe_turn = 0.5;

/// Rotation of a node from its axes in the parts to its axes in the state.
Matrix3d turn_since(const State& state, std::size_t node, const Matrix3d& orientation) {
  return quaternion(state.Q().col(static_cast<Eigen::Index>(node))).toRotationMatrix() * orientation.transpose();
}

bool regular(const FactorReport& factors, StepReport& report) {
  if (factors.regular && factors.reciprocal_condition >= singular_condition) return true;
  report.outcome = StepOutcome::singular;
  report.singular_column = factors.singular_column;
  return false;
}

/// Rotates the translations of a node, which begin at `row`. In planar models it rotates about the normal.
template <class Vector>
void turn_translations(const Model& model, const Matrix3d& R, int row, Vector&& v) {
  if (model.planar)
    v.template segment<2>(row) = (R.topLeftCorner<2, 2>() * v.template segment<2>(row)).eval();
  else
    v.template segment<3>(row) = (R * v.template segment<3>(row)).eval();
}

bool same(double a, double b) { return std::abs(a - b) <= same_step * std::abs(b); }

}  // namespace

void set_stage(const Model& model, const State& begin, int stage, const Stages& stages, State& state) {
  const StepEnd& end = stages.end;
  const double time = stage == 2 ? end.time : begin.time() + coefficients().c[stage] * stages.step;
  state.time() = time;
  state.load_time() = stage == 2 ? end.load_time : std::min(time, end.load_time);
  retract(model, begin, stages.d.col(stage), state);
  state.v() = stages.v.col(stage);
  state.vdot() = stages.a.col(stage);
  state.lambda() = stages.lambda.col(stage);
}

Newton::Newton(const Model& model)
    : correction(Eigen::VectorXd::Zero(model.sizes.velocities())),
      model_(model),
      parts_(model),
      real_(model),
      complex_(model),
      f_(Stages::Columns::Zero(model.sizes.velocities(), 3)),
      g_(Stages::Columns::Zero(model.sizes.constraints, 3)),
      real_upper_(correction),
      real_rows_(Eigen::VectorXd::Zero(model.sizes.constraints)),
      first_(correction),
      second_(correction),
      complex_upper_(Eigen::VectorXcd::Zero(model.sizes.velocities())),
      complex_rows_(Eigen::VectorXcd::Zero(model.sizes.constraints)) {
  axes_ = parts_.orientation;
  for_each_body(model, [&](const auto& body) {
    if (!is_flexible(body)) return;
    for (const int node : attached_nodes(model, body)) {
      const bool turns = node >= 0 && model.nodes[node].translation >= 0 && model.nodes[node].rotation >= 0;
      if (turns && std::ranges::count(turning_, node) == 0) turning_.push_back(node);
    }
  });
  for (const int node : turning_) turning_rows_.push_back(model.nodes[node].translation);
  for (Turns& turns : turns_) turns.assign(model.nodes.size(), Matrix3d::Identity());
}

void Newton::renew(const State& state, Evaluation& evaluation) {
  parts_.take(state, evaluation);
  real_step_ = complex_step_ = 0.0;
}

void Newton::forget() {
  parts_.valid = false;
  real_step_ = complex_step_ = 0.0;
  real_.forget();
  complex_.forget();
  contraction_ = 0.0;
  confidence_ = 1.0;
}

bool Newton::ready_real(double step, StepReport& report) {
  if (same(step, real_step_)) return true;
  real_step_ = 0.0;
  ++report.factorisations;
  axes_ = parts_.orientation;
  if (!regular(real_.factor(model_, parts_, coefficients().gamma / step), report)) return false;
  real_step_ = step;
  return true;
}

bool Newton::ready(double step, StepReport& report) {
  if (!ready_real(step, report)) return false;
  if (same(step, complex_step_)) return true;
  complex_step_ = 0.0;
  if (!regular(complex_.factor(model_, parts_, coefficients().pair / step), report)) return false;
  complex_step_ = step;
  return true;
}

void Newton::evaluate_stage(const State& begin, int stage, Stages& stages, State& state, Evaluation& evaluation) {
  set_stage(model_, begin, stage, stages, state);
  evaluate(model_, state, evaluation);
  auto f = f_.col(stage);
  gather_residual(model_, evaluation, f);
  f = -f;
  g_.col(stage) = -evaluation.constraint_rate.cwiseProduct(evaluation.active);
  for_turning_nodes([&](std::size_t node, int row) {
    Matrix3d& turn = turns_[stage][node];
    turn.noalias() = evaluation.motion[node].R * axes_[node].transpose();
    turn_translations(model_, turn.transpose(), row, f);
  });
  stages.load_power[stage] = evaluation.load_power;
  stages.damping_power[stage] = damping_power(model_, evaluation);
}

void Newton::solve(const State& begin, Stages& stages) {
  const Coefficients& method = coefficients();
  const std::complex<double> pair = method.pair / complex_step_;
  const double gamma = method.gamma / real_step_;
  const auto transformed = [&](const Stages::Columns& x, int row) {
    return x.lazyProduct(method.T_inverse.row(row).transpose());
  };
  first_ = begin.active();
  real_upper_ = transformed(f_, 0);
  real_rows_ = transformed(g_, 0) / gamma;
  real_.solve(model_, first_, real_upper_, real_rows_);
  complex_upper_.real() = transformed(f_, 1);
  complex_upper_.imag() = transformed(f_, 2);
  complex_rows_.real() = transformed(g_, 1);
  complex_rows_.imag() = transformed(g_, 2);
  complex_rows_ /= pair;
  complex_.solve(model_, first_, complex_upper_, complex_rows_);
  for (int i = 0; i < 3; ++i) {
    f_.col(i) =
        method.T(i, 0) * real_upper_ + method.T(i, 1) * complex_upper_.real() + method.T(i, 2) * complex_upper_.imag();
    g_.col(i) =
        method.T(i, 0) * real_rows_ + method.T(i, 1) * complex_rows_.real() + method.T(i, 2) * complex_rows_.imag();
  }
  for (int i = 0; i < 3; ++i) {
    auto d = f_.col(i);
    for_turning_nodes([&](std::size_t node, int row) { turn_translations(model_, turns_[i][node], row, d); });
    for (const Node& node : model_.nodes) {
      if (node.rotation < 0 || model_.planar) continue;
      const Vector3d theta = stages.d.col(i).segment<3>(node.rotation);
      d.segment<3>(node.rotation) = (inverse_tangent_so3<double>(theta) * d.segment<3>(node.rotation)).eval();
    }
  }
}

/// Largest increment of the multipliers relative to the allowed one. No other test contains rows that move no body.
/// Without this test, multipliers across the plane of a plane mechanism would grow from step to step after a turn of 60
/// degrees since the parts were made. `share`: allowed increment relative to the forces, or near singular positions to
/// the multipliers.
double Newton::measure_multipliers(const State& begin, const Evaluation& evaluation, double share,
                                   const Stages::Columns& lambda) const {
  const auto scale = [&](int kind) { return std::max(begin.force_scale(kind), evaluation.force_scale[kind]); };
  double force = std::max(scale(0), scale(1) / model_.length), worst = 0.0;
  for (int row = 0; row < model_.sizes.constraints; ++row) {
    const double unit = model_.length_row[row] ? 1.0 : model_.length;
    force = std::max(force, lambda.row(row).cwiseAbs().maxCoeff() / unit);
    worst = std::max(worst, g_.row(row).cwiseAbs().maxCoeff() / unit);
  }
  return worst / (std::max(share * force, force_round_off(model_, begin)) + 1e-300);
}

bool Newton::iterate(const Accuracy& accuracy, Stages& stages, State& state, Workspace& workspace, StepReport& report) {
  const State& begin = workspace.memory.previous;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  double last = 0.0, last_ratio = 0.0, last_rows = 0.0;
  bool placed = false;                                                // positions have converged
  double confidence = std::pow(std::max(confidence_, epsilon), 0.8);  // IV.8 (8.11)
  contraction_ = 0.0;
  shorter_ = 0.5;
  const auto fails = [&](StepOutcome outcome) {
    report.outcome = outcome;
    return false;
  };
  for (int count = 1;; ++count) {
    for (int stage = 0; stage < 3; ++stage) evaluate_stage(begin, stage, stages, state, workspace.now);
    solve(begin, stages);
    ++report.iterations;
    LocalError size;
    for (int stage = 0; stage < 3; ++stage) {
      const LocalError one = measure_error(model_, accuracy.units, 1.0, f_.col(stage));
      if (one.ratio > size.ratio || std::isnan(one.ratio)) size = one;
    }
    report.worst_coordinate = size.worst_coordinate;
    if (!std::isfinite(size.ratio) || !g_.allFinite()) return fails(StepOutcome::diverged);
    if (count > 1 && !placed) {
      const double ratio = last > 0.0 ? size.ratio / last : 0.0;
      contraction_ = count == 2 ? ratio : std::sqrt(ratio * last_ratio);
      last_ratio = ratio;
      const double floor = 4.0 * epsilon / accuracy.units.tolerance;
      if (contraction_ >= 0.99 && size.ratio > floor) return fails(StepOutcome::too_many_iterations);
      if (contraction_ < 0.99) {
        confidence = contraction_ / (1.0 - contraction_);
        const int left = accuracy.most_iterations - 1 - count;
        const double predicted = confidence * size.ratio * std::pow(contraction_, left) / accuracy.newton;
        report.force_ratio = confidence * size.ratio / accuracy.newton;
        if (predicted >= 1.0) {
          shorter_ = 0.8 * std::pow(std::clamp(predicted, 1e-4, 20.0), -1.0 / (4.0 + std::max(left, 0)));
          return fails(StepOutcome::too_many_iterations);
        }
      } else {
        confidence = 0.0;  // round-off
      }
    }
    last = std::max(size.ratio, epsilon);
    stages.d += f_;
    stages.lambda += g_;
    if (stages.d.cwiseAbs().maxCoeff() > 1e100) return fails(StepOutcome::diverged);
    double turn = 0.0;
    for (const Node& node : model_.nodes)
      if (node.rotation >= 0)
        turn = std::max(turn, stages.d.middleRows(node.rotation, rotations_of(model_)).cwiseAbs().maxCoeff());
    if (turn > farthest_turn) return fails(StepOutcome::too_many_iterations);
    update_rates(model_, stages);
    placed = placed || confidence * size.ratio <= accuracy.newton;
    const double rows = measure_multipliers(begin, workspace.now, accuracy.multipliers, stages.lambda);
    if (placed && rows <= 1.0) break;
    const bool stalled = last_rows > 0.0 && rows > 0.9 * last_rows;
    // Multipliers that do not converge are accepted only if no node turns far.
    if (placed && stalled && accuracy.fresh_parts && turn < safe_turn) break;
    if (placed && (stalled || count >= accuracy.most_iterations)) return fails(StepOutcome::too_many_iterations);
    last_rows = rows;
  }
  confidence_ = confidence;
  report.worst_coordinate = -1;
  return true;
}

void Newton::project(const Eigen::VectorXd& violation, const Evaluation& evaluation) {
  correction.setZero();
  real_rows_ = -violation;
  first_ = evaluation.active;
  real_.solve(model_, first_, correction, real_rows_);
  for_turning_nodes([&](std::size_t node, int row) {
    turn_translations(model_, evaluation.motion[node].R * axes_[node].transpose(), row, correction);
  });
}

void Newton::estimate(const Stages& stages, const State& begin) {
  const Coefficients& method = coefficients();
  const double omega = method.gamma / stages.step;
  // e_q in correction, e_v in first_; then the vectors that M and C multiply.
  correction = stages.d.lazyProduct(method.e) + stages.v_begin / omega;
  first_ = stages.v.lazyProduct(method.e) - method.e.sum() * stages.v_begin + stages.a_begin / omega;
  for_turning_nodes([&](std::size_t node, int row) {
    const Matrix3d back = turn_since(begin, node, axes_[node]).transpose();
    turn_translations(model_, back, row, correction);
    turn_translations(model_, back, row, first_);
  });
  first_ = omega * omega * correction + omega * first_;
  second_ = omega * correction;
  real_upper_.setZero();
  real_rows_.setZero();
  parts_.multiply(first_, second_, correction, real_upper_, real_rows_);
  correction = real_upper_;
  first_ = begin.active();
  real_.solve(model_, first_, correction, real_rows_);
}

}  // namespace tisserand::mechanism::radau
