// What a run doubts of its own results: measured quantities beyond limits that have a source, one line each.
#pragma once

#include <string>
#include <vector>

#include "mechanism/doubts/axial_spin.hpp"
#include "mechanism/doubts/balances.hpp"
#include "mechanism/doubts/inertia_choice.hpp"
#include "mechanism/doubts/law_range.hpp"
#include "mechanism/doubts/linear_range.hpp"
#include "mechanism/doubts/multiplier_swing.hpp"
#include "mechanism/doubts/step_resolution.hpp"
#include "mechanism/doubts/torsion.hpp"
#include "mechanism/doubts/tyre_range.hpp"

namespace tisserand::mechanism {

class Doubts {
 public:
  Doubts(const formats::Scene& scene, const Model& model);

  /// After a step from `before` to the accepted `state`, evaluated there.
  void after_step(const Model& model, const State& before, const State& state, const Evaluation& evaluation);
  /// At an evaluated state that no step of generalised alpha ends at: statics, rows of bdf.
  void at_state(const Model& model, const State& state, const Evaluation& evaluation);
  void at_row(const Model& model, const State& state, const Evaluation& evaluation, const formats::ResultsRow& row);
  double energy_moved() const { return energy_.moved(); }

  /// The run goes on with another model of the scene: what there was to tell of this one is kept, and observing begins
  /// anew, but of the energy.
  void leave(const Model& model);
  void enter(const formats::Scene& scene, const Model& model);

  /// Costs nothing while there is nothing to tell; eigenvalues of bodies that spin.
  std::vector<std::string> tell(const Model& model, const StressedBodies& stressed) const;

  /// See MultiplierSwing::latest(), StepResolution::latest() and Torsion::doubts().
  std::string latest_swing() const { return swing_.latest(); }
  double latest_change() const { return resolution_.latest(); }
  std::vector<std::string> soft_torsion(const Model& model) const { return torsion_.doubts(model); }

 private:
  EnergyBalance energy_;
  MomentumBalance momentum_;
  TumblingBalance tumbling_;
  LinearRange range_;
  BeamRange beams_;
  BushingRange bushings_;
  TableRange tables_;
  InertiaChoice inertia_;
  Torsion torsion_;
  AxialSpin spin_;
  TyreRange tyres_;
  StepResolution resolution_;
  TouchResolution touches_;
  MultiplierSwing swing_;
  ReactionVibration vibration_;
  std::vector<std::string> told_;  ///< of models that were left

  std::vector<std::string> of_model(const Model& model, const StressedBodies& stressed) const;
};

}  // namespace tisserand::mechanism
