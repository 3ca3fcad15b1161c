// SPDX-License-Identifier: GPL-3.0-or-later
// Preflight, initial values, projection and consistent start.
#include "mechanism/analyses/start.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/analyses/assembly.hpp"
#include "mechanism/analyses/number_doubts.hpp"
#include "mechanism/equations/carriers.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "mechanism/equations/round_off.hpp"
#include "mechanism/model/node_coordinates.hpp"
#include "mechanism/solver/matrix_rank.hpp"
#include "mechanism/step/step.hpp"
#include "mechanism/step/step_control.hpp"

namespace tisserand::mechanism {
namespace {

/// Smallest reciprocal condition of a mass matrix that is solved without regularisation.
constexpr double massless_condition = 1e-15;
/// Largest gap of initial values and joints after the bodies were moved. The projection closes the rest.
constexpr double value_tolerance = 1e-9;
/// Largest number of iterations for accelerations and reactions that friction couples.
constexpr int most_refinements = 30;

double largest_velocity(const Model& model, const State& state) {
  double largest = 0.0;
  for (const Node& node : model.nodes) {
    if (node.translation >= 0)
      largest = std::max(largest, translation_at(model, state.v(), node.translation).norm() / model.length);
    if (node.rotation >= 0) largest = std::max(largest, rotation_at(model, state.v(), node.rotation).norm());
  }
  return largest;
}

/// Request for the tangent: mass M + damping C + stiffness K.
TangentRequest weighted(double mass, double damping, double stiffness) {
  return {{mass, damping, stiffness}, TangentKind::step, {}};
}

void require_factors(const Model& model, const FactorReport& factors, const std::string& where) {
  if (factors.regular && factors.reciprocal_condition > 1e-300) return;
  std::string name = "a direction of the scene";
  if (factors.singular_column >= 0)
    name = factors.singular_column < model.sizes.boundary
               ? coordinate_name(model, factors.singular_column)
               : constraint_name(model, factors.singular_column - model.sizes.boundary);
  throw Error(fmt::format("{} has no mass, no stiffness and no constraint", name), where,
              "give the body mass or inertia there, or hold the direction with a joint");
}

/// Throws Error if axes of a joint are opposite, which its equations also allow. Hinges need z_A·z_B > 0, fixed joints
/// need it of all axes.
void require_facing(const Model& model, const std::string& where, const Workspace& workspace) {
  for (const Joint& joint : model.joints) {
    const Eigen::Matrix3d R_AB = marker_rotation(joint.a, motion_of(workspace.now, joint.a.node)).transpose() *
                                 marker_rotation(joint.b, motion_of(workspace.now, joint.b.node));
    const int axis = aligned_axis(joint);
    const bool hinge = axis >= 0 && R_AB(axis, axis) <= 0.0;
    const bool fixed = keeps_orientation(joint) && R_AB.diagonal().minCoeff() <= 0.0;
    if (!hinge && !fixed) continue;
    throw Error(hinge ? fmt::format("the {} axes of the markers of {} joint '{}' point in opposite directions",
                                    "xyz"[axis], formats::joint_word(joint.kind), joint.name)
                      : fmt::format("the axes of the markers of {} joint '{}' are rotated relative to each other",
                                    formats::joint_word(joint.kind), joint.name),
                where, "change the orientation of one marker so that the axes of both agree at the start");
  }
}

/// Throws Error that names the largest gap of joints and drives at the start, and lists all others.
void require_met(const Model& model, const formats::Scene& scene, const Violation& worst, const Workspace& workspace) {
  if (worst.value <= scene.initial_tolerance) return;
  throw Error(
      fmt::format("joint '{}' is not closed at the start: it is off by {:.3g} {} (initial_tolerance allows {:.3g}). "
                  "Open joints: {}",
                  constraint_name(model, worst.row), worst.value, "of the characteristic length or radians",
                  scene.initial_tolerance, gaps_text(marker_gaps(model, workspace.now), "")),
      scene.file,
      "correct poses or markers, close the joints by `analysis: assembly`, or increase initial_tolerance to let the "
      "program move the bodies. `initial: {<coordinate>: {value: ..}}` moves closed joints to a position");
}

/// Throws Error if massless bodies can move freely, because then no equation determines their motion.
void require_determined(const Model& model, const std::string& where, const State& state, Workspace& workspace) {
  const std::vector<std::string> motions = undetermined_motions(model, state, workspace.now);
  if (motions.empty()) return;
  throw Error(fmt::format("nothing determines the motion of massless bodies: {}", listed(motions)), where,
              "tie them with fixed joints, hold these directions with other joints or springs, or give them mass");
}

/// Moves whole bodies to the initial values of coordinates. Returns the largest displacement of a node. Joints must be
/// closed as written; drives are closed by the values.
double move_to_values(const formats::Scene& scene, BuiltModel& built, Workspace& workspace) {
  const Model& model = built.model;
  State& state = built.state;
  if (std::ranges::none_of(built.initial, [](const CoordinateStart& entry) { return entry.value.has_value(); }))
    return 0.0;
  evaluate(model, state, workspace.now);
  Eigen::VectorXd undriven = workspace.now.constraint;
  for (const Coupling& coupling : model.couplings)
    if (coupling.motion >= 0) undriven[coupling.row] = 0.0;
  require_met(model, scene, largest_violation(model, undriven), workspace);
  const State before = state;
  const AssemblyReport assembly = assemble(model, {value_tolerance, built.initial}, state, workspace.now);
  if (!assembly.closed)
    throw Error(
        fmt::format("the bodies cannot reach the initial values: these remain open: {}", gaps_text(assembly.open, "")),
        scene.file, "give values that joints and drives allow, or fewer of them");
  set_written_velocities(built);
  return (state.x() - before.x()).colwise().norm().maxCoeff();
}

/// Sets the initial rates of tread deflections to those that the motion of the wheels causes, instead of zero.
void settle_treads(const Model& model, State& state, Workspace& workspace) {
  if (std::ranges::none_of(model.tyres, &Tyre::relaxes)) return;
  evaluate(model, state, workspace.now);
  for (std::size_t i = 0; i < model.tyres.size(); ++i) {
    const Tyre& tyre = model.tyres[i];
    if (!tyre.relaxes()) continue;
    const NodeMotion& wheel = motion_of(workspace.now, tyre.wheel.node);
    state.v().segment<2>(model.sizes.first_modal() + tyre.lag) =
        settled_rates(tyre, model.roads[tyre.road], wheel, workspace.now.treads[i].w);
  }
}

/// Largest accepted contradiction. Driven analyses report contradictions of drives as dead points themselves.
double contradiction_limit(const formats::Scene& scene) {
  const bool driven =
      scene.analysis == formats::AnalysisKind::kinematics || scene.analysis == formats::AnalysisKind::inverse_dynamics;
  const bool rates =
      std::ranges::any_of(scene.initial, [](const formats::InitialSpec& entry) { return entry.rate.has_value(); });
  return driven && !rates ? std::numeric_limits<double>::infinity() : scene.initial_tolerance;
}

/// Step for the regularisation of massless directions with step² times the stiffness; statics has none of its own.
double regularising_step(const formats::Scene& scene) {
  return scene.analysis == formats::AnalysisKind::dynamics ? scene.integrator.step : 1e-3;
}

/// Factors the weights of a projection at the evaluated state.
void factor_projection(const Model& model, const formats::Scene& scene, const State& state, Workspace& workspace) {
  const double step = regularising_step(scene);
  require_factors(model, workspace.matrix.factor(model, state, weighted(1.0, 0.0, step * step), workspace.now),
                  scene.file);
}

/// Moves positions onto the constraints in the mass norm. Returns the correction. Throws Error that names joint and
/// equation if it exceeds the tolerance of the scene.
double project_positions(const Model& model, const formats::Scene& scene, State& state, Workspace& workspace) {
  double corrected = 0.0;
  for (int iteration = 0;; ++iteration) {
    evaluate(model, state, workspace.now);
    const Violation worst = largest_violation(model, workspace.now.constraint);
    if (iteration == 0) {
      corrected = worst.value;
      require_met(model, scene, worst, workspace);
    }
    if (worst.value <= 1e-14 || iteration == 20) break;
    factor_projection(model, scene, state, workspace);
    workspace.matrix.solve_projection(model, -workspace.now.constraint, workspace.now);
    const State before = state;
    retract(model, before, workspace.matrix.correction, state);
    if (workspace.matrix.correction.head(model.sizes.boundary).cwiseAbs().maxCoeff() < 1e-15 * model.length) break;
  }
  const Violation left = largest_violation(model, workspace.now.constraint);
  if (!(left.value <= 1e-9))
    throw Error(
        fmt::format("the joints cannot be closed: '{}' remains open by {:.3g} of the characteristic length or radians",
                    constraint_name(model, left.row), left.value),
        scene.file, "correct the poses of the bodies");
  require_facing(model, scene.file, workspace);
  return corrected;
}

/// Moves velocities onto the constraints, at positions that satisfy them. Returns the relative correction.
double project_velocities(const Model& model, const formats::Scene& scene, State& state, Workspace& workspace) {
  evaluate(model, state, workspace.now);
  const double velocity = largest_velocity(model, state);
  const Violation worst = largest_violation(model, workspace.now.constraint_rate);
  const double corrected = velocity > 0.0 ? worst.value / velocity : 0.0;
  if (!(corrected <= scene.initial_tolerance))
    throw Error(
        fmt::format(
            "initial velocities violate joint '{}': {:.3g} of the largest velocity (initial_tolerance allows {:.3g})",
            constraint_name(model, worst.row), corrected, scene.initial_tolerance),
        scene.file, "give velocities that agree with the joints");
  if (worst.value > 0.0) {
    factor_projection(model, scene, state, workspace);
    workspace.matrix.solve_projection(model, -workspace.now.constraint_rate, workspace.now);
    state.v() += workspace.matrix.correction;
  }
  return corrected;
}

/// Norm of the multipliers of joints with friction, on which forces depend.
double rubbing_part(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& multipliers) {
  double square = 0.0;
  for (const Friction& friction : model.frictions) {
    const Joint& joint = model.joints[friction.joint];
    square += multipliers.segment(joint.row, joint.size()).squaredNorm();
  }
  return std::sqrt(square);
}

/// Sets a_0 = v̇_0 + (α_m − α_f) h v̈_0, with v̈_0 by differences along the motion [ABC15]. This start gives multipliers
/// of order 2. Needs consistent v̇.
void start_algorithmic_acceleration(const Model& model, const formats::Scene& scene, State& state,
                                    Workspace& workspace) {
  const AlphaParameters alpha = alpha_parameters(scene.integrator);
  const double step = scene.integrator.step, shift = alpha.alpha_m - alpha.alpha_f;
  state.algorithmic() = state.vdot();
  state.step() = step;
  if (shift == 0.0) return;
  double epsilon = 1e-3 * step;  // before the next jump
  if (const auto next = std::ranges::upper_bound(model.breakpoints, state.load_time()); next != model.breakpoints.end())
    epsilon = std::min(epsilon, 0.5 * (*next - state.load_time()));
  State ahead = state;
  ahead.time() += epsilon;
  ahead.load_time() += epsilon;
  const Eigen::VectorXd d = epsilon * state.v() + 0.5 * epsilon * epsilon * state.vdot();
  retract(model, state, d, ahead);
  ahead.v() += epsilon * state.vdot();
  evaluate(model, ahead, workspace.now);
  evaluate_bias(model, workspace.now);
  // M + h/2 C + h²/4 K replaces M. It differs by O(h) where the step resolves the motion. For higher frequencies the
  // rate of the acceleration would grow with the frequency squared and be meaningless.
  const FactorReport factors =
      workspace.matrix.factor(model, ahead, weighted(1.0, 0.5 * step, 0.25 * step * step), workspace.now);
  require_factors(model, factors, scene.file);
  apply_jacobian(model, workspace.now, ahead.vdot(), workspace.matrix.rows);
  workspace.matrix.rows = -workspace.now.bias - workspace.matrix.rows;
  workspace.matrix.solve_increment(model, workspace.matrix.rows, workspace.now);
  state.algorithmic() += (shift * step / epsilon) * workspace.matrix.increment;
}

}  // namespace

bool solve_accelerations(const Model& model, double step, const std::string& where, State& state,
                         Workspace& workspace) {
  state.vdot().setZero();
  state.lambda().setZero();
  evaluate(model, state, workspace.now);
  FactorReport factors = workspace.matrix.factor(model, state, weighted(1.0, 0.0, 0.0), workspace.now);
  const bool massless = !factors.regular || factors.reciprocal_condition < massless_condition;
  if (massless) {
    factors = workspace.matrix.factor(model, state, weighted(1.0, 0.0, step * step), workspace.now);
    require_factors(model, factors, where);
  }
  // With friction the forces depend on the multipliers and need Newton's iteration. Otherwise one refinement is enough.
  const bool rubs = !model.frictions.empty();
  bool settled = !rubs;
  for (int refinement = 0; refinement < (rubs ? most_refinements : 2); ++refinement) {
    if (refinement > 0) evaluate(model, state, workspace.now);
    if (refinement > 0 && rubs)
      require_factors(
          model, workspace.matrix.factor(model, state, weighted(1.0, 0.0, massless ? step * step : 0.0), workspace.now),
          where);
    evaluate_bias(model, workspace.now);
    apply_jacobian(model, workspace.now, state.vdot(), workspace.matrix.rows);
    workspace.matrix.rows = -workspace.now.bias - workspace.matrix.rows;
    workspace.matrix.solve_increment(model, workspace.matrix.rows, workspace.now);
    state.vdot() += workspace.matrix.increment;
    state.lambda() += workspace.matrix.multipliers;
    // Massless directions move on with each refinement, and so do the multipliers of their constraints.
    settled =
        settled || is_round_off(model, state, workspace.now, workspace.matrix.multipliers) ||
        (massless ? rubbing_part(model, workspace.matrix.multipliers) <= 1e-12 * rubbing_part(model, state.lambda())
                  : workspace.matrix.multipliers.norm() <= 1e-12 * state.lambda().norm());
    if (rubs && settled) break;
  }
  if (!settled)
    throw Error("the accelerations do not converge: reactions and friction of the joints amplify each other", where,
                "reduce `coefficient` of the friction, or increase its `velocity`");
  evaluate(model, state, workspace.now);
  return massless;
}

StartReport start(const formats::Scene& scene, StartFrom from, BuiltModel& built, Workspace& workspace) {
  const Model& model = built.model;
  State& state = built.state;
  const std::string& where = scene.file;
  const bool dynamics = scene.analysis == formats::AnalysisKind::dynamics;
  StartReport report;
  if (from == StartFrom::poses) report.moved = move_to_values(scene, built, workspace);
  report.mobility = count_mobility(model, state, workspace.now);
  report.preflight = examine(model, workspace.now);
  std::ranges::move(number_doubts(scene, model, workspace.now), std::back_inserter(report.preflight.doubts));
  require_determined(model, where, state, workspace);
  for (const int row : report.mobility.redundant) state.active()[row] = 0.0;
  report.projection.position = project_positions(model, scene, state, workspace);
  if (scene.analysis == formats::AnalysisKind::statics) {  // statics starts at rest, or in its own steady rotation
    state.v().setZero();
    return report;
  }
  report.velocities = derive_velocities(built, from, contradiction_limit(scene), where, workspace.now);
  report.projection.velocity = project_velocities(model, scene, state, workspace);
  if (from == StartFrom::poses) require_followers(built, scene.initial_tolerance, where, workspace.now);
  if (!dynamics) return report;
  settle_treads(model, state, workspace);
  report.massless = solve_accelerations(model, scene.integrator.step, where, state, workspace);
  start_algorithmic_acceleration(model, scene, state, workspace);
  begin(model, state, workspace);
  return report;
}

void begin(const Model& model, State& state, Workspace& workspace) {
  evaluate(model, state, workspace.now);
  state.work() = state.dissipated() = 0.0;
  state.initial_energy() = evaluate_energy(model, workspace.now).total();
  state.load_power() = workspace.now.load_power;
  state.damping_power() = damping_power(model, workspace.now);
  for (int k = 0; k < 3; ++k) state.force_scale(k) = workspace.now.force_scale[k];
  unwrap_hinges(model, workspace.now, state);
}

void pass_breakpoint(const Model& model, const formats::Scene& scene, State& state, Workspace& workspace) {
  const double side = instant_tolerance(scene.integrator.step, state.time());
  bool jumps = false;
  const auto look_at = [&](TimeFunction& function) {
    const double before = function(state.time() - side), after = function(state.time() + side);
    jumps = jumps || std::abs(after - before) > 1e-6 * std::max(std::abs(after), std::abs(before));
  };
  for (auto& components : workspace.now.load_functions)
    for (TimeFunction& function : components) look_at(function);
  for (TimeFunction& function : workspace.now.part_load_functions) look_at(function);
  for (std::optional<TimeFunction>& function : workspace.now.spring_forces)
    if (function) look_at(*function);
  for (MotionFunction& motion : workspace.now.motions) {
    const double before = motion(state.time(), state.time() - side).acceleration,
                 after = motion(state.time(), state.time() + side).acceleration;
    jumps = jumps || std::abs(after - before) > 1e-6 * std::max(std::abs(after), std::abs(before));
  }
  if (!jumps) return;
  workspace.memory.predictor.forget();
  state.load_time() = state.time() + side;
  solve_accelerations(model, scene.integrator.step, scene.file, state, workspace);
  const double step = state.step();  // the velocities belong to this step (index 3)
  start_algorithmic_acceleration(model, scene, state, workspace);
  rebuild_algorithmic_acceleration(step, state);
  evaluate(model, state, workspace.now);
  state.load_power() = workspace.now.load_power;
  state.damping_power() = damping_power(model, workspace.now);
}

}  // namespace tisserand::mechanism
