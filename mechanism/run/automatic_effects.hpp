// SPDX-License-Identifier: GPL-3.0-or-later
// Effects that a run chooses by itself (`auto`). It begins with as few as possible, estimates what the others would do,
// and begins again with those that matter.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/build/build_model.hpp"
#include "mechanism/build/effects.hpp"
#include "mechanism/switching/demand.hpp"
#include "mechanism/switching/transfer.hpp"

namespace tisserand::mechanism {

struct Run;
struct RunReport;

/// Choice of the effects that a run switches automatically. The choice is constant from beginning to end of a run:
/// model, rows and checkpoints are those of the scene with these effects `on` and the others `off`. The whole model,
/// with all effects on, is evaluated in parallel. Its coordinates express what an effect that is off would do
/// (demand.hpp).
class AutomaticEffects {
 public:
  /// Takes the automatic effects of a scene, which are all on at first. `uses`: automatic_effects() of the scene.
  /// Requires that `scene` outlives this object.
  AutomaticEffects(const formats::Scene& scene, std::vector<EffectUse> uses);

  /// Chooses the effects of a new run. `whole` is the started run with all effects on, which must outlive this object.
  /// `begin`: state from which `whole` started; absent: the poses of the scene. The choice turns on the effects of
  /// bodies that loops of joints can stress (constraint_stress.hpp). With a `begin` it also turns on the effects of
  /// bodies that are deformed there. At a `begin` at rest the deformation must exceed the tolerance.
  void begin(Run& whole, const std::optional<State>& begin);
  /// Sets the choice for a run that continues from a file. `whole`: run with all effects on, which has not started.
  /// `off`: names of the effects that are off in the file. A continued run cannot begin again, so an effect that
  /// matters causes a warning.
  void go_on(Run& whole, const std::vector<std::string>& off);

  /// List of the automatic effects. EffectUse::on is the present choice.
  std::vector<EffectUse> effects() const;
  bool any_off() const;
  /// Length of a window of ten samples [time].
  double window() const { return 2.0 * Demand::window_samples * interval_; }
  /// Scene with the chosen effects on and the others off, without automatic effects.
  formats::Scene scene() const;
  /// State from which the model `chosen`, built with this choice, begins. Absent: it begins from the poses of the
  /// scene.
  std::optional<State> begin_of(const Model& chosen) const;
  /// Names of the effects that are off: "flexibility of 'rod'".
  std::vector<std::string> off() const;

  /// Starts to monitor `run`, which has this choice and is at its start. Returns whether the run must begin again, as
  /// missed() does.
  bool watch(Run& run);
  /// Takes a sample after an accepted step if one is due. Returns true if the run must begin again, because an effect
  /// that is off matters. From now on the choice has this effect on. `ends`: whether the step is the last one of the
  /// run.
  bool missed(Run& run, bool ends);
  /// Whether watch() or missed() has demanded that the run begin again, since the last call of watch().
  bool begins_again() const { return begins_again_; }

  /// State of the run, in coordinates of the whole model.
  const State& whole_state(const Run& run);
  /// Adds to the report of the run the choice, and warnings about omitted effects that may matter.
  void tell(Run& run) const;
  /// Adds to the report of `check` the tolerance and the effects that are always on.
  void report_begin(RunReport& report) const;

 private:
  /// One automatic effect with its choice and what the run has found about it.
  struct Use {
    EffectUse effect;
    /// For stiffening: index of the use that is the flexibility of the body; -1: it is not automatic.
    int flexibility = -1;
    bool stressed = false;            ///< whether loops of joints can stress the body
    double demand = 0.0, time = 0.0;  ///< demand D (demand.hpp) that turned the effect on, and the time of D
    /// Largest elastic force of the body at the start of the run, if the effect is off.
    double start_force = 0.0;
  };
  /// Whole model, evaluated in parallel with a run, and the results of the monitoring so far.
  struct Watch {
    Watch(const Model& running, const Model& whole, const std::vector<EffectUse>& uses, const formats::Scene& scene);
    Evaluation now;      ///< evaluation of the running model
    StateTransfer lift;  ///< transfer from the running model to the whole one
    CarriedInertia inertia;
    Demand demand;
    double force = 0.0;    ///< largest force so far
    double next = 0.0;     ///< time of the next sample
    bool blind = false;    ///< whether the carried inertia was unknown in a window
    bool doubted = false;  ///< whether a warning was given
  };

  void stand_beside(Run& whole);
  void turn_on(std::vector<bool> more);
  void sample(const Run& run);
  double largest_force(const Run& run) const;
  void doubt(const std::vector<bool>& missed, Run& run);
  void report_stressed(RunReport& report) const;
  void report_start_forces(const Run& run, RunReport& report) const;

  const formats::Scene& scene_;
  std::vector<Use> uses_;
  const Run* whole_ = nullptr;
  std::optional<State> whole_state_, begin_;
  std::optional<Evaluation> whole_now_;
  std::optional<Watch> watch_;  ///< monitoring of the present run; absent: no effect is off
  double interval_ = 0.0;       ///< interval between samples [time]
  double straightened_ = 0.0;   ///< initial bending of bodies that are off, relative to the size of the scene
  bool goes_on_ = false;        ///< whether the run continues from a file
  bool begins_again_ = false;
  int begins_ = 0;     ///< number of times that the run began again
  long repeated_ = 0;  ///< number of steps of the discarded runs
};

}  // namespace tisserand::mechanism
