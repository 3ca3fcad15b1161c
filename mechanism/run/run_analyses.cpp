// SPDX-License-Identifier: GPL-3.0-or-later
// Analyses without time integration, from start to rows: assembly, kinematics, inverse dynamics, modes.
#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "common/text.hpp"
#include "mechanism/analyses/assembly.hpp"
#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/analyses/modes.hpp"
#include "mechanism/analyses/steady_axes.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/model/node_coordinates.hpp"
#include "mechanism/run/output.hpp"
#include "mechanism/run/run.hpp"
#include "mechanism/run/schedule.hpp"

namespace tisserand::mechanism {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Blanks what was not computed. Kinematics has no reactions; assembly has no accelerations either.
void blank(formats::AnalysisKind kind, formats::ResultsRow& row) {
  const auto blank_all = [](auto&... values) { (values.setConstant(none), ...); };
  blank_all(row.joint_force, row.joint_moment, row.coupling_first_force, row.coupling_second_force, row.motion_force,
            row.boundary_force, row.friction_force, row.friction_moment, row.modal.node_force);
  row.work = row.dissipated = row.balance = row.residual = none;
  if (kind == formats::AnalysisKind::kinematics) return;
  blank_all(row.node_acceleration, row.node_angular_acceleration, row.frame_acceleration,
            row.frame_angular_acceleration, row.modal.acceleration, row.modal.angular_acceleration);
}

/// Adds the work of drives, loads and dampers over the last step by the trapezoidal rule.
void count_work(const Model& model, double size, State& state, const Workspace& workspace) {
  const double damping = damping_power(model, workspace.now);
  state.work() += 0.5 * size * (state.load_power() + workspace.now.load_power);
  state.dissipated() += 0.5 * size * (state.damping_power() + damping);
  state.load_power() = workspace.now.load_power;
  state.damping_power() = damping;
}

/// Solves for the forces of the present motion if the analysis needs them. Returns false if it fails.
bool solve_forces(Run& run) {
  return run.scene.analysis != formats::AnalysisKind::inverse_dynamics ||
         solve_multipliers(run.built.model, run.built.state, run.workspace);
}

void write_motion_row(Run& run, const StepReport& step, double size, RowWriter& out) {
  const formats::AnalysisKind kind = run.scene.analysis;
  const RowEdit edit = kind == formats::AnalysisKind::inverse_dynamics
                           ? RowEdit{}
                           : RowEdit{[kind](formats::ResultsRow& row) { blank(kind, row); }};
  write_row(run, step, size, out, edit);
}

void stop_at_dead_point(Run& run, double time, const StepReport& step) {
  run.report.end(
      RunOutcome::not_converged,
      fmt::format("t = {:.6g}{}: {} (after {} halvings of the step)", time, after_time(run.scene.units),
                  step.outcome == StepOutcome::singular
                      ? "the drives do not determine the motion: at this dead point, several motions are possible"
                      : "the joints cannot be closed: the drive exceeds the range of the mechanism",
                  run.scene.integrator.max_halvings));
}

/// Adds the coordinates of superelements and modal bodies in the modes. A shape is used as a velocity, since rows of
/// results hold rates.
void add_body_coordinates(const Run& run, const ModesReport& modes, Evaluation& evaluation, formats::ResultsRow row,
                          formats::ModesTable& table) {
  const Model& model = run.built.model;
  State moving = run.built.state;
  const auto count = static_cast<Eigen::Index>(modes.modes.size());
  table.y.resize(row.y_rate.size(), count);
  table.w.resize(row.w_rate.size(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Eigen::VectorXcd& shape = modes.modes[k].shape;
    const auto rates = [&](const Eigen::VectorXd& motion) {
      moving.v() = motion;
      for (int i = 0; i < std::ssize(model.nodes); ++i)
        if (const int rotation = model.nodes[i].rotation; rotation >= 0)
          set_rotation(model, motion_of(evaluation, i).R.transpose() * rotation_at(model, motion, rotation), rotation,
                       moving.v());
      fill_row(model, moving, evaluation, row);
    };
    rates(shape.real());
    table.y.col(k).real() = row.y_rate;
    table.w.col(k).real() = row.w_rate;
    rates(shape.imag());
    table.y.col(k).imag() = row.y_rate;
    table.w.col(k).imag() = row.w_rate;
  }
}

/// A larger relative change of the coefficients is reported.
constexpr double steady_change = 1e-3;

std::string changing_coefficients(const ModesReport& modes) {
  const std::string what = fmt::format(
      "the coefficients of the linearised equations are not constant in the axes used: they change by {:.2g} of their "
      "size in a rotation of {} rad",
      modes.change, turned_by);
  if (modes.axes.norm() > 0.0)
    return what +
           ". The parts that do not rotate with the axes are not symmetric about the axis of rotation. If the rotating "
           "parts are symmetric, use axes at rest: `modes: {rotation: [0, 0, 0]}`";
  return fmt::format(
      "{} of '{}'. It is not symmetric about its axis of rotation. If the parts at rest are symmetric about this axis, "
      "use axes that rotate with it: `modes: {{rotation: [{:.6g}, {:.6g}, {:.6g}]}}`",
      what, modes.spins, modes.spin.x(), modes.spin.y(), modes.spin.z());
}

}  // namespace

void move_along(Run& run, RowWriter& out) {
  const Model& model = run.built.model;
  State& state = run.built.state;
  RunReport& report = run.report;
  Schedule schedule(run.scene, model.breakpoints);
  StepReport step;
  if (!solve_rates(model, state, run.workspace) || !solve_forces(run)) {
    step.outcome = StepOutcome::singular;
    stop_at_dead_point(run, state.time(), step);
    return;
  }
  begin(model, state, run.workspace);
  if (schedule.output_at_start()) write_motion_row(run, step, 0.0, out);
  while (!schedule.finished(state.time())) {
    if (is_interrupted(run)) break;
    const double before = state.time();
    step = move_along(model, run.scene.integrator, schedule.next(before), state, run.workspace);
    report.iterations += step.iterations;
    report.factorisations += step.factorisations;
    if (step.outcome == StepOutcome::accepted && !solve_forces(run)) step.outcome = StepOutcome::singular;
    if (step.outcome != StepOutcome::accepted) {
      ++report.rejected;
      state.block() = run.workspace.memory.previous.block();
      if (schedule.retry(before, step)) continue;
      stop_at_dead_point(run, before, step);
      break;
    }
    ++report.steps;
    report.largest_constraint = std::max(report.largest_constraint, step.constraint * model.length);
    count_work(model, state.time() - before, state, run.workspace);
    if (schedule.accept(state.time()).output) write_motion_row(run, step, state.time() - before, out);
    if (run.control.progress) run.control.progress(state.time());
    if (run.scene.analysis != formats::AnalysisKind::inverse_dynamics) continue;  // kinematics has no tyre forces
    report.reason = off_road(model, state, run.workspace.now);
    if (report.reason.empty()) continue;
    report.outcome = RunOutcome::not_converged;
    break;
  }
  report.time = state.time();
}

void assemble(Run& run, RowWriter& out) {
  const Model& model = run.built.model;
  State& state = run.built.state;
  RunReport& report = run.report;
  const AssemblyReport assembly =
      assemble(model, {run.scene.integrator.constraint_tolerance, run.built.initial, run.control.interrupted}, state,
               run.workspace.now);
  report.time = state.time();
  report.iterations = report.factorisations = assembly.iterations;
  report.steps = 1;
  report.largest_constraint = assembly.gap * model.length;
  report.table = body_poses(run.scene, model, run.at_start, state);
  report.table_title = "poses in the format of `bodies`";
  report.mobility = count_mobility(model, state, run.workspace.now);
  StepReport step;
  step.iterations = assembly.iterations;
  step.constraint = assembly.gap * model.length;
  write_row(run, step, 0.0, out, [](formats::ResultsRow& row) { blank(formats::AnalysisKind::assembly, row); });
  if (assembly.interrupted) {
    report.end(RunOutcome::interrupted, "interrupted");
  } else if (!assembly.closed) {
    report.end(RunOutcome::not_converged,
               fmt::format("joints remain open: {}; give better initial poses, or correct the markers that cannot meet",
                           gaps_text(assembly.open, "")));
  } else if (!(assembly.velocity_gap <= 1e-9)) {
    report.end(
        RunOutcome::not_converged,
        fmt::format("no velocities agree with joints and drives: an error of {:.3g} of the largest velocity remains",
                    assembly.velocity_gap));
  }
}

void find_modes(Run& run, RowWriter& out) {
  const Model& model = run.built.model;
  State& state = run.built.state;
  RunReport& report = run.report;
  const ModesReport modes = solve_modes(model, state, run.scene.modes, run.workspace.now);
  report.time = state.time();
  report.steps = 1;
  report.table = modes_lines(model, modes);
  report.table_title = fmt::format("modes of {} degrees of freedom{}", modes.degrees_of_freedom,
                                   model.planar ? " in the plane; motion out of the plane is not modelled" : "");
  double lowest = 0.0;
  for (const Mode& mode : modes.modes)
    if (lowest == 0.0) lowest = std::abs(mode.eigenvalue);
  if (modes.largest_acceleration > 1e-6 * lowest * lowest)
    report.notes.push_back(fmt::format(
        "the state is not steady in the axes of the linearisation: it moves by {:.2g} (of the characteristic length, "
        "or rad) while the phase of the lowest mode advances by 1 rad. The modes are those of frozen coefficients. If "
        "the scene rotates steadily, start from `statics: {{rotation: ..}}` or give `modes: {{rotation: [x, y, z]}}`",
        0.5 * modes.largest_acceleration / (lowest * lowest)));
  else if (modes.change > steady_change)
    report.doubts.push_back(changing_coefficients(modes));
  if (!modes.undecided.empty())
    report.doubts.push_back(
        fmt::format("the frequencies of '{}' are those in axes that rotate with it: its modes move no node on its "
                    "axis, so they cannot be converted to other axes. Use axes that rotate with it: `modes: "
                    "{{rotation: [{:.6g}, {:.6g}, {:.6g}]}}`",
                    modes.undecided, modes.axes.x() + modes.spin.x(), modes.axes.y() + modes.spin.y(),
                    modes.axes.z() + modes.spin.z()));
  if (const auto unstable = std::ranges::count_if(modes.modes, &Mode::unstable); unstable > 0)
    report.notes.push_back(fmt::format("{}: the state is unstable",
                                       unstable == 1 ? "1 mode grows" : fmt::format("{} modes grow", unstable)));
  write_row(run, {}, 0.0, out, [](formats::ResultsRow& row) { row.work = row.dissipated = row.balance = none; });
  formats::ModesTable table = modes_table(model, run.workspace.now, modes);
  if (out.row.y.size() + out.row.w.size() > 0) add_body_coordinates(run, modes, run.workspace.now, out.row, table);
  out.writer.set_modes(std::move(table));
}

}  // namespace tisserand::mechanism
