// SPDX-License-Identifier: GPL-3.0-or-later
// A validity check of a run: it measures a quantity at the states of the run, and warns if it exceeds a limit that has
// a source.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// An accepted state and its evaluation.
struct Instant {
  const Model& model;
  const State& state;
  const Evaluation& evaluation;
};

/// Per superelement, whether joints can stress it without loads (switching/constraint_stress.hpp). Empty: unknown.
using StressedBodies = std::function<std::vector<bool>()>;

/// Questions to the validity checks: why a run fails, why it fails although its equations are regular, and where energy
/// was lost.
enum class Puzzle { failure, regular_failure, energy };

class Doubt {
 public:
  virtual ~Doubt() = default;

  virtual void observe(const Instant&) {}
  /// Observes the state at the end of a step from `before`.
  virtual void after_step(const State& /*before*/, const Instant& end) { observe(end); }

  /// Warnings on the worst case of each kind, mostly with the number of others. `stressed` is called only if needed.
  virtual std::vector<std::string> doubts(const Model& model, const StressedBodies& stressed) const = 0;
  /// Sentence on an observation that answers the question; empty if there is none.
  virtual std::string explanation(Puzzle, const Model&) const { return {}; }
};

/// Ratio of a quantity to its limit, and the warning on it.
struct Excess {
  double ratio = 0.0;
  std::string text;
};
/// Warning with the largest ratio alone, plus "(and 3 <others>)"; none if there are no excesses.
std::vector<std::string> worst_of(const std::vector<Excess>& excesses, const char* others);

/// Whether the analysis is dynamics with steps of generalised alpha or HHT.
bool has_alpha_steps(const formats::Scene& scene);

/// Factory of one validity check for a run; null if the check does not apply.
using MakeDoubt = std::unique_ptr<Doubt>(const formats::Scene& scene, const Model& model);
MakeDoubt axial_spin, beam_range, bushing_range, inertia_choice, linear_range, momentum_balance, multiplier_swing,
    reaction_vibration, step_resolution, table_range, torsion, touch_resolution, tumbling_balance, tyre_range;

}  // namespace tisserand::mechanism
