// The doubts of a run, asked one after the other.
#include "mechanism/doubts/doubts.hpp"

#include <algorithm>
#include <utility>

#include "mechanism/doubts/damping_reach.hpp"
#include "mechanism/equations/round_off.hpp"

namespace tisserand::mechanism {

Doubts::Doubts(const formats::Scene& scene, const Model& model)
    : energy_(scene.integrator.start, scene.integrator.end),
      momentum_(scene, model),
      tumbling_(scene, model),
      range_(model, scene.integrator.start),
      beams_(model),
      bushings_(model),
      tables_(model),
      inertia_(scene, model),
      torsion_(scene, model),
      spin_(model),
      tyres_(model),
      resolution_(scene, model),
      touches_(scene, model),
      swing_(scene),
      vibration_(scene, model) {}

void Doubts::after_step(const Model& model, const State& before, const State& state, const Evaluation& evaluation) {
  range_.observe(model, state, evaluation);
  beams_.observe(state, evaluation);
  bushings_.observe(state, evaluation);
  tables_.observe(model, state, evaluation);
  inertia_.observe(model, state, evaluation);
  torsion_.observe(model, state, evaluation);
  spin_.observe(model, state, evaluation);
  tyres_.observe(model, state, evaluation);
  resolution_.observe(model, before, state);
  touches_.observe(model, state, evaluation);
  swing_.observe(before, state);
  vibration_.observe(state);
  momentum_.after_step(model, state, evaluation);
  tumbling_.observe(model, state.time(), evaluation);
}

void Doubts::at_state(const Model& model, const State& state, const Evaluation& evaluation) {
  range_.observe(model, state, evaluation);
  beams_.observe(state, evaluation);
  bushings_.observe(state, evaluation);
  tables_.observe(model, state, evaluation);
  inertia_.observe(model, state, evaluation);
  torsion_.observe(model, state, evaluation);
  spin_.observe(model, state, evaluation);
  tyres_.observe(model, state, evaluation);
  tumbling_.observe(model, state.time(), evaluation);
}

void Doubts::at_row(const Model& model, const State& state, const Evaluation& evaluation,
                    const formats::ResultsRow& row) {
  energy_.observe(row, std::max(evaluation.force_scale[0], force_round_off(model, state)) * model.length);
}

std::vector<std::string> Doubts::of_model(const Model& model, const StressedBodies& stressed) const {
  std::vector<std::string> all = told_;
  for (auto&& some : {momentum_.doubts(), tumbling_.doubts(model), swing_.doubts(), vibration_.doubts(), resolution_.doubts(model),
                      touches_.doubts(model), range_.doubts(model, stressed), beams_.doubts(model),
                      bushings_.doubts(model), tables_.doubts(model), inertia_.doubts(model), torsion_.doubts(model),
                      spin_.doubts(model), tyres_.doubts(model), damping_doubts(model)})
    for (const std::string& doubt : some)
      if (std::ranges::find(all, doubt) == all.end()) all.push_back(doubt);
  return all;
}

void Doubts::leave(const Model& model) { told_ = of_model(model, {}); }

void Doubts::enter(const formats::Scene& scene, const Model& model) {
  Doubts anew(scene, model);
  anew.energy_ = energy_;
  anew.told_ = std::move(told_);
  *this = std::move(anew);
}

std::vector<std::string> Doubts::tell(const Model& model, const StressedBodies& stressed) const {
  std::vector<std::string> all = energy_.doubts(bushings_.cause_of_jumps(model));
  for (std::string& doubt : of_model(model, stressed)) all.push_back(std::move(doubt));
  return all;
}

}  // namespace tisserand::mechanism
