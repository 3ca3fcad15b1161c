// Pre-flight, projection and consistent start.
#include "mechanism/analyses/start.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/equations/carriers.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "mechanism/solver/matrix_rank.hpp"
#include "mechanism/step/step.hpp"
#include "mechanism/step/step_control.hpp"

namespace tisserand::mechanism {
namespace {

/// Smallest reciprocal condition of a mass matrix that is solved as it is.
constexpr double massless_condition = 1e-15;
/// Iterations for accelerations and reactions that friction couples.
constexpr int most_refinements = 30;

/// Largest violation and its row; positions relative to the length.
struct Violation {
  double value = 0.0;
  int row = -1;
};

Violation largest_violation(const Model& model, const Eigen::VectorXd& rows) {
  Violation worst;
  for (int row = 0; row < model.sizes.constraints; ++row) {
    const double value = std::abs(rows[row]) / (model.length_row[row] ? model.length : 1.0);
    if (!(value <= worst.value)) worst = {value, row};
  }
  return worst;
}

double largest_velocity(const Model& model, const State& state) {
  double largest = 0.0;
  for (const Node& node : model.nodes) {
    if (node.translation >= 0)
      largest = std::max(largest, state.v().segment<3>(node.translation).norm() / model.length);
    if (node.rotation >= 0) largest = std::max(largest, state.v().segment<3>(node.rotation).norm());
  }
  return largest;
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

/// The equations of a joint are also met by axes that point the other way: z_A·z_B > 0 for hinges, all axes for fixed
/// ones.
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
                      : fmt::format("the axes of the markers of {} joint '{}' are turned against each other",
                                    formats::joint_word(joint.kind), joint.name),
                where, "turn the orientation of one marker, so that the axes of both agree at the start");
  }
}

/// Massless bodies that nothing moves have no equation.
void require_determined(const Model& model, const std::string& where, const State& state, Workspace& workspace) {
  const std::vector<std::string> motions = undetermined_motions(model, state, workspace.now);
  if (motions.empty()) return;
  throw Error(fmt::format("nothing determines the motion of massless bodies: {}", join(motions, ", ")), where,
              "tie them with fixed joints, hold these directions with other joints or springs, or give them mass");
}

/// The largest gaps of all open joints, which one message lists together.
std::string gaps_text(const std::vector<MarkerGap>& gaps) {
  constexpr std::size_t shown = 8;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < std::min(shown, gaps.size()); ++i)
    texts.push_back(fmt::format("'{}' by {:.3g} and {:.3g} rad", gaps[i].joint, gaps[i].length, gaps[i].angle));
  if (gaps.size() > shown) texts.push_back(fmt::format("and {} more", gaps.size() - shown));
  return fmt::format("Open joints: {}", join(texts, ", "));
}

}  // namespace

Projection project_initial_state(const Model& model, double tolerance, double step, const std::string& where,
                                 State& state, Workspace& workspace) {
  Projection projection;
  for (int iteration = 0;; ++iteration) {
    evaluate(model, state, workspace.now);
    const Violation worst = largest_violation(model, workspace.now.constraint);
    if (iteration == 0) {
      projection.position = worst.value;
      if (!(worst.value <= tolerance))
        throw Error(
            fmt::format("joint '{}' is not met at the start: off by {:.3g} {} (initial_tolerance allows {:.3g}). {}",
                        constraint_name(model, worst.row), worst.value, "of the characteristic length or radians",
                        tolerance, gaps_text(marker_gaps(model, workspace.now))),
            where, "correct poses or markers, or raise initial_tolerance to let the program move the bodies");
    }
    if (worst.value <= 1e-14 || iteration == 20) break;
    require_factors(
        model, workspace.matrix.factor(model, state, {{1.0, 0.0, step * step}, TangentKind::step, {}}, workspace.now),
        where);
    workspace.matrix.solve_projection(model, -workspace.now.constraint, workspace.now);
    const State before = state;
    retract(model, before, workspace.matrix.correction, state);
    if (workspace.matrix.correction.head(model.sizes.boundary).cwiseAbs().maxCoeff() < 1e-15 * model.length) break;
  }
  const Violation left = largest_violation(model, workspace.now.constraint);
  if (!(left.value <= 1e-9))
    throw Error(fmt::format("the joints cannot be closed: '{}' stays open by {:.3g}", constraint_name(model, left.row),
                            left.value),
                where, "correct the poses of the bodies");
  require_facing(model, where, workspace);
  const double velocity = largest_velocity(model, state);
  const Violation worst = largest_violation(model, workspace.now.constraint_rate);
  projection.velocity = velocity > 0.0 ? worst.value / velocity : 0.0;
  if (!(projection.velocity <= tolerance))
    throw Error(
        fmt::format(
            "initial velocities violate joint '{}': {:.3g} of the largest velocity (initial_tolerance allows {:.3g})",
            constraint_name(model, worst.row), projection.velocity, tolerance),
        where, "give velocities that agree with the joints, or raise initial_tolerance to let the program change them");
  if (worst.value > 0.0) {
    require_factors(
        model, workspace.matrix.factor(model, state, {{1.0, 0.0, step * step}, TangentKind::step, {}}, workspace.now),
        where);
    workspace.matrix.solve_projection(model, -workspace.now.constraint_rate, workspace.now);
    state.v() += workspace.matrix.correction;
  }
  return projection;
}

bool solve_accelerations(const Model& model, double step, const std::string& where, State& state,
                         Workspace& workspace) {
  state.vdot().setZero();
  state.lambda().setZero();
  evaluate(model, state, workspace.now);
  FactorReport factors = workspace.matrix.factor(model, state, {{1.0, 0.0, 0.0}, TangentKind::step, {}}, workspace.now);
  const bool massless = !factors.regular || factors.reciprocal_condition < massless_condition;
  if (massless) {
    factors = workspace.matrix.factor(model, state, {{1.0, 0.0, step * step}, TangentKind::step, {}}, workspace.now);
    require_factors(model, factors, where);
  }
  // With friction the forces depend on the multipliers: Newton's iteration, otherwise one refinement.
  const bool rubs = !model.frictions.empty();
  bool settled = !rubs;
  for (int refinement = 0; refinement < (rubs ? most_refinements : 2); ++refinement) {
    if (refinement > 0) evaluate(model, state, workspace.now);
    if (refinement > 0 && rubs)
      require_factors(
          model,
          workspace.matrix.factor(model, state, {{1.0, 0.0, massless ? step * step : 0.0}, TangentKind::step, {}},
                                  workspace.now),
          where);
    evaluate_bias(model, workspace.now);
    apply_jacobian(model, workspace.now, state.vdot(), workspace.matrix.rows);
    workspace.matrix.rows = -workspace.now.bias - workspace.matrix.rows;
    workspace.matrix.solve_increment(model, workspace.matrix.rows, workspace.now);
    state.vdot() += workspace.matrix.increment;
    state.lambda() += workspace.matrix.multipliers;
    settled = settled || workspace.matrix.multipliers.norm() <= 1e-12 * state.lambda().norm();
    if (rubs && settled) break;
  }
  if (!settled)
    throw Error("the accelerations do not settle: reactions and friction of the joints drive each other", where,
                "reduce the coefficients of friction, or raise their velocity");
  evaluate(model, state, workspace.now);
  return massless;
}

void start_algorithmic_acceleration(const Model& model, double shift, double step, const std::string& where,
                                    State& state, Workspace& workspace) {
  state.algorithmic() = state.vdot();
  state.step() = step;
  if (shift == 0.0) return;
  const double epsilon = 1e-3 * step;
  State ahead = state;
  ahead.time() += epsilon;
  ahead.load_time() += epsilon;
  const Eigen::VectorXd d = epsilon * state.v() + 0.5 * epsilon * epsilon * state.vdot();
  retract(model, state, d, ahead);
  ahead.v() += epsilon * state.vdot();
  evaluate(model, ahead, workspace.now);
  evaluate_bias(model, workspace.now);
  // With M + h/2 C + h²/4 K in place of M: equal to it up to O(h) where the step resolves the motion; elsewhere the
  // rate of the acceleration would grow with the frequency squared and mean nothing.
  const FactorReport factors = workspace.matrix.factor(
      model, ahead, {{1.0, 0.5 * step, 0.25 * step * step}, TangentKind::step, {}}, workspace.now);
  require_factors(model, factors, where);
  apply_jacobian(model, workspace.now, ahead.vdot(), workspace.matrix.rows);
  workspace.matrix.rows = -workspace.now.bias - workspace.matrix.rows;
  workspace.matrix.solve_increment(model, workspace.matrix.rows, workspace.now);
  state.algorithmic() += (shift * step / epsilon) * workspace.matrix.increment;
}

StartReport start(const formats::Scene& scene, const Model& model, State& state, Workspace& workspace) {
  const std::string& where = scene.file;
  const bool dynamics = scene.analysis == formats::AnalysisKind::dynamics;
  // Only regularises massless directions, where statics has no step of its own.
  const double step = dynamics ? scene.integrator.step : 1e-3;
  StartReport report;
  report.mobility = count_mobility(model, state, workspace.now);
  report.preflight = examine(model, workspace.now);
  require_determined(model, where, state, workspace);
  for (const int row : report.mobility.redundant) state.active()[row] = 0.0;
  report.projection = project_initial_state(model, scene.initial_tolerance, step, where, state, workspace);
  if (!dynamics) return report;
  report.massless = solve_accelerations(model, step, where, state, workspace);
  const AlphaParameters alpha = alpha_parameters(scene.integrator);
  start_algorithmic_acceleration(model, alpha.alpha_m - alpha.alpha_f, step, where, state, workspace);
  begin(model, state, workspace);
  return report;
}

void begin(const Model& model, State& state, Workspace& workspace) {
  evaluate(model, state, workspace.now);
  state.work() = state.dissipated() = 0.0;
  state.initial_energy() = evaluate_energy(model, workspace.now).total();
  state.load_power() = workspace.now.load_power;
  state.damping_power() = workspace.now.damping_power;
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
  for (std::optional<TimeFunction>& function : workspace.now.spring_forces)
    if (function) look_at(*function);
  if (!jumps) return;
  workspace.memory.predictor.forget();
  state.load_time() = state.time() + side;
  solve_accelerations(model, scene.integrator.step, scene.file, state, workspace);
  const AlphaParameters alpha = alpha_parameters(scene.integrator);
  const double step = state.step();  // to which the velocities belong (index 3)
  start_algorithmic_acceleration(model, alpha.alpha_m - alpha.alpha_f, scene.integrator.step, scene.file, state,
                                 workspace);
  rebuild_algorithmic_acceleration(step, state);
  evaluate(model, state, workspace.now);
  state.load_power() = workspace.now.load_power;
  state.damping_power() = workspace.now.damping_power;
}

}  // namespace tisserand::mechanism
