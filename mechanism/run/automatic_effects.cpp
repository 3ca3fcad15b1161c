// SPDX-License-Identifier: GPL-3.0-or-later
// Choice of automatic effects, its monitoring during a run, and its report.
#include "mechanism/run/automatic_effects.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/text.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/run/run.hpp"
#include "mechanism/step/step_control.hpp"
#include "mechanism/switching/constraint_stress.hpp"
#include "mechanism/switching/deformation.hpp"

namespace tisserand::mechanism {
namespace {

/// Steps between two samples, and their interval as a fraction of the run if steps have no fixed size.
constexpr double sample_steps = 4.0, sample_part = 0.002;
/// A run that begins again turns on what matters, and also what exceeds this fraction of the tolerance. The second time
/// it is half of this fraction, and so on. So a run begins again only a few times.
constexpr double nearly = 0.5;

bool is_flexibility(const EffectUse& use) { return use.effect == formats::Effect::flexibility; }

/// Largest displacements of the deformation of a body and of its rate.
struct Bend {
  double place = 0.0;
  double rate = 0.0;  ///< [length/time]
};

Bend bend_of(const Model& model, std::size_t index, const Evaluation& now) {
  const auto measured = [&](const Compliance& compliance) {
    const Deformation deformation = deformation_of(model, index, now);
    const auto displacement = [&](const Eigen::VectorXd& y) {
      return compliance.displacement(compliance.without_rigid_motion(y));
    };
    return Bend{displacement(deformation.y), displacement(deformation.rate)};
  };
  if (const int modal = modal_body_of(model, index); modal >= 0)
    return measured(ModalCompliance(model, static_cast<std::size_t>(modal)));
  return measured(SuperelementCompliance(body_of(model, index)));
}

}  // namespace

AutomaticEffects::Watch::Watch(const Model& running, const Model& whole, const std::vector<EffectUse>& uses,
                               const formats::Scene& scene)
    : now(running),
      lift(running, whole),
      inertia(running, whole),
      demand(whole, uses, scene.automatic.tolerance, scene.integrator.start) {}

AutomaticEffects::AutomaticEffects(const formats::Scene& scene, std::vector<EffectUse> uses) : scene_(scene) {
  const formats::IntegratorSpec& integrator = scene.integrator;
  const bool fixed = !integrator.error_control.active && integrator.method != formats::Method::bdf;
  interval_ = fixed ? sample_steps * integrator.step : sample_part * (integrator.end - integrator.start);
  for (EffectUse& use : uses) uses_.push_back({std::move(use), -1});
  for (Use& use : uses_)
    for (int k = 0; k < std::ssize(uses_); ++k)
      if (!is_flexibility(use.effect) && is_flexibility(uses_[k].effect) && uses_[k].effect.owner == use.effect.owner)
        use.flexibility = k;
}

std::vector<EffectUse> AutomaticEffects::effects() const {
  std::vector<EffectUse> list;
  for (const Use& use : uses_) list.push_back(use.effect);
  return list;
}

bool AutomaticEffects::any_off() const {
  return std::ranges::any_of(uses_, [](const Use& use) { return !use.effect.on; });
}

formats::Scene AutomaticEffects::scene() const {
  formats::Scene chosen = with_switches(scene_, effects());
  chosen.initial_tolerance = std::max(chosen.initial_tolerance, straightened_);
  return chosen;
}

std::vector<std::string> AutomaticEffects::off() const {
  std::vector<std::string> list;
  for (const Use& use : uses_)
    if (!use.effect.on) list.push_back(effect_name(use.effect));
  return list;
}

std::optional<State> AutomaticEffects::begin_of(const Model& chosen) const {
  if (!begin_) return std::nullopt;
  return transfer(whole_->built.model, *begin_, chosen);
}

void AutomaticEffects::stand_beside(Run& whole) {
  whole_ = &whole;
  whole_state_.emplace(whole.built.state);
  whole_now_.emplace(whole.built.model);
}

void AutomaticEffects::begin(Run& whole, const std::optional<State>& begin) {
  constexpr double round_off = 1e-10, left = 1e-8;  // relative to the characteristic length, to the largest speed
  stand_beside(whole);
  begin_ = begin;
  const Model& model = whole.built.model;
  evaluate(model, *whole_state_, *whole_now_);
  const std::vector<bool> stressed = stressed_by_constraints(model, *whole_now_);
  const double speed = largest_speed(model, *whole_state_);
  const bool rests = whole.from == StartFrom::rest;
  const double bent = rests ? scene_.automatic.tolerance : round_off;
  std::vector<bool> on(uses_.size(), false);
  for (std::size_t k = 0; k < uses_.size(); ++k) {
    Use& use = uses_[k];
    const std::size_t index = deforming_body(model, use.effect.owner);
    on[k] = use.stressed = stressed[index];
    if (whole.from == StartFrom::poses || on[k]) continue;
    const Bend bend = bend_of(model, index, *whole_now_);
    on[k] = bend.place > bent * model.length || (!rests && bend.rate > left * speed);
    if (!on[k] && is_flexibility(use.effect)) straightened_ += 2.0 * bend.place / model.length;
  }
  for (Use& use : uses_) use.effect.on = false;
  turn_on(on);
}

void AutomaticEffects::go_on(Run& whole, const std::vector<std::string>& off) {
  stand_beside(whole);
  goes_on_ = true;
  for (Use& use : uses_) use.effect.on = std::ranges::find(off, effect_name(use.effect)) == off.end();
}

/// Turns on effects, with stiffening, and flexibility of welded bodies: a rigid piece would hold its neighbour.
void AutomaticEffects::turn_on(std::vector<bool> more) {
  const Model& model = whole_->built.model;
  const std::vector<int> part = welded_parts(model);
  const auto part_of = [&](const Use& use) { return part[deforming_body(model, use.effect.owner)]; };
  for (std::size_t k = 0; k < uses_.size(); ++k) {
    if (!more[k]) continue;
    for (std::size_t i = 0; i < uses_.size(); ++i)
      if (is_flexibility(uses_[k].effect) && is_flexibility(uses_[i].effect) && part_of(uses_[k]) == part_of(uses_[i]))
        more[i] = true;
  }
  for (std::size_t k = 0; k < uses_.size(); ++k) {
    Use& use = uses_[k];
    if (use.flexibility < 0) continue;
    if (more[k]) more[use.flexibility] = true;
    more[k] = more[use.flexibility];
  }
  for (std::size_t k = 0; k < uses_.size(); ++k)
    if (more[k]) uses_[k].effect.on = true;
}

bool AutomaticEffects::watch(Run& run) {
  watch_.reset();
  begins_again_ = false;
  if (!any_off()) return false;
  watch_.emplace(run.built.model, whole_->built.model, effects(), run.scene);
  watch_->next = run.built.state.time();
  const bool again = missed(run, false);
  for (Use& use : uses_)
    use.start_force = use.effect.on || goes_on_ || begin_
                          ? 0.0
                          : watch_->demand.force(deforming_body(whole_->built.model, use.effect.owner));
  return again;
}

void AutomaticEffects::sample(const Run& run) {
  Watch& watch = *watch_;
  const Model& whole = whole_->built.model;
  whole_state(run);
  evaluate(whole, *whole_state_, *whole_now_);
  if (watch.demand.begins_window()) {
    watch.inertia.set(run.built.state, run.scene.integrator.step);
    watch.blind = watch.blind || !watch.inertia.knows();
  }
  watch.force = std::max(watch.force, whole_now_->outer_force);
  watch.demand.sample(*whole_state_, *whole_now_, largest_force(run), watch.inertia);
  watch.force = std::max(watch.force, watch.demand.modal_force());
}

/// Largest force so far. With modal bodies that of the samples: the force scale includes forces of their modes.
double AutomaticEffects::largest_force(const Run& run) const {
  return whole_->built.model.modal_bodies.empty() ? run.built.state.force_scale(0) : watch_->force;
}

bool AutomaticEffects::missed(Run& run, bool ends) {
  if (!watch_) return false;
  const double time = run.built.state.time(), round_off = instant_tolerance(run.scene.integrator.step, time);
  if (!ends && time < watch_->next - round_off) return false;
  while (watch_->next <= time + round_off) watch_->next += interval_;
  ends = ends && run.scene.integrator.end == scene_.integrator.end;
  sample(run);
  const Demand& demand = watch_->demand;
  std::vector<bool> more(uses_.size(), false);
  for (std::size_t k = 0; k < uses_.size(); ++k) more[k] = !uses_[k].effect.on && demand.of(k, ends) > 1.0;
  if (std::ranges::find(more, true) == more.end()) return false;
  if (goes_on_) {
    doubt(more, run);
    return false;
  }
  begins_again_ = true;
  ++begins_;
  repeated_ += run.report.steps;
  for (std::size_t k = 0; k < uses_.size(); ++k) {
    Use& use = uses_[k];
    if (use.effect.on) continue;
    use.demand = demand.of(k, ends);
    use.time = demand.time_of(k);
    more[k] = more[k] || use.demand > std::pow(nearly, begins_);
  }
  turn_on(std::move(more));
  return true;
}

const State& AutomaticEffects::whole_state(const Run& run) {
  if (!watch_) return run.built.state;
  evaluate_motion(run.built.model, run.built.state, watch_->now);
  watch_->lift.apply(run.built.state, watch_->now, *whole_state_);
  return *whole_state_;
}

/// Adds the warning once.
void AutomaticEffects::doubt(const std::vector<bool>& missed, Run& run) {
  if (std::exchange(watch_->doubted, true)) return;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < uses_.size(); ++k)
    if (missed[k]) names.push_back(effect_name(uses_[k].effect));
  run.report.doubts.push_back(fmt::format(
      "auto: {} matters at t = {:.6g}{}, but is off in the run that this one continues; run the scene from its start",
      listed(names), run.built.state.time(), after_time(run.scene.units)));
}

void AutomaticEffects::report_begin(RunReport& report) const {
  report.tolerance = scene_.automatic.tolerance;
  report_stressed(report);
}

void AutomaticEffects::report_stressed(RunReport& report) const {
  std::vector<std::string> names;
  for (const Use& use : uses_)
    if (use.stressed && std::ranges::count(names, use.effect.owner) == 0) names.push_back(use.effect.owner);
  if (names.empty()) return;
  report.notes.push_back(fmt::format(
      "auto: effects of {} are on because loops of joints can stress {}: the loads in these loops, and whether they "
      "move at all, depend on these effects. Joints with more freedom (spherical, cylindrical) remove this stress",
      listed(names), names.size() == 1 ? "this body" : "these bodies"));
}

/// Adds a note on elastic forces at the start: with flexibility on, an undeformed body bears no load yet.
void AutomaticEffects::report_start_forces(const Run& run, RunReport& report) const {
  const double tolerance = scene_.automatic.tolerance, largest = largest_force(run);
  std::vector<std::string> names;
  double part = 0.0;
  for (const Use& use : uses_) {
    if (!is_flexibility(use.effect) || use.effect.on || !(use.start_force > tolerance * largest)) continue;
    names.push_back(use.effect.owner);
    part = std::max(part, use.start_force / largest);
  }
  if (names.empty()) return;
  report.notes.push_back(
      fmt::format("auto: {} carr{} loads at the start but {} not yet deformed. With flexibility on, this excites "
                  "vibrations of up to {:.2g} of the largest force, more than the tolerance {:g}. auto omits these "
                  "vibrations; start from an analysis `statics`, or set flexibility: on",
                  listed(names), names.size() == 1 ? "ies" : "y", names.size() == 1 ? "is" : "are", part, tolerance));
}

void AutomaticEffects::tell(Run& run) const {
  RunReport& report = run.report;
  report_begin(report);
  if (watch_) report_start_forces(run, report);
  if (watch_ && watch_->blind)
    report.doubts.push_back(
        "auto: the inertia that rigid bodies move through their joints could not be computed at some instants, so "
        "resonances with it are not detected; set flexibility: on for bodies that may resonate");
  report.repeated = repeated_;
  for (std::size_t k = 0; k < uses_.size(); ++k) {
    const Use& use = uses_[k];
    const bool watched = watch_ && !use.effect.on;
    report.automatic.push_back({formats::effect_word(use.effect.effect), use.effect.owner, use.effect.on,
                                watched ? watch_->demand.of(k, true) : use.demand,
                                watched ? watch_->demand.time_of(k) : use.time});
  }
}

}  // namespace tisserand::mechanism
