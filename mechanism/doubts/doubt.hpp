// A doubt of a run: a quantity that is measured at its states, and sentences where it leaves the limit that has a
// source.
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

/// Per superelement, whether joints can stress it though no load acts (switching/constraint_stress.hpp); empty: not
/// known.
using StressedBodies = std::function<std::vector<bool>()>;

/// Questions that others ask the doubts: why a run fails, why it fails although its equations are regular, and where
/// energy went.
enum class Puzzle { failure, regular_failure, energy };

class Doubt {
 public:
  virtual ~Doubt() = default;

  virtual void observe(const Instant&) {}
  /// The state is the end of a step from `before`.
  virtual void after_step(const State& /*before*/, const Instant& end) { observe(end); }

  /// Sentences on the worst of each kind, mostly with the number of others. `stressed` is called only where it matters.
  virtual std::vector<std::string> doubts(const Model& model, const StressedBodies& stressed) const = 0;
  /// Sentence on what was seen that answers the question; empty if nothing was.
  virtual std::string explanation(Puzzle, const Model&) const { return {}; }
};

/// How far something is beyond its limit, and the sentence on it.
struct Excess {
  double ratio = 0.0;
  std::string text;
};
/// The largest alone, "(and 3 <others>)"; none: nothing.
std::vector<std::string> worst_of(const std::vector<Excess>& excesses, const char* others);

/// Whether it is dynamics by steps of generalised alpha or HHT.
bool has_alpha_steps(const formats::Scene& scene);

/// One kind for a run; null where it cannot arise.
using MakeDoubt = std::unique_ptr<Doubt>(const formats::Scene& scene, const Model& model);
MakeDoubt axial_spin, beam_range, bushing_range, inertia_choice, linear_range, momentum_balance, multiplier_swing,
    reaction_vibration, step_resolution, table_range, torsion, touch_resolution, tumbling_balance, tyre_range;

}  // namespace tisserand::mechanism
