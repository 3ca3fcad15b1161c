// SPDX-License-Identifier: GPL-3.0-or-later
// Ends of steps and instants of rows: the grid of steps, breakpoints of loads, halving after a failure. bdf_run.cpp
// schedules the rows of method: bdf.
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

/// Schedule of the steps and rows of a run. Fixed steps end at start + k·step, at breakpoints of loads and at the end.
/// After a failure the step is divided by 2, 4, ... until the next point of this grid. Steps with error control end at
/// breakpoints, at the end and, unless the method interpolates, at instants of output.
class Schedule {
 public:
  Schedule(const formats::Scene& scene, const std::vector<double>& breakpoints);

  bool output_at_start() const;
  bool finished(double time) const;
  /// Limits the next step to `step` (error control only). The step after it is chosen as if this one had not been cut.
  void bound(double step) { bound_ = step; }
  double proposal() const { return proposal_; }
  /// End of the step that starts at `time`.
  StepEnd next(double time) const;
  /// Shortens the step from `time` after a failure, without error control to half. Returns false if no shorter step is
  /// allowed: after max_halvings, or below the smallest step.
  bool retry(double time, const StepReport& report);
  /// Text of the limit at which retry() returns false: "after 10 halvings of the step".
  std::string limit(const Units& units) const;
  /// Chooses the next step from the error of the accepted step of the size `size` (error control only).
  void adapt(const StepReport& report, double size);

  /// Next instant of output before `time`, to be interpolated within the step that ends at `time`. The instant then
  /// counts as stored. Absent if there is none, or if rows are not interpolated.
  std::optional<double> pass_instant(double time);

  /// Actions that are due at the end of a step: output of a row, restart at a breakpoint.
  struct Event {
    bool output = false;
    bool breakpoint = false;
  };
  /// Registers the end of an accepted step at `time`. Returns what is due there.
  Event accept(double time);

  /// Counters of the schedule, for a checkpoint. restore() sets them.
  std::vector<double> memory() const;
  void restore(const std::vector<double>& memory);
  /// Sets the counters as if the steps until `time` had been taken.
  void skip_to(double time);

 private:
  bool reached(double time, double target) const;
  /// Instant of the next row if the scene gives the interval of rows.
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
  bool interpolates_ = false;   ///< whether rows lie between the ends of steps
  long grid_ = 1;               ///< number of the next point of the grid
  std::size_t breakpoint_ = 0;  ///< index of the next breakpoint
  int halvings_ = 0;
  double fraction_ = 0.0;  ///< size of the step after halving; 0: it ends at the next point of the grid
  long rows_ = 1;          ///< number of output instants passed, for output at an interval
  double proposal_ = 0.0;  ///< next step (error control)
  double bound_ = std::numeric_limits<double>::infinity();  ///< limit of the next step (error control)
  bool retried_ = false;  ///< whether the present step was shortened, so that the next one must not be longer
};

/// Least number of rows that the scene stores from `time` on. Steps with error control count with their largest size.
double rows_to_come(const formats::Scene& scene, double time);

/// Whether rows_to_come() is exact. It is not exact if the run chooses its steps and stores each of them.
bool knows_rows(const formats::Scene& scene);

/// Message if `rows` rows of `bytes` bytes each exceed 1 GB: "the results will take about 2.9 GB: .."; else empty. It
/// names settings of the scene that reduce the size.
std::string large_output(const formats::Scene& scene, double rows, std::size_t bytes);

}  // namespace tisserand::mechanism
