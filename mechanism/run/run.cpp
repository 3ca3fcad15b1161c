// SPDX-License-Identifier: GPL-3.0-or-later
// Start and rows of a run.
#include "mechanism/run/run.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/analyses/number_doubts.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/analyses/steady_rotation.hpp"
#include "mechanism/build/effects.hpp"
#include "mechanism/doubts/damping_reach.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/model/bodies.hpp"
#include "mechanism/model/forces.hpp"
#include "mechanism/run/output.hpp"
#include "mechanism/run/schedule.hpp"
#include "mechanism/run/simulated_scene.hpp"
#include "mechanism/step/redundancy.hpp"
#include "mechanism/switching/constraint_stress.hpp"

namespace tisserand::mechanism {
namespace {

/// Step that regularises massless directions in analyses without steps. Their accelerations come from statics.
constexpr double massless_step = 1e-3;

bool has_gravity(const Model& model) {
  bool any = false;
  for_each_body(model, [&any](const auto& body) { any = any || !body.gravity.isZero(0.0); });
  return any;
}

/// List of the contents of the model: pools and active terms.
std::vector<std::string> effects(const Model& model) {
  std::vector<std::string> list;
  const auto add = [&list](std::size_t count, std::string what) {
    if (count == 1)
      what = what.ends_with("bodies") ? what.replace(what.size() - 3, 3, "y") : what.substr(0, what.size() - 1);
    if (count > 0) list.push_back(fmt::format("{} {}", count, what));
  };
  add(model.superelements.size(), "superelements");
  add(model.modal_bodies.size(), "modal bodies");
  add(model.rigid_bodies.size(), "rigid bodies");
  add(model.beams2.size() + model.beams3.size(), "nonlinear beam elements");
  const auto followers =
      std::count_if(model.ties.begin(), model.ties.end(), [](const Tie& tie) { return !tie.is_loop; });
  add(static_cast<std::size_t>(model.virtual_nodes), "virtual bodies");
  add(static_cast<std::size_t>(followers), "eliminated virtual bodies");
  add(model.joints.size(), "joints");
  add(model.frictions.size(), "frictional joints");
  add(model.couplings.size(), "couplings");
  add(model.springs.size(), "springs");
  for_each_force_pool(
      model, [&]<class T>(const Pool<T>& pool) { add(pool.size(), fmt::format("{}s", ForceTraits<T>::kind)); });
  if (has_gravity(model)) list.push_back("gravity");
  bool damped = false;
  for_each_body(model, [&](const auto& body) { damped = damped || is_damped(model, body); });
  if (damped) list.push_back("damping");
  return list;
}

/// Text "load 'motor', x component: ..": the value at the time `time` ("t = 0.1 s"), with its formula, if it is not
/// finite.
std::string nonfinite_text(const std::string& what, const formats::TimeFunctionSpec& spec, const std::string& time,
                           double value) {
  if (std::isfinite(value)) return {};
  const auto* expression = std::get_if<formats::TimeExpression>(&spec);
  return fmt::format("{}{}: the value at {} is {}, not a finite number", what,
                     expression == nullptr ? "" : fmt::format(" '{}'", expression->text), time, value);
}

void require_finite_loads(Run& run) {
  if (!run.built.model.channels.empty())
    evaluate(run.built.model, run.built.state, run.workspace.now);  // sets channels
  const std::string bad = nonfinite_load(run, run.scene.integrator.start);
  if (!bad.empty()) throw Error(bad, run.scene.file, "correct the formula, for example with t > 0 ? .. : ..");
}

/// Throws Error for `radau` with stiffening or inertia F. It keeps internal coordinates in its systems and needs a
/// constant block of them, which such bodies do not have.
void require_method_fits(const Run& run) {
  if (run.scene.analysis != formats::AnalysisKind::dynamics || run.scene.integrator.method != formats::Method::radau)
    return;
  std::vector<std::string> names;
  const auto& uses = run.built.model.superelements;
  for (std::size_t i = 0; i < uses.size(); ++i)
    if (body_of(run.built.model, i).second_order.any()) names.push_back(fmt::format("'{}'", uses[i].name));
  if (names.empty()) return;
  throw Error(
      fmt::format("integrator: method radau needs linear superelements, but stiffening or inertia F is on in {}",
                  listed(names)),
      run.scene.file, "write 'second_order: off' at these bodies, or use method: generalised_alpha");
}

/// Notes with notes "body 'a': text" of equal text merged to one, which lists the names.
std::vector<std::string> merged(const std::vector<std::string>& notes) {
  constexpr std::string_view head = "body '", middle = "': ";
  std::vector<std::pair<std::string, std::vector<std::string>>> texts;  // text, names; no names: another note
  for (const std::string& note : notes) {
    const std::size_t end = note.find(middle);
    if (!note.starts_with(head) || end == std::string::npos) {
      texts.push_back({note, {}});
      continue;
    }
    const std::string text = note.substr(end + middle.size());
    const auto same =
        std::ranges::find_if(texts, [&](const auto& one) { return one.first == text && !one.second.empty(); });
    const std::string name = note.substr(head.size() - 1, end + 2 - head.size());
    if (same == texts.end())
      texts.push_back({text, {name}});
    else
      same->second.push_back(name);
  }
  std::vector<std::string> result;
  for (const auto& [text, names] : texts)
    result.push_back(names.empty()       ? text
                     : names.size() == 1 ? fmt::format("body {}: {}", names.front(), text)
                                         : fmt::format("{} bodies ({}): {}", names.size(), listed(names), text));
  return result;
}

/// Notes redundant constraint equations, and the joints whose reactions are therefore not unique.
void note_redundancy(Run& run) {
  const Mobility& mobility = run.report.mobility;
  if (mobility.redundant.empty()) return;
  std::vector<std::string> rows;
  for (const int row : mobility.redundant) rows.push_back(fmt::format("'{}'", constraint_name(run.built.model, row)));
  evaluate(run.built.model, run.built.state, run.workspace.now);
  run.report.not_unique = joints_without_unique_reaction(run.built.model, run.workspace.now);
  run.report.notes.push_back(
      fmt::format("{} of {} constraint equations are redundant: {}. The motion is correct, but the reactions of {} are "
                  "not unique: those of least norm are stored",
                  mobility.redundant.size(), mobility.constraints, listed(rows), listed(run.report.not_unique)));
  for (const Friction& friction : run.built.model.frictions) {
    const std::string& name = run.built.model.joints[friction.joint].name;
    if (std::ranges::count(run.report.not_unique, name) > 0)
      run.report.notes.push_back(fmt::format(
          "the friction of joint '{}' depends on a reaction that is not unique, so the motion is not unique either",
          name));
  }
}

/// Whether all its values are zero.
bool rests(const formats::SpringSpec& spring) {
  const auto zero = [](const formats::LawSpec& law) {
    const double* factor = std::get_if<double>(&law);
    return factor != nullptr && *factor == 0.0;
  };
  const bool stops = spring.lower || spring.upper;
  return zero(spring.stiffness) && zero(spring.damping) && !spring.force && (!stops || spring.stop_stiffness == 0.0);
}
bool rests(const formats::BushingSpec& bushing) {
  return bushing.stiffness.isZero(0.0) && bushing.damping.isZero(0.0) && bushing.preload.isZero(0.0);
}

/// Notes springs, stops and bushings whose values are all zero, which a sweep may contain.
void note_resting(Run& run) {
  std::vector<std::string> names;
  for (const formats::SpringSpec& spring : run.scene.springs)
    if (rests(spring)) names.push_back(fmt::format("spring '{}'", spring.name));
  for (const formats::BushingSpec& bushing : run.scene.bushings)
    if (rests(bushing)) names.push_back(fmt::format("bushing '{}'", bushing.name));
  if (!names.empty())
    run.report.notes.push_back(
        fmt::format("elements without force, because all their values are zero: {}", listed(names)));
}

/// Notes locked loops. A suspension whose axes are not parallel does not move, without any other sign.
void note_locked(Run& run) {
  const std::vector<std::string>& locked = run.report.mobility.locked;
  if (locked.empty()) return;
  run.report.notes.push_back(
      fmt::format("{} lock each other if all bodies are rigid: nothing moves in them. If they should move, check their "
                  "axes and positions; hinges of one loop may have to be parallel",
                  listed(locked)));
}

/// Adds notes on the scene that follow from its constraints and forces.
void note_mechanism(Run& run) {
  const auto before = static_cast<std::ptrdiff_t>(run.report.notes.size());
  note_redundancy(run);
  note_resting(run);
  note_locked(run);
  std::ranges::copy(run.report.notes.begin() + before, run.report.notes.end(),
                    std::back_inserter(run.report.scene_notes));
}

std::string quoted(std::vector<std::string> names) {
  for (std::string& name : names) name = fmt::format("'{}'", name);
  return listed(names);
}

std::string with_unit(double value, const std::string& unit) {
  return fmt::format("{:.4g}{}", value, after_number(unit));
}

/// Notes how the start has chosen free velocities and used initial values.
void note_start(const StartReport& start, Run& run) {
  std::vector<std::string>& notes = run.report.notes;
  const Units& units = run.scene.units;
  const auto& initial = run.built.initial;
  const auto gives = [&](auto member) {
    return std::ranges::any_of(initial, [&](const CoordinateStart& entry) { return (entry.*member).has_value(); });
  };
  const bool values = gives(&CoordinateStart::value), rates = gives(&CoordinateStart::rate);
  if (values && run.from == StartFrom::poses)
    notes.push_back(fmt::format("initial values moved the bodies by up to {} from the given poses",
                                with_unit(start.moved, unit_label(units, 1, 0, 0))));
  if ((values && run.from != StartFrom::poses) || (rates && run.from == StartFrom::motion))
    notes.push_back(fmt::format("initial {} not used: this analysis starts from the end of another one",
                                rates && run.from == StartFrom::motion ? "values and rates are" : "values are"));
  const StartVelocities& velocities = start.velocities;
  if (!velocities.derived.empty())
    notes.push_back(
        fmt::format("initial velocities of {} were computed from joints, drives and given velocities with the smallest "
                    "kinetic energy, {}",
                    quoted(velocities.derived), with_unit(velocities.kinetic_energy, energy_label(units))));
  if (!velocities.deforming.empty())
    notes.push_back(
        fmt::format("no rigid motion of {} agrees with the initial velocities: they start to deform at the smallest "
                    "possible strain rate ({:.3g} of the kinetic energy)",
                    quoted(velocities.deforming), velocities.deformation / velocities.kinetic_energy));
  if (start.projection.velocity > 1e-6)
    notes.push_back(fmt::format(
        "given velocities were corrected by up to {:.3g} of the largest velocity, which initial_tolerance allows",
        start.projection.velocity));
}

/// Prepares what an analysis needs besides a state that satisfies the constraints.
void prepare(Run& run) {
  switch (run.scene.analysis) {
    case formats::AnalysisKind::dynamics:
    case formats::AnalysisKind::assembly:
      break;
    case formats::AnalysisKind::statics: {
      if (const auto& rotation = run.scene.statics.rotation) {
        const std::string fixed = what_does_not_turn(run.built.model, *rotation, run.built.state, run.workspace.now);
        if (!fixed.empty())
          throw Error(fmt::format("statics: steady rotation is not possible. {}", fixed), run.scene.file,
                      "let it act along the axis or rotate with the scene, or use `analysis: dynamics`");
      }
      const Settled settled = settle_under_load(run.built.model, run.scene.statics, run.control.interrupted,
                                                run.built.state, run.workspace);
      if (settled.descents > 0)
        run.report.notes.push_back(
            fmt::format("nothing holds the scene in its initial position; the equilibrium was found in {} steps "
                        "downhill in potential energy",
                        settled.descents));
      if (!settled.free.empty())
        throw Error(fmt::format("statics: the scene can move freely: nothing holds {}", settled.free), run.scene.file,
                    run.scene.statics.rotation
                        ? "drive it under `motions:` if it rotates with the scene, or hold it with a joint"
                        : "hold it with a joint, or use `analysis: dynamics`");
      break;
    }
    case formats::AnalysisKind::kinematics:
    case formats::AnalysisKind::inverse_dynamics:
      require_determined(run.built.model, run.report.mobility, run.scene.file, run.built.state, run.workspace);
      break;
    case formats::AnalysisKind::modes:
      solve_accelerations(run.built.model, massless_step, run.scene.file, run.built.state, run.workspace);
      break;
  }
}

/// Predicts the size of the results after the row of `time`: announces it once enough rows are stored.
void predict_size(double time, Run& run) {
  constexpr double enough = 1e7;  // bytes: a hundredth of the size that is announced
  OutputForecast& forecast = run.forecast;
  if (forecast.bytes == 0) return;
  forecast.rows += 1.0;
  const double gone = time - forecast.from, whole = run.scene.integrator.end - forecast.from;
  if (forecast.rows * static_cast<double>(forecast.bytes) < enough || !(gone > 0.0)) return;
  const std::string text = large_output(run.scene, forecast.rows * whole / gone, forecast.bytes);
  if (!text.empty()) run.control.announce(text);
  forecast.bytes = 0;
}

}  // namespace

Run::Run(const formats::Scene& scene_to_run, const BodyFiles& files, const RunControl& run_control)
    : switched(with_effects_switched(scene_to_run, files)),
      scene(switched ? *switched : scene_to_run),
      control(run_control),
      built(build_model(scene, files)),
      workspace(built.model),
      doubts(scene, built.model),
      angles(built.model),
      at_start(built.state),
      values(scene_values(scene_to_run, files)) {
  report.analysis = scene.analysis;
  report.notes = merged(built.notes);
  if (std::string far = far_centres(built.model); !far.empty()) report.notes.push_back(std::move(far));
  report.scene_notes = report.notes;
  report.solver = describe(built.model.solver);
  report.unknowns = built.model.pattern->size();
  report.nonzeros = built.model.pattern->nonzeros();
  report.effects = effects(built.model);
  report.switches = effects_text(effects_of(scene_to_run, files), !scene.planar_at.empty());
}

std::string nonfinite_load(Run& run, double time) {
  const Model& model = run.built.model;
  Evaluation& now = run.workspace.now;
  const std::string instant = fmt::format("t = {:.6g}{}", time, after_time(model.units));
  std::string first;
  const auto look = [&](const std::string& what, const formats::TimeFunctionSpec& spec, double value) {
    if (first.empty()) first = nonfinite_text(what, spec, instant, value);
  };
  for (std::size_t i = 0; i < model.loads.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      look(fmt::format("load '{}', {} component", model.loads[i].name, "xyz"[k]), model.loads[i].components[k],
           now.load_functions[i][k](time));
  for (std::size_t i = 0; i < model.part_loads.size(); ++i)
    look(fmt::format("load '{}', value", model.part_loads[i].name), model.part_loads[i].value,
         now.part_load_functions[i](time));
  for (std::size_t i = 0; i < model.springs.size(); ++i)
    if (now.spring_forces[i])
      look(fmt::format("spring '{}', force", model.springs[i].name), model.springs[i].force,
           (*now.spring_forces[i])(time));
  for (const Coupling& coupling : model.couplings)
    if (const int at = coupling.motion; at >= 0) {
      const MotionFunction::Value f = now.motions[at](time);
      look(coupling.name, model.motions[at], f.value + f.rate + f.acceleration);
    }
  return first;
}

void begin_from(Run& run, const State& end) {
  State& state = run.built.state;
  TISSERAND_ENSURE(end.block().size() == state.block().size(), "{} numbers for {}", end.block().size(),
                   state.block().size());
  state.block() = end.block();
  state.time() = state.load_time() = run.scene.integrator.start;
  state.active().setOnes();
  run.from = state.v().isZero(0.0) ? StartFrom::rest : StartFrom::motion;
}

void start(Run& run) {
  require_method_fits(run);
  require_finite_loads(run);
  if (run.scene.analysis == formats::AnalysisKind::assembly) {  // makes the start of other analyses
    run.report.mobility = count_mobility(run.built.model, run.built.state, run.workspace.now);
    return;
  }
  const StartReport report = start(run.scene, run.from, run.built, run.workspace);
  run.report.mobility = report.mobility;
  run.report.preflight = report.preflight;
  run.report.projection = report.projection;
  note_start(report, run);
  find_freedoms(run.built.model, run.built.state, run.workspace.now, run.report.mobility);
  note_mechanism(run);
  run.massless = report.massless;
  if (report.massless)
    run.report.notes.push_back(
        "the mass matrix is singular: accelerations in massless directions follow from static equilibrium");
  prepare(run);
}

formats::ResultsLayout begin_rows(Run& run, const BodyFiles& files) {
  keep_chosen_places(run.scene, run.built.model);
  formats::ResultsLayout layout = results_layout(run.built.model, run.scene);
  if (run.control.announce) {
    std::vector<std::string> large;
    note_large_output(run.scene, run.built.model, run.built.state.time(), large);
    for (const std::string& text : large) run.control.announce(text);
    if (large.empty() && run.scene.analysis == formats::AnalysisKind::dynamics && !knows_rows(run.scene))
      run.forecast = {formats::bytes_of_row(layout), std::max(run.built.state.time(), run.scene.output.from), 0.0};
  }
  layout.simulated = simulated_scene(run.scene, files, run.built, run.at_start);
  return layout;
}

std::string why_to_end(Run& run) {
  std::string reason = run.angles.observe(run.built.model, run.built.state, run.workspace.now);
  return reason.empty() ? off_road(run.built.model, run.built.state, run.workspace.now) : reason;
}

bool is_interrupted(Run& run) {
  const bool interrupted = run.control.interrupted && run.control.interrupted();
  if (interrupted)
    run.report.end(RunOutcome::interrupted,
                   fmt::format("interrupted at t = {:.6g}{}", run.built.state.time(), after_time(run.scene.units)));
  return interrupted;
}

void report_doubts(Run& run) {
  std::vector<std::string>& doubts = run.report.doubts;
  const auto stressed = [&run]() -> std::vector<bool> {
    if (run.built.model.planar) return {};  // such stress needs coordinates out of the plane, which do not exist
    evaluate(run.built.model, run.built.state, run.workspace.now);
    return stressed_by_constraints(run.built.model, run.workspace.now);
  };
  for (std::string& doubt : run.doubts.tell(run.built.model, stressed)) doubts.push_back(std::move(doubt));
  for (std::string& note : damping_notes(run.built.model)) run.report.notes.push_back(std::move(note));
}

void write_row(Run& run, const StepReport& step, double size, RowWriter& out) { write_row(run, step, size, out, {}); }

void write_row(Run& run, const StepReport& step, double size, RowWriter& out, const RowEdit& edit) {
  formats::ResultsRow& row = out.row;
  const double before = run.seconds();
  fill_row(run.built.model, run.built.state, run.workspace.now, row);
  row.step = size;
  row.iterations = step.iterations;
  row.residual = step.residual;
  row.constraint = step.constraint;
  if (run.report.analysis == formats::AnalysisKind::statics)
    row.work = row.dissipated = row.balance = std::numeric_limits<double>::quiet_NaN();
  if (edit) edit(row);
  out.writer.append(row);
  if (run.listener != nullptr) {
    run.listener->row(row);
    run.listener->state(run.built.state);
  }
  RunReport& report = run.report;
  if (report.analysis == formats::AnalysisKind::dynamics) run.doubts.at_row(run.instant(), row);
  ++report.rows;
  predict_size(row.time, run);
  report.balance = row.balance;
  report.largest_balance = std::max(report.largest_balance, std::abs(row.balance));
  report.energy_reference = run.doubts.energy_moved();
  report.seconds_output += run.seconds() - before;
}

}  // namespace tisserand::mechanism
