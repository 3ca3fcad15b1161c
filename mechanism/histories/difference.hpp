// SPDX-License-Identifier: GPL-3.0-or-later
// Comparison of a history with another one over time.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {

struct TimeWindow {
  std::optional<double> from;
  std::optional<double> to;
};

/// Value of a series at `x`, inside its range: Lagrange's cubic through the four nearest instants. Needs increasing
/// abscissae; repeated instants (at a switch) count once.
double value_at(const Series& series, double x);

/// Series minus reference, as a curve with its norms, at the reference's instants in the window. An instant between two
/// of the series uses value_at() (exact if they coincide). Throws Error if fewer than two are common.
Series difference_at_reference(const Series& series, const Series& reference, const TimeWindow& window);
/// Norms of difference_at_reference().
Deviation deviation(const Series& series, const Series& reference, const TimeWindow& window);

/// Series minus reference at their common instants. If the instants differ, those of the coarser one between the first
/// and the last common time are used, and the denser one is interpolated. Instants without a number are omitted; the
/// reference is converted to the units of the series. Throws Error also for units of other quantities.
Series difference(const Series& series, const Series& reference, const TimeWindow& window);

/// Reference with the channel's name, or the only reference if none has it. Throws Error if there is none, or more than
/// one.
const Series& reference_of(const Series& run, const std::vector<Series>& all);

/// Appends the differences of the runs from their references. Throws Error also if there is no run.
void append_differences(std::vector<Series>& series);

}  // namespace tisserand::mechanism
