// Windows of a run with automatic effects: rows and checkpoints wait for their ends, and what was missed is done again.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/run/checkpoint.hpp"
#include "mechanism/run/frame_angles.hpp"
#include "mechanism/run/run.hpp"
#include "mechanism/run/schedule.hpp"
#include "mechanism/run/stepper.hpp"

namespace tisserand::mechanism {

/// What the loop of steps remembers besides the run.
struct StepLoop {
  Schedule schedule;
  Checkpoints checkpoints;
  FrameAngles angles;
  StepReport last;  ///< of the last accepted step
  double last_size = 0.0;
  double tried_at, first_tried = 0.0;  ///< where the present step begins, and its size before it was shortened
};

class EffectWindows {
 public:
  /// Of a run that stands at its beginning, or where it goes on. Without automatic effects rows are written at once.
  EffectWindows(Run& run, StepLoop& loop, Stepper& stepper, RowWriter& out);

  /// The present state is to be stored.
  void store(const StepReport& step, double size);
  /// After an accepted step, stored if it was due. The run may have another model then. Returns whether it stands at
  /// the beginning of the window again.
  bool after_step();
  /// Writes what waits, where the run ends.
  void flush();

 private:
  struct Waiting {
    State state;
    StepReport step;
    double size = 0.0;
  };
  /// What a window goes back to.
  struct Beginning {
    State state;
    StepLoop loop;
    RunReport report;
    Doubts doubts;
    bool checkpoint_due = false;
  };
  void begin_window();
  void mark_beginning();
  void repeat();
  void end_window();
  template <class Switch>
  void tell_angles_if(Switch has_switched);

  Run& run_;
  StepLoop& loop_;
  Stepper& stepper_;
  RowWriter& out_;
  std::optional<Beginning> beginning_;
  std::vector<Waiting> waiting_;
  bool checkpoint_due_ = false;
  double next_sample_ = 0.0, end_ = 0.0;
};

}  // namespace tisserand::mechanism
