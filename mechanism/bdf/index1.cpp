// SPDX-License-Identifier: GPL-3.0-or-later
// Accelerations from [M Bᵀ; B 0], projection in the mass norm.
#include "mechanism/bdf/index1.hpp"

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "mechanism/equations/round_off.hpp"
#include "mechanism/model/node_coordinates.hpp"
#include "mechanism/step/accept.hpp"

namespace tisserand::mechanism {
namespace {

/// Smallest ratio of pivots at which a mass matrix counts as regular.
constexpr double mass_condition = 1e-15;
/// Limit of violations, relative to the characteristic length; smaller ones are round-off.
constexpr double closed = 1e-13;
constexpr int most_projections = 5;
/// Largest number of iterations for accelerations and reactions that friction couples, and their tolerance.
constexpr int most_iterations = 30;
constexpr double settled = 1e-12;

int offset_of(const State& state, const std::string& name) {
  for (const StateField& field : state.fields())
    if (field.name == name) return field.offset;
  TISSERAND_ENSURE(false, "no field {}", name);
  return 0;
}

}  // namespace

FlatLayout flat_layout(const State& state) {
  FlatLayout layout;
  layout.first = offset_of(state, "x");
  layout.positions = offset_of(state, "v") - layout.first;
  layout.velocities = state.sizes().velocities();
  layout.rest = layout.positions - 7 * state.sizes().nodes;
  return layout;
}

Index1::Index1(const formats::Scene& scene, const Model& model, State& state, Workspace& workspace)
    : scene_(scene), model_(model), state_(state), workspace_(workspace), layout_(flat_layout(state)) {}

void Index1::load(double time, const LoadWindow& window, const double* y) {
  std::copy_n(y, layout_.size(), state_.block().data() + layout_.first);
  auto Q = state_.Q();
  for (Eigen::Index i = 0; i < Q.cols(); ++i) Q.col(i).normalize();
  state_.time() = time;
  state_.load_time() = std::clamp(time, window.from, window.to);
}

void Index1::factor_mass() {
  const FactorReport factors =
      workspace_.matrix.factor(model_, state_, {{1.0, 0.0, 0.0}, TangentKind::step, {}}, workspace_.now);
  ++factorisations_;
  if (factors.regular && factors.reciprocal_condition >= mass_condition) return;
  std::string name = "a direction of the scene";
  if (factors.regular)
    name = workspace_.matrix.weakest_equation(model_);
  else if (factors.singular_column >= 0)
    name = factors.singular_column < model_.sizes.boundary
               ? coordinate_name(model_, factors.singular_column)
               : constraint_name(model_, factors.singular_column - model_.sizes.boundary);
  throw Error(fmt::format("integrator: method: bdf needs mass in every free direction and no redundant constraint "
                          "equations; {} has no mass or is redundant",
                          name),
              scene_.file, "use method: generalised_alpha with error_control, or add mass and inertia there");
}

bool Index1::try_accelerate() {
  if (!Eigen::Map<const Eigen::VectorXd>(state_.block().data() + layout_.first, layout_.size()).allFinite())
    return false;
  const bool rubs = !model_.frictions.empty();
  state_.vdot().setZero();
  if (!rubs) state_.lambda().setZero();
  ++evaluations_;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    evaluate(model_, state_, workspace_.now);
    factor_mass();
    evaluate_bias(model_, workspace_.now);
    apply_jacobian(model_, workspace_.now, state_.vdot(), workspace_.matrix.rows);
    workspace_.matrix.rows = -workspace_.now.bias - workspace_.matrix.rows;
    workspace_.matrix.solve_increment(model_, workspace_.matrix.rows, workspace_.now);
    state_.vdot() += workspace_.matrix.increment;
    state_.lambda() += workspace_.matrix.multipliers;
    workspace_.now.load_power += drive_power(model_, workspace_.matrix.multipliers, workspace_.now);
    if (!rubs) return true;
    if (!state_.lambda().allFinite()) break;
    if (workspace_.matrix.multipliers.norm() <= settled * state_.lambda().norm()) return true;
    if (is_round_off(model_, state_, workspace_.now, workspace_.matrix.multipliers)) return true;
  }
  state_.lambda().setZero();
  return false;
}

void Index1::accelerate() {
  if (!try_accelerate())
    throw Error("the accelerations do not converge: reactions and friction of the joints amplify each other",
                scene_.file, "reduce `coefficient` of the friction, or increase its `velocity`");
}

void Index1::rates(const double* y, double* ydot) const {
  std::fill_n(ydot, layout_.positions, 0.0);
  const int nodes = state_.sizes().nodes;
  const auto v = state_.v();
  for (int i = 0; i < nodes; ++i) {
    const Node& node = model_.nodes[i];
    if (node.translation >= 0) Eigen::Map<Eigen::Vector3d>(ydot + 3 * i) = translation_at(model_, v, node.translation);
    if (node.rotation < 0) continue;
    const Eigen::Map<const Eigen::Vector4d> p(y + 3 * nodes + 4 * i);
    const Eigen::Vector3d e = p.tail<3>(), Omega = rotation_at(model_, v, node.rotation);
    double* pdot = ydot + 3 * nodes + 4 * i;
    pdot[0] = -0.5 * e.dot(Omega);
    Eigen::Map<Eigen::Vector3d>(pdot + 1) = 0.5 * (p[0] * Omega + e.cross(Omega));
  }
  Eigen::Map<Eigen::VectorXd>(ydot + 7 * nodes, layout_.rest) = v.tail(layout_.rest);
  Eigen::Map<Eigen::VectorXd>(ydot + layout_.positions, layout_.velocities) = state_.vdot();
}

double Index1::worst_violation() const { return largest_violation(model_, workspace_.now, Rows::solved).value; }

double Index1::violation() const { return worst_violation() * model_.length; }

bool Index1::project() {
  if (model_.sizes.constraints == 0) return true;
  // Without reactions there is no friction, whose derivatives would change the mass norm of the projection.
  reactions_ = state_.lambda();
  state_.lambda().setZero();
  const bool done = project_without_reactions();
  state_.lambda() = reactions_;
  return done;
}

bool Index1::project_without_reactions() {
  double last = 0.0;
  for (int iteration = 0;; ++iteration) {
    evaluate(model_, state_, workspace_.now);
    const double worst = worst_violation();
    if (!std::isfinite(worst)) return false;
    if (iteration == 0 || worst > closed) factor_mass();
    // Near singular positions round-off keeps the violation above the limit.
    if (worst <= closed || (iteration > 1 && worst > 0.5 * last && worst < 1e-10)) break;
    if (iteration == most_projections) return false;
    last = worst;
    workspace_.memory.previous.block() = state_.block();
    workspace_.matrix.rows = -workspace_.now.constraint;
    workspace_.matrix.solve_projection(model_, workspace_.matrix.rows, workspace_.now);
    retract(model_, workspace_.memory.previous, workspace_.matrix.correction, state_);
  }
  workspace_.matrix.rows = -workspace_.now.constraint_rate;
  workspace_.matrix.solve_projection(model_, workspace_.matrix.rows, workspace_.now);
  state_.v() += workspace_.matrix.correction;
  return true;
}

void Index1::settle() {
  mechanism::settle(model_, workspace_.now, state_);
  state_.load_power() = workspace_.now.load_power;
  state_.damping_power() = damping_power(model_, workspace_.now);
}

void Index1::tolerances(double* absolute) const {
  const double tolerance = scene_.integrator.bdf.absolute_tolerance;
  const int nodes = state_.sizes().nodes;
  std::fill_n(absolute, 3 * nodes, tolerance * model_.length);
  std::fill_n(absolute + 3 * nodes, layout_.size() - 3 * nodes, tolerance);
  double* v = absolute + layout_.positions;
  for (const Node& node : model_.nodes)
    if (node.translation >= 0) std::fill_n(v + node.translation, translations_of(model_), tolerance * model_.length);
  // Internal coordinates and modes of a body of mass m are lengths times sqrt(m); they stand at the end of both parts.
  const int internal = model_.sizes.internal;
  for (const ModalBody& body : model_.modal_bodies) {
    const double unit = tolerance * model_.length * std::sqrt(body.mass);
    const int at = body.offset - internal - model_.sizes.modal;
    std::fill_n(absolute + layout_.positions + at, body.modes, unit);
    std::fill_n(absolute + layout_.size() + at, body.modes, unit);
  }
  for (const Tyre& tyre : model_.tyres) {
    const int at = tyre.lag - internal - model_.sizes.modal;
    if (!tyre.relaxes()) continue;
    std::fill_n(absolute + layout_.positions + at, 2, tolerance * model_.length);
    std::fill_n(absolute + layout_.size() + at, 2, tolerance * model_.length);
  }
  for (std::size_t i = 0; i < model_.superelements.size(); ++i) {
    const double unit = tolerance * model_.length * std::sqrt(body_of(model_, i).mass);
    const int at = model_.internal_offset[i] - internal, count = body_of(model_, i).modes;
    std::fill_n(absolute + layout_.positions + at, count, unit);
    std::fill_n(absolute + layout_.size() + at, count, unit);
  }
  // Velocities may change by this tolerance per second, so that the units of the scene do not influence the steps.
  const double second = model_.units.named() ? model_.units.time.factor : 1.0;
  for (int i = layout_.positions; i < layout_.size(); ++i) absolute[i] *= second;
}

}  // namespace tisserand::mechanism
