// Effects that a run switches by itself (`auto`): which are awake, and the models with and without them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/results/results.hpp"
#include "mechanism/build/build_model.hpp"
#include "mechanism/build/effects.hpp"
#include "mechanism/equations/mobility.hpp"
#include "mechanism/switching/demand.hpp"
#include "mechanism/switching/switch_model.hpp"
#include "mechanism/switching/transfer.hpp"

namespace tisserand::mechanism {

struct Run;
struct RunReport;

/// The model of the run is that of the effects that are awake. Beside it stands the whole model, with all effects on:
/// its layout is that of the results, and in its coordinates is told what a sleeping effect would do (demand.hpp). An
/// effect that matters wakes at the beginning of the window in which that was seen; one that has taken less than a
/// quarter of what is allowed for ten windows sleeps, if the energy that this costs is allowed too. Effects of bodies
/// that loops of joints can stress stay on.
class AutomaticEffects {
 public:
  /// `uses`: automatic_effects() of the scene. Throws Error for a method that cannot be switched.
  AutomaticEffects(const formats::Scene& scene, const BodyFiles& files, std::vector<EffectUse> uses);

  /// Takes the whole model from the run, which has started with it, and gives it one of those effects that matter at
  /// the start; a run that does not begin with the poses of the scene has all but the flexibility of undeformed bodies.
  void begin(Run& run);
  /// Takes the whole model from the run, and gives it that of a checkpoint, whose state is for the caller to set.
  void restore(Run& run, const std::vector<double>& memory);
  /// Which effects, by which tolerance and window.
  std::string rule() const;
  /// Marks and notes what stays on, at the state of the run, whose model is the whole one: bodies that loops of joints
  /// can stress (constraint_stress.hpp). Also of a check.
  void hold_stressed(Run& run);
  /// For checkpoints at the ends of windows.
  std::vector<double> memory() const;
  std::size_t memory_size(const Model& whole) const;

  bool has_begun() const { return demand_.has_value(); }
  BuiltModel& whole() { return whole_; }
  /// The state of the run in coordinates of the whole model.
  const State& whole_state(const Run& run);
  /// Of the whole model there, as a run from the poses of the scene tells it.
  Mobility mobility(const Run& run);
  void fill_row(Run& run, formats::ResultsRow& row);
  /// That switches have added so far.
  double switched_energy() const { return switched_; }

  double window() const { return window_; }
  /// At an instant that was sampled last, or with a new model.
  void begin_window(const Run& run);
  /// What the state of the run says of effects that sleep: none matters, one does (the window must be repeated), or one
  /// would if forces stayed as they are (the window must go on until they do).
  enum class Verdict { sleeps_well, matters, may_matter };
  Verdict sample(const Run& run);
  void extend_window() { demand_->extend_window(); }
  /// Where the window began: what matters wakes. What fell asleep there did so in vain, and that is undone. Returns
  /// whether it could.
  bool wake(Run& run);
  /// What has been quiet for some windows sleeps. Returns whether the model is another one.
  bool end_window(Run& run);

  /// One line per effect; which forces do not keep the tolerance.
  void tell(Run& run) const;

 private:
  struct Use {
    EffectUse effect;
    int flexibility = -1;  ///< of stiffening: the use of its body that it needs; -1: none is automatic
    bool held = false;     ///< it stays on
    bool awake = true;
    bool was_awake = true;        ///< at the start
    double start_force = 0.0;     ///< largest elastic force where the run starts, if it sleeps there
    int quiet = 0;                ///< windows in which it has taken little
    std::vector<double> changes;  ///< when it woke or fell asleep
  };
  using Awake = std::vector<bool>;
  /// Largest change of a force of a joint at a switch.
  struct Jump {
    double force = 0.0, time = 0.0;
    std::vector<std::string> bodies;  ///< that switched there
  };

  /// What the run was before something fell asleep.
  struct Undo {
    BuiltModel built;
    Awake awake;
    double switched = 0.0;
    Jump jump;
  };

  Awake awake() const;
  Awake held() const;
  formats::Scene scene_with(const Awake& awake) const;
  void sample_here(const Run& run);
  double largest_force(const Run& run) const;
  /// From the poses of the scene, as if it had no other effects.
  void start_with(const Awake& awake, Run& run);
  bool switch_to(const Awake& next, const Deformations& deformations, bool at_any_cost, Run& run);
  /// Bodies that fell asleep at times, of those welded to others that deform.
  std::vector<std::string> slept_in_a_weld() const;
  static void doubt_undeformed(const Deformations& bent, double time, Run& run);
  bool undo_sleep(const Awake& next, Run& run);
  void note_start_forces();
  void tell_forces(Run& run) const;
  void doubt_sleep(const Awake& next, Run& run);
  void take_over(BuiltModel built, const Awake& awake, const formats::Scene& scene, Run& run);
  Awake all_but_undeformed();
  void give_whole(Run& run);

  formats::Scene scene_;  ///< with its switches
  const BodyFiles& files_;
  std::vector<Use> uses_;
  double window_ = 0.0;
  BuiltModel whole_;
  State whole_state_;
  std::optional<Evaluation> whole_now_, now_;  ///< of the whole model, and of that of the run
  std::optional<StateTransfer> lift_;          ///< from the model of the run to the whole one
  std::optional<Demand> demand_;
  std::optional<CarriedInertia> inertia_;
  bool blind_ = false;         ///< there was a window without carried inertia
  bool doubted_ = false;       ///< that something could not wake was told
  bool inertia_set_ = false;   ///< in this window
  bool sampled_ = false;       ///< where the run stands, with its present model
  bool blocked_ = false;       ///< what matters could not be woken in this window
  bool resumes_ = false;       ///< from a checkpoint that was sampled where it stands
  std::vector<double> rates_;  ///< of the checkpoint, until the first window begins
  bool fresh_ = false;         ///< the run stands at the poses of the scene
  double energy_reference_ = 0.0;
  double force_reference_ = 0.0;
  double switched_ = 0.0;
  Jump jump_;
  std::optional<Undo> undo_;  ///< until the end of the window at whose beginning something fell asleep
};

}  // namespace tisserand::mechanism
