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

/// Schedule of steps and rows. Fixed steps end at start + k·step, at breakpoints and at the end. After a failure the
/// step is divided by 2, 4, ... until the next point of the grid. Steps with error control end at breakpoints, at the
/// end and, unless the method interpolates, at instants of output.
class Schedule {
 public:
  Schedule(const formats::Scene& scene, const std::vector<double>& breakpoints);

  bool output_at_start() const;
  bool finished(double time) const;
  /// Limits the next step (error control only). The step after it is chosen as if this one had not been cut.
  void bound(double step) { bound_ = step; }
  double proposal() const { return proposal_; }
  /// End of the step that starts at `time`.
  StepEnd next(double time) const;
  /// Shortens the step from `time` after a failure (without error control to half). False if there is no shorter one:
  /// after max_halvings, or below the smallest step.
  bool retry(double time, const StepReport& report);
  /// Limit that prevents a shorter step: "after 10 halvings of the step".
  std::string limit() const;
  /// Chooses the next step from the error of the accepted step of this size (error control only).
  void adapt(const StepReport& report, double size);

  /// Next instant of output that a step to `time` passes without ending there, which then counts as stored. Exists only
  /// if rows between steps are interpolated.
  std::optional<double> pass_instant(double time);

  struct Event {
    bool output = false;
    bool breakpoint = false;
  };
  /// Registers the end of a step at `time`. Returns what is due there.
  Event accept(double time);

  /// Counters of accept() and halve(), and back: for checkpoints.
  std::vector<double> memory() const;
  void restore(const std::vector<double>& memory);
  /// Sets the counters as if the steps until `time` had been taken.
  void skip_to(double time);

 private:
  bool reached(double time, double target) const;
  /// Instant of the next row of `interval`.
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
  bool interpolates_ = false;   ///< rows lie between the ends of steps
  long grid_ = 1;               ///< number of the next point of the grid
  std::size_t breakpoint_ = 0;  ///< index of the next breakpoint
  int halvings_ = 0;
  double fraction_ = 0.0;  ///< step after halving; 0: up to the target
  long rows_ = 1;          ///< output instants passed (interval)
  double proposal_ = 0.0;  ///< next step (error control)
  double bound_ = std::numeric_limits<double>::infinity();  ///< limit of the next step (error control)
  bool retried_ = false;   ///< the present step was shortened: the next one is no longer
};

/// Least number of rows that the scene stores from `time` on. Steps with error control count with their largest size.
double rows_to_come(const formats::Scene& scene, double time);

/// Whether rows_to_come() is exact. It is not if the run chooses its steps and stores each of them.
bool knows_rows(const formats::Scene& scene);

/// Message on large results of rows of `bytes`: "the results will take about 2.9 GB: .."; empty below 1 GB.
std::string large_output(const formats::Scene& scene, double rows, std::size_t bytes);

}  // namespace tisserand::mechanism
