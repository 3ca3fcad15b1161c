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

/// Instant of a run: an accepted state and its evaluation.
struct Instant {
  const Model& model;
  const State& state;
  const Evaluation& evaluation;
};

/// Function that returns, per superelement, whether joints can stress it without loads
/// (switching/constraint_stress.hpp). An empty result means unknown.
using StressedBodies = std::function<std::vector<bool>()>;

/// Question to the validity checks. `failure`: why a run fails. `regular_failure`: why it fails although its equations
/// are regular. `energy`: where energy was lost.
enum class Puzzle { failure, regular_failure, energy };

/// Validity check of a run. It measures a quantity at the states of the run, and warns if the quantity exceeds a limit
/// that has a source.
class Doubt {
 public:
  virtual ~Doubt() = default;

  /// Observes an accepted state.
  virtual void observe(const Instant&) {}
  /// Observes the state `end` at the end of a step that began at the state `before`.
  virtual void after_step(const State& /*before*/, const Instant& end) { observe(end); }

  /// Warnings on the worst case of each kind, mostly with the number of other cases. `stressed` is called only if
  /// needed.
  virtual std::vector<std::string> doubts(const Model& model, const StressedBodies& stressed) const = 0;
  /// Sentence with an observation that answers the question; empty if there is none.
  virtual std::string explanation(Puzzle, const Model&) const { return {}; }
};

/// Case in which a quantity exceeds its limit: ratio of the quantity to the limit, and warning.
struct Excess {
  double ratio = 0.0;
  std::string text;
};
/// Warning with the largest ratio, to which "<others>: 3" is added if there are 3 more. Empty if there are no excesses.
std::vector<std::string> worst_of(const std::vector<Excess>& excesses, const char* others);

/// Whether the analysis is dynamics with steps of generalised alpha or HHT.
bool has_alpha_steps(const formats::Scene& scene);

/// Function that makes one validity check for a run; null if the check does not apply.
using MakeDoubt = std::unique_ptr<Doubt>(const formats::Scene& scene, const Model& model);
MakeDoubt axial_spin, beam_range, bushing_range, inertia_choice, linear_range, momentum_balance, multiplier_swing,
    reaction_vibration, step_resolution, table_range, torsion, touch_resolution, tumbling_balance, tyre_range;

}  // namespace tisserand::mechanism
