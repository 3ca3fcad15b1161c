// Newton's iteration in turning axes.
#include "mechanism/analyses/steady_rotation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/LU>

#include "mechanism/analyses/linearise.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double turning_floor = 1e-13;

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
bool balanced(const Model& model, const formats::StaticsSpec& options, const Linearisation& l,
              const Evaluation& evaluation, StaticsReport& report) {
  const auto boundary = l.r.head(model.sizes.boundary);
  const auto internal = l.r.tail(l.r.size() - model.sizes.boundary);
  report.residual = 0.0;
  for (Eigen::Index i = 0; i < boundary.size(); ++i)
    report.residual = std::max(report.residual, std::abs(boundary[i]) * model.equation_scale[i]);
  report.constraint = evaluation.constraint.size() > 0 ? evaluation.constraint.cwiseAbs().maxCoeff() : 0.0;
  const double force = std::max(evaluation.force_scale[0], evaluation.force_scale[1] / model.length);
  const double round_off = 4.0 * std::numeric_limits<double>::epsilon() * model.stiffness_scale * model.length;
  const double largest_internal = internal.size() > 0 ? internal.cwiseAbs().maxCoeff() : 0.0;
  return report.residual <= std::max(options.tolerance * force, round_off) &&
         largest_internal <= options.tolerance * internal_scale(model, evaluation) &&
         report.constraint <= options.tolerance * model.length;
}

/// Solves [K Bᵀ; B 0][ξ; δλ] = [−r; −Φ] in scaled equations. False, with the name of the direction, if it is singular.
bool solve(const Model& model, const State& state, const Linearisation& l, const Evaluation& evaluation, VectorXd& xi,
           VectorXd& multipliers, std::string& free) {
  const Eigen::Index n = l.K.rows(), m = l.B.rows();
  const double stiffness = std::max(l.K.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  VectorXd scale = VectorXd::Ones(n + m), right(n + m);
  scale.head(model.sizes.boundary) = model.equation_scale.head(model.sizes.boundary).matrix();
  right.head(n) = -l.r / stiffness;
  const std::vector<int> rows = active_rows(state);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (rows[row] < 0) continue;
    scale[n + rows[row]] = model.equation_scale[model.sizes.boundary + static_cast<Eigen::Index>(row)];
    right[n + rows[row]] = -evaluation.constraint[row];
  }
  MatrixXd A = MatrixXd::Zero(n + m, n + m);
  A.topLeftCorner(n, n) = l.K / stiffness;
  A.topRightCorner(n, m) = l.B.transpose();
  A.bottomLeftCorner(m, n) = l.B;
  A = scale.asDiagonal() * A * scale.asDiagonal();
  const Eigen::PartialPivLU<MatrixXd> factors(A);
  if (!(factors.rcond() > free_motion_condition)) {
    Eigen::Index at = 0;
    factors.solve(VectorXd::Ones(n + m)).head(n).cwiseAbs().maxCoeff(&at);
    free = coordinate_name(model, static_cast<int>(at));
    return false;
  }
  const VectorXd d = scale.cwiseProduct(factors.solve(scale.cwiseProduct(right)));
  xi = d.head(n);
  multipliers = stiffness * d.tail(m);
  return true;
}

/// Rotation increments in world axes to the material ones of retract().
void apply(const Model& model, const VectorXd& xi, const VectorXd& multipliers, const Evaluation& evaluation,
           State& state) {
  VectorXd d = xi;
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (const int row = model.nodes[i].rotation; row >= 0)
      d.segment<3>(row) = (evaluation.motion[i].R.transpose() * xi.segment<3>(row)).eval();
  const State before = state;
  retract(model, before, d, state);
  const std::vector<int> rows = active_rows(state);
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (rows[row] >= 0) state.lambda()[row] += multipliers[rows[row]];
}

StepOutcome balance(const Model& model, const formats::StaticsSpec& options, const Interrupt& interrupted, State& state,
                    Evaluation& evaluation, StaticsReport& report) {
  formats::RotationSpec rotation = *options.rotation;
  rotation.angular_velocity *= std::sqrt(evaluation.load_factor);
  VectorXd xi, multipliers;
  for (int iteration = 0;; ++iteration) {
    turn_steadily(model, rotation, state);
    const Linearisation l = linearise(model, state, rotation.angular_velocity, evaluation);
    const bool done = balanced(model, options, l, evaluation, report);
    if (iteration > 0 && (done || xi.cwiseAbs().maxCoeff() < turning_floor * model.length))
      return StepOutcome::accepted;
    if (!l.r.allFinite()) return StepOutcome::diverged;
    report.interrupted = interrupted && interrupted();
    if (iteration == options.max_iterations || report.interrupted) return StepOutcome::too_many_iterations;
    if (!solve(model, state, l, evaluation, xi, multipliers, report.explanation))
      return iteration == 0 ? StepOutcome::singular : StepOutcome::diverged;
    apply(model, xi, multipliers, evaluation, state);
    ++report.iterations;
  }
}

}  // namespace

void turn_steadily(const Model& model, const formats::RotationSpec& rotation, State& state) {
  const Vector3d& omega = rotation.angular_velocity;
  state.v().setZero();
  state.vdot().setZero();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    const auto column = static_cast<Eigen::Index>(i);
    if (node.translation >= 0) {
      const Vector3d velocity = omega.cross(state.x().col(column) - (rotation.about - model.origin));
      state.v().segment<3>(node.translation) = velocity;
      state.vdot().segment<3>(node.translation) = omega.cross(velocity);
    }
    if (node.rotation >= 0) {
      const Eigen::Vector4d Q = state.Q().col(column);
      state.v().segment<3>(node.rotation) = Eigen::Quaterniond(Q[0], Q[1], Q[2], Q[3]).conjugate() * omega;
    }
  }
}

StaticsReport solve_steady_rotation(const Model& model, const formats::StaticsSpec& options,
                                    const Interrupt& interrupted, State& state, Evaluation& evaluation) {
  StaticsReport report;
  ramp_loads(model, options, state, evaluation, report,
             [&] { return balance(model, options, interrupted, state, evaluation, report); });
  return report;
}

}  // namespace tisserand::mechanism
