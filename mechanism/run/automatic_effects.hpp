// Effects that a run chooses by itself (`auto`): it begins with as few as it can, watches what the others would do, and
// begins again with those that matter.
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

/// A run has one choice from its beginning to its end: its model, its rows and its checkpoints are those of the scene
/// with these effects `on` and the others `off`. Beside it stands the whole model, with all of them on, in whose
/// coordinates is told what an effect that is off would do (demand.hpp).
class AutomaticEffects {
 public:
  /// `uses`: automatic_effects() of the scene. All are on.
  AutomaticEffects(const formats::Scene& scene, std::vector<EffectUse> uses);

  /// The choice of a run that begins where that of the whole model does (`begin`: from that state of it, not from the
  /// poses), which has started and must stay where it is. Off are all but effects of bodies that loops of joints can
  /// stress (constraint_stress.hpp) and of bodies that deform there, from rest by more than the tolerance.
  void begin(Run& whole, const std::optional<State>& begin);
  /// The choice of a run that goes on from a file; `whole` has not started. Nothing can begin again then: what matters
  /// is doubted.
  void go_on(Run& whole, const std::vector<std::string>& off);

  /// With the choice in `on`.
  std::vector<EffectUse> effects() const;
  bool any_off() const;
  /// [time], of ten samples.
  double window() const { return 2.0 * Demand::window_samples * interval_; }
  /// With this choice, and nothing automatic.
  formats::Scene scene() const;
  /// Where a model with this choice begins; absent: at the poses of the scene.
  std::optional<State> begin_of(const Model& chosen) const;
  /// "flexibility of 'rod'": what is off.
  std::vector<std::string> off() const;

  /// The run stands at its start, with this choice. Returns as missed().
  bool watch(Run& run);
  /// After an accepted step, which may be the last. Returns whether the run must begin again: something that is off
  /// matters, and is on from now.
  bool missed(Run& run, bool ends);
  /// Whether one of these has said so since watch() was called.
  bool begins_again() const { return begins_again_; }

  /// The state of the run in coordinates of the whole model.
  const State& whole_state(const Run& run);
  /// The choice, and what it leaves out that may be felt, into the report.
  void tell(Run& run) const;
  /// The same of a check: the tolerance, and what is on throughout.
  void tell_begin(RunReport& report) const;

 private:
  struct Use {
    EffectUse effect;
    int flexibility = -1;              ///< of stiffening: the use of its body that it needs; -1: none is automatic
    bool stressed = false;             ///< by loops of joints
    double demand = 0.0, time = 0.0;   ///< of the run that began again with it: D and when (demand.hpp)
    double start_force = 0.0;          ///< largest elastic force where the run starts, if it is off
  };
  /// The second model that is evaluated beside a run, and what it has shown.
  struct Watch {
    Watch(const Model& running, const Model& whole, const std::vector<EffectUse>& uses, const formats::Scene& scene);
    Evaluation now;      ///< of the running model
    StateTransfer lift;  ///< from it to the whole one
    CarriedInertia inertia;
    Demand demand;
    double force = 0.0;  ///< largest so far
    double next = 0.0;   ///< sample
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
  std::optional<Watch> watch_;  ///< absent: nothing is off
  double interval_ = 0.0;       ///< between samples [time]
  double straightened_ = 0.0;   ///< what bodies that are off were bent where the run begins, over the size of the scene
  bool goes_on_ = false;        ///< from a file
  bool begins_again_ = false;
  int begins_ = 0;              ///< how often the run has begun again
  long repeated_ = 0;           ///< steps of runs before
};

}  // namespace tisserand::mechanism
