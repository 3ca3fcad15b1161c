// SPDX-License-Identifier: GPL-3.0-or-later
// The validity checks of a run, called one after the other.
#include "mechanism/doubts/doubts.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "mechanism/doubts/damping_reach.hpp"
#include "mechanism/equations/round_off.hpp"

namespace tisserand::mechanism {

std::vector<std::string> worst_of(const std::vector<Excess>& excesses, const char* others) {
  if (excesses.empty()) return {};
  const Excess& worst = *std::ranges::max_element(excesses, {}, &Excess::ratio);
  return {excesses.size() == 1 ? worst.text : fmt::format("{}. {}: {}", worst.text, others, excesses.size() - 1)};
}

bool has_alpha_steps(const formats::Scene& scene) {
  const formats::Method method = scene.integrator.method;
  return scene.analysis == formats::AnalysisKind::dynamics &&
         (method == formats::Method::generalised_alpha || method == formats::Method::hht);
}

Doubts::Doubts(const formats::Scene& scene, const Model& model)
    : energy_(scene.integrator.start, scene.integrator.end) {
  for (MakeDoubt* const make :
       {momentum_balance, tumbling_balance, multiplier_swing, reaction_vibration, step_resolution, touch_resolution,
        linear_range, beam_range, bushing_range, table_range, inertia_choice, torsion, axial_spin, tyre_range})
    if (std::unique_ptr<Doubt> doubt = make(scene, model)) all_.push_back(std::move(doubt));
}

void Doubts::after_step(const State& before, const Instant& end) {
  for (const auto& doubt : all_) doubt->after_step(before, end);
}

void Doubts::at_state(const Instant& at) {
  for (const auto& doubt : all_) doubt->observe(at);
}

void Doubts::at_row(const Instant& at, const formats::ResultsRow& row) {
  energy_.observe(row, std::max(at.evaluation.force_scale[0], force_round_off(at.model, at.state)) * at.model.length);
}

std::vector<std::string> Doubts::tell(const Model& model, const StressedBodies& stressed) const {
  std::vector<std::string> reported = energy_.doubts(explanation(Puzzle::energy, model), model.units);
  for (const auto& doubt : all_)
    for (std::string& text : doubt->doubts(model, stressed)) reported.push_back(std::move(text));
  for (std::string& text : damping_doubts(model)) reported.push_back(std::move(text));
  return reported;
}

std::string Doubts::explanation(Puzzle puzzle, const Model& model) const {
  for (const auto& doubt : all_)
    if (std::string text = doubt->explanation(puzzle, model); !text.empty()) return text;
  return {};
}

}  // namespace tisserand::mechanism
