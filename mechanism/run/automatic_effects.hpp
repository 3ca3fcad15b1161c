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

/// Choice of automatic effects. It is constant from beginning to end of a run: model, rows and checkpoints are those of
/// the scene with these effects `on` and the others `off`. The whole model, with all effects on, is evaluated in
/// parallel. Its coordinates express what an effect that is off would do (demand.hpp).
class AutomaticEffects {
 public:
  /// `uses`: automatic_effects() of the scene, all on.
  AutomaticEffects(const formats::Scene& scene, std::vector<EffectUse> uses);

  /// Chooses the effects of a run that begins like the started run `whole` (from its state `begin` or from the poses),
  /// which must outlive this object. On are effects of bodies that loops of joints can stress (constraint_stress.hpp),
  /// or that are deformed at the start, from rest by more than the tolerance.
  void begin(Run& whole, const std::optional<State>& begin);
  /// Takes the choice of a run that continues from a file; `whole` has not started. Such a run cannot begin again, so
  /// an effect that matters causes a warning.
  void go_on(Run& whole, const std::vector<std::string>& off);

  /// List of the automatic effects, with the choice in `on`.
  std::vector<EffectUse> effects() const;
  bool any_off() const;
  /// Length of a window of ten samples [time].
  double window() const { return 2.0 * Demand::window_samples * interval_; }
  /// Scene with this choice and no automatic effects.
  formats::Scene scene() const;
  /// State from which a model with this choice begins; absent: the poses of the scene.
  std::optional<State> begin_of(const Model& chosen) const;
  /// Names of the effects that are off: "flexibility of 'rod'".
  std::vector<std::string> off() const;

  /// Starts the monitoring of a run at its start, with this choice. Returns the same as missed().
  bool watch(Run& run);
  /// Takes a sample after an accepted step (`ends`: the last one). Returns whether the run must begin again because an
  /// effect that is off matters. This effect is on from now.
  bool missed(Run& run, bool ends);
  /// Whether watch() or missed() has demanded a new beginning since the last watch().
  bool begins_again() const { return begins_again_; }

  /// State of the run in coordinates of the whole model.
  const State& whole_state(const Run& run);
  /// Adds the choice, and what it omits that may matter, to the report.
  void tell(Run& run) const;
  /// Adds for `check` the tolerance and the effects that are always on to the report.
  void tell_begin(RunReport& report) const;

 private:
  struct Use {
    EffectUse effect;
    int flexibility = -1;              ///< stiffening: index of the flexibility of its body; -1: none is automatic
    bool stressed = false;             ///< loops of joints can stress the body
    double demand = 0.0, time = 0.0;   ///< D and its time in the run that began again with it (demand.hpp)
    double start_force = 0.0;          ///< largest elastic force at the start of the run, if it is off
  };
  /// The whole model, evaluated in parallel with a run, and its results so far.
  struct Watch {
    Watch(const Model& running, const Model& whole, const std::vector<EffectUse>& uses, const formats::Scene& scene);
    Evaluation now;      ///< evaluation of the running model
    StateTransfer lift;  ///< transfer from the running model to the whole one
    CarriedInertia inertia;
    Demand demand;
    double force = 0.0;  ///< largest so far
    double next = 0.0;   ///< time of the next sample
    bool blind = false;  ///< there was a window without carried inertia
    bool doubted = false;
  };

  void stand_beside(Run& whole);
  void turn_on(std::vector<bool> more);
  void sample(const Run& run);
  double largest_force(const Run& run) const;
  void doubt(const std::vector<bool>& missed, Run& run);
  void tell_stressed(RunReport& report) const;
  void tell_start_forces(const Run& run, RunReport& report) const;

  const formats::Scene& scene_;
  std::vector<Use> uses_;
  const Run* whole_ = nullptr;
  std::optional<State> whole_state_, begin_;
  std::optional<Evaluation> whole_now_;
  std::optional<Watch> watch_;  ///< absent: no effect is off
  double interval_ = 0.0;       ///< interval between samples [time]
  double straightened_ = 0.0;   ///< initial bending of bodies that are off, relative to the size of the scene
  bool goes_on_ = false;        ///< the run continues from a file
  bool begins_again_ = false;
  int begins_ = 0;              ///< number of new beginnings
  long repeated_ = 0;           ///< steps of the discarded runs
};

}  // namespace tisserand::mechanism
