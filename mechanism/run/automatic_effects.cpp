// Start, windows, switches and what is told of them.
#include "mechanism/run/automatic_effects.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/run/output.hpp"
#include "mechanism/run/run.hpp"
#include "mechanism/switching/constraint_stress.hpp"
#include "mechanism/switching/welds.hpp"

namespace tisserand::mechanism {
namespace {

/// An effect that takes less than this part of what is allowed, for so many windows, sleeps.
constexpr double quiet_demand = 0.25;
constexpr int quiet_windows = 10;
/// The least tolerance that forces keep too where vibrations are no matter (docs/EFFECTS.md, "Forces and tolerance").
constexpr double least_held = 1e-3;
/// In the memory of a checkpoint, of an effect that stays on; 1: it is awake.
constexpr double held_value = 2.0;
/// Steps of a window where the scene gives no length, and its part of the run where steps have no fixed size; three
/// steps have second differences.
constexpr double window_steps = 20.0, window_part = 0.01, least_steps = 3.0;

double window_of(const formats::Scene& scene) {
  const formats::IntegratorSpec& integrator = scene.integrator;
  const double least = integrator.error_control.active ? 0.0 : least_steps * integrator.step;
  if (scene.automatic.window) return std::max(*scene.automatic.window, least);
  return integrator.error_control.active ? window_part * (integrator.end - integrator.start)
                                         : window_steps * integrator.step;
}

void require_method(const formats::Scene& scene) {
  const formats::Method method = scene.integrator.method;
  if (method == formats::Method::generalised_alpha || method == formats::Method::hht) return;
  throw Error("effects: 'auto' switches between steps of generalised_alpha and hht, not of bdf and radau", scene.file,
              "give another method, or 'on' and 'off' in place of 'auto'");
}

bool is_flexibility(const EffectUse& use) { return use.effect == formats::Effect::flexibility; }

}  // namespace

AutomaticEffects::AutomaticEffects(const formats::Scene& scene, const BodyFiles& files, std::vector<EffectUse> uses)
    : scene_(scene),
      files_(files),
      window_(window_of(scene)),
      whole_{{}, State(Sizes{}), {}, {}, {}},
      whole_state_(Sizes{}) {
  require_method(scene);
  for (EffectUse& use : uses) uses_.push_back({std::move(use), -1, false, true, true, 0.0, 0, {}});
  for (Use& use : uses_)
    for (std::size_t k = 0; k < uses_.size(); ++k)
      if (!is_flexibility(use.effect) && is_flexibility(uses_[k].effect) && uses_[k].effect.owner == use.effect.owner)
        use.flexibility = static_cast<int>(k);
}

std::string AutomaticEffects::rule() const {
  std::vector<std::string> flexible, stiff;
  for (const Use& use : uses_) (is_flexibility(use.effect) ? flexible : stiff).push_back(use.effect.owner);
  std::vector<std::string> parts;
  if (!flexible.empty()) parts.push_back("flexibility of " + listed(flexible));
  if (!stiff.empty()) parts.push_back("stiffening of " + listed(stiff));
  return fmt::format("{}: tolerance {:.6g}, window {:.6g}{}", listed(parts, "; "), scene_.automatic.tolerance, window_,
                     after_number(unit_label(scene_.units, 0, 0, 1)));
}

void AutomaticEffects::hold_stressed(Run& run) {
  const Model& model = run.built.model;
  evaluate(model, run.built.state, run.workspace.now);
  const std::vector<bool> stressed = stressed_by_constraints(model, run.workspace.now);
  std::vector<std::string> names;
  for (Use& use : uses_) {
    use.held = stressed[deforming_body(model, use.effect.owner)];
    if (use.held && std::ranges::count(names, use.effect.owner) == 0) names.push_back(use.effect.owner);
  }
  if (!names.empty())
    run.report.notes.push_back(
        fmt::format("auto: effects of {} stay on, since loops of joints can stress {}: what these bear, and whether "
                    "the loops move at all, depends on them. Joints that leave more free (spherical, cylindrical) take "
                    "that stress away",
                    listed(names), names.size() == 1 ? "this body" : "these bodies"));
}

AutomaticEffects::Awake AutomaticEffects::held() const {
  Awake list;
  for (const Use& use : uses_) list.push_back(use.held);
  return list;
}

/// Once.
void AutomaticEffects::doubt_sleep(const Awake& next, Run& run) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < uses_.size(); ++k)
    if (next[k] && !uses_[k].awake)
      names.push_back(fmt::format("{} of '{}'", formats::effect_word(uses_[k].effect.effect), uses_[k].effect.owner));
  if (names.empty() || std::exchange(doubted_, true)) return;
  run.report.doubts.push_back(fmt::format(
      "{} would matter from t = {:.6g} on and cannot wake there, since the joints do not close with it: give "
      "it 'on' in place of 'auto'",
      listed(names), run.built.state.time()));
}

void AutomaticEffects::doubt_undeformed(const Deformations& bent, double time, Run& run) {
  std::vector<std::string> names;
  for (const auto& [name, y] : bent) names.push_back(name);
  run.report.doubts.push_back(
      fmt::format("auto: {} woke undeformed at t = {:.6g}, since the joints do not close with the deformation that the "
                  "loads ask for, and vibrates "
                  "from there; give it 'on'",
                  listed(names), time));
}

AutomaticEffects::Awake AutomaticEffects::awake() const {
  Awake list;
  for (const Use& use : uses_) list.push_back(use.awake);
  return list;
}

formats::Scene AutomaticEffects::scene_with(const Awake& awake) const {
  std::vector<EffectUse> list;
  for (std::size_t k = 0; k < uses_.size(); ++k) {
    list.push_back(uses_[k].effect);
    list.back().on = awake[k];
  }
  return *with_effects_switched(with_switches(scene_, list), files_);
}

void AutomaticEffects::give_whole(Run& run) {
  whole_ = std::move(run.built);
  whole_state_ = whole_.state;
  whole_now_.emplace(whole_.model);
  std::vector<EffectUse> list;
  for (const Use& use : uses_) list.push_back(use.effect);
  demand_.emplace(whole_.model, list, scene_.automatic.tolerance, scene_.integrator.start);
}

void AutomaticEffects::take_over(BuiltModel built, const Awake& awake, const formats::Scene& scene, Run& run) {
  run.built = std::move(built);
  run.workspace = Workspace(run.built.model);
  run.doubts.enter(scene, run.built.model);
  sampled_ = false;
  now_.emplace(run.built.model);
  lift_.emplace(run.built.model, whole_.model);
  inertia_.emplace(run.built.model, whole_.model);
  inertia_set_ = false;
  for (std::size_t k = 0; k < uses_.size(); ++k) {
    uses_[k].quiet = uses_[k].awake == awake[k] ? uses_[k].quiet : 0;
    uses_[k].awake = awake[k];
  }
}

void AutomaticEffects::start_with(const Awake& awake, Run& run) {
  const formats::Scene scene = scene_with(awake);
  BuiltModel built = build_model(scene, files_);
  Workspace workspace(built.model);
  start(scene, StartFrom::poses, built, workspace);
  take_over(std::move(built), awake, scene, run);
}

/// Of the whole state: with all effects but the flexibility of bodies that have neither deformation nor its rate. Their
/// internal coordinates rest and their nodes stand as one rigid body, to what poses that were stored leave; modes of
/// modal bodies rest to what was left of them where a start put velocities on the joints.
AutomaticEffects::Awake AutomaticEffects::all_but_undeformed() {
  constexpr double round_off = 1e-10, left = 1e-8;  // of the characteristic length, of the largest speed
  Awake list(uses_.size(), true);
  evaluate(whole_.model, whole_state_, *whole_now_);
  const Model& model = whole_.model;
  const double length = round_off * model.length, speed = left * largest_speed(model, whole_state_);
  for (std::size_t i = 0; i < deforming_bodies(model); ++i) {
    if (!rests_inside(model, i, whole_state_) || demand_->bend(i, *whole_now_) > length) continue;
    if (modal_body_of(model, i) >= 0 && demand_->bend_rate(i, *whole_now_) > speed) continue;
    for (std::size_t k = 0; k < uses_.size(); ++k)
      if (uses_[k].effect.owner == name_of(model, i)) list[k] = false;
  }
  for (std::size_t k = 0; k < uses_.size(); ++k)
    if (uses_[k].flexibility < 0 && !is_flexibility(uses_[k].effect)) list[k] = true;
  return list;
}

void AutomaticEffects::begin(Run& run) {
  hold_stressed(run);
  give_whole(run);
  fresh_ = run.from == StartFrom::poses;
  if (fresh_) {
    start_with(held(), run);
    sample_here(run);
    Awake needed = held();
    for (std::size_t k = 0; k < uses_.size(); ++k) {
      const int flexibility = uses_[k].flexibility;
      needed[k] = needed[k] || demand_->of(k) > 1.0 || (flexibility >= 0 && demand_->of(flexibility) > 1.0);
    }
    note_start_forces();
    if (needed != awake()) start_with(needed, run);
  } else {
    const Awake all(uses_.size(), true);
    Awake some = all_but_undeformed();
    for (std::size_t k = 0; k < uses_.size(); ++k) some[k] = some[k] || uses_[k].held;
    BuiltModel built = build_model(scene_with(all), files_);
    built.state.block() = whole_.state.block();
    take_over(std::move(built), all, scene_with(all), run);
    if (some != all) switch_to(some, {}, true, run);
    switched_ = 0.0;
    jump_ = {};
  }
  for (Use& use : uses_) {
    use.was_awake = use.awake;
    use.changes.clear();
  }
}

void AutomaticEffects::restore(Run& run, const std::vector<double>& memory) {
  const std::size_t count = uses_.size();
  give_whole(run);
  Awake list;
  for (std::size_t k = 0; k < count; ++k) list.push_back(memory[k] != 0.0);
  const formats::Scene scene = scene_with(list);
  take_over(build_model(scene, files_), list, scene, run);
  for (std::size_t k = 0; k < count; ++k) {
    uses_[k].was_awake = uses_[k].awake;
    uses_[k].held = memory[k] == held_value;
    uses_[k].quiet = static_cast<int>(memory[count + k]);
  }
  energy_reference_ = memory[2 * count];
  switched_ = memory[2 * count + 1];
  resumes_ = memory[2 * count + 2] != 0.0;
  force_reference_ = memory[2 * count + 3];
  rates_.assign(memory.begin() + static_cast<std::ptrdiff_t>(2 * count + 4), memory.end());
}

std::size_t AutomaticEffects::memory_size(const Model& whole) const {
  std::size_t rates = 0;
  for (std::size_t i = 0; i < deforming_bodies(whole); ++i)
    rates += static_cast<std::size_t>(deformation_size(whole, i));
  return 2 * uses_.size() + 4 + rates;
}

std::vector<double> AutomaticEffects::memory() const {
  std::vector<double> memory;
  for (const Use& use : uses_) memory.push_back(use.held ? held_value : use.awake ? 1.0 : 0.0);
  for (const Use& use : uses_) memory.push_back(use.quiet);
  memory.push_back(energy_reference_);
  memory.push_back(switched_);
  memory.push_back(sampled_ ? 1.0 : 0.0);
  memory.push_back(force_reference_);
  std::vector<double> rates = demand_->rates();
  if (!sampled_) std::ranges::fill(rates, 0.0);  // of the model before a switch
  memory.insert(memory.end(), rates.begin(), rates.end());
  return memory;
}

const State& AutomaticEffects::whole_state(const Run& run) {
  evaluate_motion(run.built.model, run.built.state, *now_);
  lift_->apply(run.built.state, *now_, whole_state_);
  return whole_state_;
}

Mobility AutomaticEffects::mobility(const Run& run) {
  return count_mobility(whole_.model, whole_state(run), *whole_now_);
}

void AutomaticEffects::fill_row(Run& run, formats::ResultsRow& row) {
  whole_state(run);
  mechanism::fill_row({run.built.model, run.built.state, run.workspace.now}, {whole_.model, whole_state_, *whole_now_},
                      row);
  row.switched = switched_;
  row.balance -= switched_;
}

/// So far. Beside modal bodies, whose modes count among what an iteration must resolve, that of the samples.
double AutomaticEffects::largest_force(const Run& run) const {
  return whole_.model.modal_bodies.empty() ? run.built.state.force_scale(0) : force_reference_;
}

void AutomaticEffects::sample_here(const Run& run) {
  sampled_ = true;
  const State& state = run.built.state;
  whole_state(run);
  evaluate(whole_.model, whole_state_, *whole_now_);
  if (!inertia_set_) inertia_->set(state, scene_.integrator.step);
  inertia_set_ = true;
  blind_ = blind_ || !inertia_->knows();
  force_reference_ = std::max(force_reference_, whole_now_->outer_force);
  demand_->sample(whole_state_, *whole_now_, awake(), largest_force(run), *inertia_);
  force_reference_ = std::max(force_reference_, demand_->modal_force());
  const Energy energy = evaluate_energy(whole_.model, *whole_now_);
  energy_reference_ =
      std::max(energy_reference_, std::abs(energy.kinetic) + std::abs(energy.strain) + std::abs(state.work()));
}

void AutomaticEffects::begin_window(const Run& run) {
  blocked_ = inertia_set_ = false;
  if (!sampled_) {
    demand_->forget();
    if (!rates_.empty()) demand_->set_rates(std::exchange(rates_, {}));
    sample_here(run);
    inertia_set_ = !std::exchange(resumes_, false);  // else at the first sample of the window
  }
  demand_->begin_window();
}

AutomaticEffects::Verdict AutomaticEffects::sample(const Run& run) {
  if (std::ranges::all_of(uses_, &Use::held)) return Verdict::sleeps_well;
  sample_here(run);
  Verdict verdict = Verdict::sleeps_well;
  for (std::size_t k = 0; k < uses_.size() && !blocked_; ++k) {
    if (uses_[k].awake) continue;
    if (demand_->matters(k)) return Verdict::matters;
    if (demand_->of(k) > 1.0) verdict = Verdict::may_matter;
  }
  return verdict;
}

bool AutomaticEffects::wake(Run& run) {
  Awake next = awake(), surely = next;
  for (std::size_t k = 0; k < uses_.size(); ++k) {
    next[k] = next[k] || demand_->of(k) > 1.0;
    surely[k] = surely[k] || demand_->matters(k);
  }
  if (surely != awake()) next = surely;
  for (std::size_t k = 0; k < uses_.size(); ++k)
    if (uses_[k].flexibility >= 0 && !uses_[uses_[k].flexibility].awake && next[uses_[k].flexibility]) next[k] = true;
  if (fresh_ && run.report.steps == 0) {
    start_with(next, run);
    for (Use& use : uses_) use.was_awake = use.awake;
    begin_window(run);
    return true;
  }
  if (undo_sleep(next, run)) return true;
  sample_here(run);
  Deformations bent;
  for (std::size_t k = 0; k < uses_.size(); ++k) {
    if (!is_flexibility(uses_[k].effect) || uses_[k].awake || !next[k]) continue;
    const std::string& name = uses_[k].effect.owner;
    bent[name] = demand_->deformation(deforming_body(whole_.model, name));
  }
  const double time = run.built.state.time();
  bool woken = switch_to(next, bent, true, run);
  if (!woken && switch_to(next, {}, true, run)) {
    woken = true;
    doubt_undeformed(bent, time, run);
  }
  sampled_ = false;
  begin_window(run);
  blocked_ = !woken;
  if (blocked_) doubt_sleep(next, run);
  return woken;
}

bool AutomaticEffects::switch_to(const Awake& next, const Deformations& deformations, bool at_any_cost, Run& run) {
  const formats::Scene scene = scene_with(next);
  BodyGroup changed;
  for (std::size_t k = 0; k < uses_.size(); ++k)
    if (next[k] != uses_[k].awake) changed.insert(uses_[k].effect.owner);
  auto after = switch_model(scene, files_, {run.built.model, run.built.state}, changed, deformations);
  if (!after) return false;
  const double tolerance = scene_.automatic.tolerance, force = largest_force(run);
  if (!at_any_cost && !(std::abs(after->energy) <= tolerance * energy_reference_ && after->force <= tolerance * force))
    return false;
  const double time = run.built.state.time();
  run.doubts.leave(run.built.model);
  undo_.reset();
  if (!at_any_cost) undo_.emplace(Undo{std::move(run.built), awake(), switched_, jump_});
  for (std::size_t k = 0; k < uses_.size(); ++k)
    if (next[k] != uses_[k].awake) uses_[k].changes.push_back(time);
  take_over(std::move(after->built), next, scene, run);
  switched_ += after->energy;
  if (after->force > jump_.force) jump_ = {after->force, time, {changed.begin(), changed.end()}};
  return true;
}

/// Where what matters fell asleep at the beginning of the window: the run goes on with the state that it had there, so
/// that nothing of its deformation and no rate is lost.
bool AutomaticEffects::undo_sleep(const Awake& next, Run& run) {
  if (!undo_) return false;
  Undo before = std::move(*undo_);
  undo_.reset();
  bool in_vain = false;
  for (std::size_t k = 0; k < uses_.size(); ++k) in_vain = in_vain || (next[k] && before.awake[k] && !uses_[k].awake);
  if (!in_vain) return false;
  for (std::size_t k = 0; k < uses_.size(); ++k)
    if (before.awake[k] != uses_[k].awake) uses_[k].changes.pop_back();
  run.doubts.leave(run.built.model);
  take_over(std::move(before.built), before.awake, scene_with(before.awake), run);
  switched_ = before.switched;
  jump_ = before.jump;
  begin_window(run);
  return true;
}

bool AutomaticEffects::end_window(Run& run) {
  undo_.reset();
  Awake next = awake();
  for (std::size_t k = 0; k < uses_.size(); ++k) {
    uses_[k].quiet = uses_[k].awake && demand_->of(k) < quiet_demand ? uses_[k].quiet + 1 : 0;
    if (uses_[k].quiet >= quiet_windows && !uses_[k].held) next[k] = false;
  }
  for (std::size_t k = 0; k < uses_.size(); ++k)
    if (uses_[k].flexibility >= 0 && !next[uses_[k].flexibility]) next[k] = false;
  if (next == awake()) return false;
  if (switch_to(next, {}, false, run)) return true;
  for (std::size_t k = 0; k < uses_.size(); ++k)
    if (!next[k]) uses_[k].quiet = 0;  // it waits
  return false;
}

std::vector<std::string> AutomaticEffects::slept_in_a_weld() const {
  const std::vector<int> part = welded_parts(whole_.model);
  std::vector<std::string> names;
  for (const Use& use : uses_) {
    if (!is_flexibility(use.effect) || use.changes.size() < (use.was_awake ? 1U : 2U)) continue;
    const int own = part[deforming_body(whole_.model, use.effect.owner)];
    if (std::ranges::count(part, own) > 1) names.push_back(use.effect.owner);
  }
  return names;
}

/// Elastic forces of bodies that sleep where the run starts: with flexibility on, an undeformed body bears nothing yet.
void AutomaticEffects::note_start_forces() {
  for (Use& use : uses_)
    use.start_force = use.awake ? 0.0 : demand_->force(deforming_body(whole_.model, use.effect.owner));
}

/// Notes on forces that do not keep the tolerance.
void AutomaticEffects::tell_forces(Run& run) const {
  const double tolerance = scene_.automatic.tolerance, largest = largest_force(run);
  std::vector<std::string> names;
  double part = 0.0;
  for (const Use& use : uses_) {
    if (!is_flexibility(use.effect) || use.was_awake || !(use.start_force > tolerance * largest)) continue;
    names.push_back(use.effect.owner);
    part = std::max(part, use.start_force / largest);
  }
  if (!names.empty())
    run.report.notes.push_back(
        fmt::format("auto: {} bear{} loads at the start and {} not yet deformed. With flexibility on that excites "
                    "vibrations of up to {:.2g} of the largest force, which is beyond the tolerance {:g}. auto omits "
                    "them while bodies sleep: begin from an analysis `statics`, or give flexibility: on",
                    listed(names), names.size() == 1 ? "s" : "", names.size() == 1 ? "is" : "are", part, tolerance));
  const bool switches = std::ranges::any_of(uses_, [](const Use& use) { return !use.changes.empty(); });
  if (switches && tolerance < least_held)
    run.report.notes.push_back(
        fmt::format("auto: positions keep the tolerance {:g}. Forces may err by ten times that, or more, after effects "
                    "switch, since a body that sleeps keeps no vibration. They keep tolerances of {:g} and more",
                    tolerance, least_held));
  if (jump_.force > tolerance * largest)
    run.report.doubts.push_back(
        fmt::format("auto: a force of a joint jumps by {:.2g} of the largest force where effects of {} switch (at t = "
                    "{:.6g}), beyond the tolerance {:g}, so that forces near this instant do not keep it: give 'on' in "
                    "place of 'auto' where they matter",
                    jump_.force / largest, listed(jump_.bodies), jump_.time, tolerance));
}

void AutomaticEffects::tell(Run& run) const {
  RunReport& report = run.report;
  const double start = run.scene.integrator.start, end = report.time;
  tell_forces(run);
  if (blind_)
    report.doubts.push_back(
        "auto: what sleeping bodies move along with their joints could not be counted at times, so that resonances "
        "with it are not seen; give flexibility: on to bodies that may resonate");
  if (const std::vector<std::string> names = slept_in_a_weld(); !names.empty())
    report.doubts.push_back(
        fmt::format("auto: {} fell asleep welded to flexible bodies, which may vibrate since then by more than "
                    "tolerance allows; give the pieces of one part flexibility: on, or a smaller tolerance",
                    listed(names)));
  for (const Use& use : uses_) {
    SwitchHistory history{formats::effect_word(use.effect.effect), use.effect.owner, use.was_awake, use.changes, 0.0};
    bool on = use.was_awake;
    double since = start;
    for (const double time : use.changes) {
      if (on) history.time_on += time - since;
      since = time;
      on = !on;
    }
    if (on) history.time_on += end - since;
    history.part_on = end > start ? history.time_on / (end - start) : on ? 1.0 : 0.0;
    report.automatic.push_back(std::move(history));
  }
}

}  // namespace tisserand::mechanism
