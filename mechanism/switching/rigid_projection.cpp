// Weight, Newton's iteration for positions, one solution for velocities.
#include "mechanism/switching/rigid_projection.hpp"

#include <cmath>
#include <limits>

#include "common/error.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"

namespace tisserand::mechanism {
namespace {

/// Of directions without mass and stiffness, relative to the largest weight (as in step/position_projection.cpp).
constexpr double least_weight = 1e-12;
/// Where positions are met, relative to the characteristic length; what must be reached; the most iterations.
constexpr double met = 1e-14, closed = 1e-9;
constexpr int most_iterations = 20;

/// Of rows that count, positions relative to the length.
double largest_gap(const Model& model, const Evaluation& now) {
  double largest = 0.0;
  for (int row = 0; row < model.sizes.constraints; ++row) {
    const double gap = std::abs(now.active[row] * now.constraint[row]) / (model.length_row[row] ? model.length : 1.0);
    if (!(gap <= largest)) largest = gap;
  }
  return largest;
}

}  // namespace

RigidProjection::RigidProjection(const Model& model, double time)
    : model_(model), time_(time), system_(model), change_(model.sizes.velocities()) {}

const Eigen::VectorXd& RigidProjection::change(const State& state, const Eigen::VectorXd& open, Evaluation& now) {
  evaluate_weight(model_, state, {1.0, 0.0, time_ * time_}, now, system_.matrix);
  const int n = model_.sizes.boundary;
  for (int i = 0; i < n; ++i)
    system_.matrix.values[model_.pattern->slot(i, i)] +=
        least_weight / (model_.equation_scale[i] * model_.equation_scale[i]);
  if (!system_.factor(model_).regular)
    throw Error("the joints cannot be closed: their rows depend on each other", "", "");
  system_.unknowns.head(n).setZero();
  system_.unknowns.tail(model_.sizes.constraints) = -open.cwiseProduct(now.active);
  system_.solve(model_);
  change_.setZero();
  change_.head(n) = system_.unknowns.head(n);
  return change_;
}

void RigidProjection::positions(State& state, Evaluation& now) {
  double last = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    evaluate(model_, state, now);
    const double gap = largest_gap(model_, now);
    if (gap <= met || (gap <= closed && gap > 0.5 * last)) return;  // to round-off
    last = gap;
    const State before = state;
    retract(model_, before, change(state, now.constraint, now), state);
  }
  evaluate(model_, state, now);
  if (!(largest_gap(model_, now) <= closed)) throw Error("the joints cannot be closed", "", "");
}

void RigidProjection::velocities(State& state, Evaluation& now) {
  evaluate(model_, state, now);
  state.v() += change(state, now.constraint_rate, now);
}

}  // namespace tisserand::mechanism
