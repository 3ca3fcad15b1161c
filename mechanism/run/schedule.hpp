// When steps end and when rows are written: the grid of steps, breakpoints of loads, halving after a failure. Rows of
// method: bdf are in bdf_run.cpp.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/step/step.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Fixed steps end at start + k·step, at breakpoints and at the end; after a failure the step is divided by 2, 4, ...
/// until the next point of the grid. Steps with error control end at breakpoints, at the end and, unless the method
/// interpolates, at instants of output.
class Schedule {
 public:
  Schedule(const formats::Scene& scene, const std::vector<double>& breakpoints);

  bool output_at_start() const;
  bool finished(double time) const;
  /// With error control: the next step is no longer than this, and the one after it as if it had not been cut.
  void bound(double step) { bound_ = step; }
  double proposal() const { return proposal_; }
  /// End of the step that starts at `time`.
  StepEnd next(double time) const;
  /// The step from `time` failed: a shorter one is next (without error control half of it); false if there is none:
  /// after max_halvings, or below the smallest step.
  bool retry(double time, const StepReport& report);
  /// What stands in the way of a shorter step: "after 10 halvings of the step".
  std::string limit() const;
  /// With error control: the step of the given size was accepted; its error gives the next one.
  void adapt(const StepReport& report, double size);

  /// The next instant of output that a step to `time` passes without ending there, which then counts as stored. Only
  /// where rows between steps are interpolated.
  std::optional<double> pass_instant(double time);

  struct Event {
    bool output = false;
    bool breakpoint = false;
  };
  /// A step has ended at `time`.
  Event accept(double time);

  /// All that accept() and halve() have counted, and back: for checkpoints.
  std::vector<double> memory() const;
  void restore(const std::vector<double>& memory);
  /// As if the steps until `time` had been taken.
  void skip_to(double time);

 private:
  bool reached(double time, double target) const;
  /// The next row of `interval`.
  double due() const { return integrator_.start + static_cast<double>(rows_) * *output_.interval; }
  bool controlled() const { return integrator_.error_control.active; }
  double target() const;
  double controlled_end(double time) const;
  bool halve(double time);
  bool output_due(double time, bool on_grid);

  formats::IntegratorSpec integrator_;
  formats::OutputSpec output_;
  std::vector<double> breakpoints_;
  double round_off_ = 0.0;
  bool interpolates_ = false;   ///< rows between the ends of steps
  long grid_ = 1;               ///< the next point of the grid
  std::size_t breakpoint_ = 0;  ///< the next breakpoint
  int halvings_ = 0;
  double fraction_ = 0.0;  ///< step after halving, 0: to the target
  long rows_ = 1;          ///< output instants passed (interval)
  double proposal_ = 0.0;  ///< next step (error control)
  double bound_ = std::numeric_limits<double>::infinity();  ///< of the next step (error control)
  bool retried_ = false;   ///< the present step was shortened: the next one is no longer
};

/// How many rows of results the scene asks for from `time` on, at least: steps with error control are taken to be as long
/// as they may.
double rows_to_come(const formats::Scene& scene, double time);

/// Whether rows_to_come() is the number itself: it is not where the run chooses its steps and stores each of them.
bool knows_rows(const formats::Scene& scene);

/// "about 2.9 GB of results .. : thin them with ..", of rows of `bytes`; empty below 1 GB.
std::string large_output(const formats::Scene& scene, double rows, std::size_t bytes);

}  // namespace tisserand::mechanism
