// SPDX-License-Identifier: GPL-3.0-or-later
// Grid of steps and output instants.
#include "mechanism/run/schedule.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/error.hpp"
#include "mechanism/step/step_control.hpp"

namespace tisserand::mechanism {

Schedule::Schedule(const formats::Scene& scene, const std::vector<double>& breakpoints)
    : integrator_(scene.integrator), output_(scene.output), breakpoints_(breakpoints) {
  round_off_ = instant_tolerance(integrator_.step, std::max(std::abs(integrator_.start), std::abs(integrator_.end)));
  while (breakpoint_ < breakpoints_.size() && breakpoints_[breakpoint_] <= integrator_.start + round_off_)
    ++breakpoint_;
  proposal_ = std::min(integrator_.step, greatest_step(integrator_));
  interpolates_ =
      controlled() && integrator_.method == formats::Method::radau && scene.analysis == formats::AnalysisKind::dynamics;
}

bool Schedule::output_at_start() const { return integrator_.start >= output_.from - round_off_; }

bool Schedule::reached(double time, double target) const { return time >= target - round_off_; }

bool Schedule::finished(double time) const { return reached(time, integrator_.end); }

double Schedule::controlled_end(double time) const {
  double t = integrator_.end;
  if (output_.interval && !interpolates_) t = std::min(t, due());
  if (integrator_.end - t < round_off_) t = integrator_.end;
  if (breakpoint_ < breakpoints_.size()) t = std::min(t, breakpoints_[breakpoint_]);
  // The last two steps before an instant share the remaining time, so that none is tiny.
  const double left = t - time, size = std::min(proposal_, bound_);
  if (left <= size * (1.0 + 1e-9)) return t;
  return time + (left < 2.0 * size ? 0.5 * left : size);
}

double Schedule::target() const {
  double t = std::min(integrator_.start + static_cast<double>(grid_) * integrator_.step, integrator_.end);
  if (integrator_.end - t < round_off_) t = integrator_.end;
  if (breakpoint_ < breakpoints_.size() && breakpoints_[breakpoint_] < t - round_off_) t = breakpoints_[breakpoint_];
  return t;
}

StepEnd Schedule::next(double time) const {
  double t = controlled() ? controlled_end(time) : target();
  if (fraction_ > 0.0 && time + fraction_ < t - round_off_) t = time + fraction_;
  const bool at_breakpoint = breakpoint_ < breakpoints_.size() && reached(t, breakpoints_[breakpoint_]);
  return {t, at_breakpoint ? t - instant_tolerance(integrator_.step, t) : t};
}

bool Schedule::halve(double time) {
  if (halvings_ == integrator_.max_halvings) return false;
  fraction_ = 0.5 * (next(time).time - time);
  ++halvings_;
  return true;
}

bool Schedule::retry(double time, const StepReport& report) {
  if (!controlled()) return halve(time);
  const double size = next(time).time - time;
  proposal_ = report.proposed > 0.0
                  ? report.proposed
                  : shorter_step(size, report.outcome == StepOutcome::inaccurate ? report.error_ratio : 0.0);
  retried_ = true;
  return proposal_ >= least_step(integrator_);
}

std::string Schedule::limit(const Units& units) const {
  return controlled() ? fmt::format("a step below min_step, {:.3g}{}", least_step(integrator_), after_time(units))
                      : fmt::format("after {} halvings of the step", integrator_.max_halvings);
}

void Schedule::adapt(const StepReport& report, double size) {
  if (!controlled()) return;
  const double next = report.proposed > 0.0
                          ? std::clamp(report.proposed, least_step(integrator_), greatest_step(integrator_))
                          : next_step(integrator_, size, report.error_ratio);
  // A step cut by an instant does not argue against the longer proposal. But no step is more than twice the previous
  // one, whose errors the rebuilt acceleration would multiply.
  const bool cut = size < proposal_ * (1.0 - 1e-9);
  const double longer = cut && next >= size ? std::min(std::max(next, proposal_), 2.0 * size) : next;
  proposal_ = retried_ ? std::min(next, size) : longer;
  retried_ = false;
}

bool Schedule::output_due(double time, bool on_grid) {
  if (!output_.interval) {
    const bool is_due = (on_grid && grid_ % output_.every == 0) || finished(time);
    return is_due && time >= output_.from - round_off_;
  }
  const bool now = reached(time, due()) || finished(time);
  while (reached(time, due())) ++rows_;
  return now && time >= output_.from - round_off_;
}

std::optional<double> Schedule::pass_instant(double time) {
  if (!interpolates_ || !output_.interval) return std::nullopt;
  while (true) {
    const double next = due();
    if (next >= time - round_off_ || finished(next)) return std::nullopt;
    ++rows_;
    if (next >= output_.from - round_off_) return next;
  }
}

Schedule::Event Schedule::accept(double time) {
  Event event;
  if (breakpoint_ < breakpoints_.size() && reached(time, breakpoints_[breakpoint_])) {
    event.breakpoint = true;
    while (breakpoint_ < breakpoints_.size() && reached(time, breakpoints_[breakpoint_])) ++breakpoint_;
  }
  const double grid = integrator_.start + static_cast<double>(grid_) * integrator_.step;
  const bool on_grid = controlled() || reached(time, std::min(grid, integrator_.end));
  if (on_grid) {
    halvings_ = 0;
    fraction_ = 0.0;
  }
  event.output = output_due(time, on_grid);
  if (on_grid) ++grid_;
  return event;
}

std::vector<double> Schedule::memory() const {
  return {static_cast<double>(grid_),
          static_cast<double>(breakpoint_),
          static_cast<double>(halvings_),
          fraction_,
          static_cast<double>(rows_),
          proposal_,
          retried_ ? 1.0 : 0.0};
}

void Schedule::restore(const std::vector<double>& memory) {
  TISSERAND_ENSURE(memory.size() == 7, "{} numbers of a schedule", memory.size());
  grid_ = static_cast<long>(memory[0]);
  breakpoint_ = static_cast<std::size_t>(memory[1]);
  halvings_ = static_cast<int>(memory[2]);
  fraction_ = memory[3];
  rows_ = static_cast<long>(memory[4]);
  proposal_ = memory[5];
  retried_ = memory[6] != 0.0;
}

namespace {

bool has_fixed_steps(const formats::IntegratorSpec& integrator) {
  return !integrator.error_control.active && integrator.method != formats::Method::bdf;
}

}  // namespace

bool knows_rows(const formats::Scene& scene) {
  return has_fixed_steps(scene.integrator) || scene.output.interval.has_value();
}

double rows_to_come(const formats::Scene& scene, double time) {
  const formats::IntegratorSpec& integrator = scene.integrator;
  using enum formats::AnalysisKind;
  const bool moves = scene.analysis == dynamics || scene.analysis == kinematics || scene.analysis == inverse_dynamics;
  const double span = integrator.end - std::max(time, scene.output.from);
  if (!moves || !(span > 0.0)) return 1.0;
  const bool fixed = has_fixed_steps(integrator);
  const double step = (fixed ? integrator.step : greatest_step(integrator)) * scene.output.every;
  return 1.0 + std::floor(span / (scene.output.interval ? std::max(*scene.output.interval, fixed ? step : 0.0) : step));
}

std::string large_output(const formats::Scene& scene, double rows, std::size_t bytes) {
  const double size = rows * static_cast<double>(bytes);
  constexpr double gigabyte = 1e9;
  if (!(size > gigabyte)) return {};
  return fmt::format(
      "the results will take about {:.2g} GB: {:.3g} instants of {:.3g} kB; store fewer instants with `output: "
      "{{interval: {:.3g}}}`, or fewer channels with `output: {{channels: [nodes/position, energy]}}`",
      size / gigabyte, rows, 1e-3 * static_cast<double>(bytes),
      (scene.integrator.end - scene.integrator.start) / 2000.0);
}

void Schedule::skip_to(double time) {
  const auto passed = [&](double spacing) {
    return static_cast<long>(std::floor((time - integrator_.start + round_off_) / spacing)) + 1;
  };
  grid_ = passed(integrator_.step);
  if (output_.interval) rows_ = passed(*output_.interval);
  while (breakpoint_ < breakpoints_.size() && reached(time, breakpoints_[breakpoint_])) ++breakpoint_;
}

}  // namespace tisserand::mechanism
