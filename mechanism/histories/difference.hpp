// SPDX-License-Identifier: GPL-3.0-or-later
// Comparison of a history with another one over time.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {

/// Interval of time in which histories are compared. An absent end is unlimited.
struct TimeWindow {
  std::optional<double> from;
  std::optional<double> to;
};

/// Value of a series at the abscissa `x`, by Lagrange's cubic through the four nearest instants. Requires that `x` is
/// inside the range of the series, and that the abscissae increase.
double value_at(const Series& series, double x);

/// Series minus reference, as a curve with its norms, at the instants of the reference in the window. Between two
/// instants of the series value_at() interpolates. Throws Error if fewer than two instants are common.
Series difference_at_reference(const Series& series, const Series& reference, const TimeWindow& window);
/// Norms of the curve of difference_at_reference().
Deviation deviation(const Series& series, const Series& reference, const TimeWindow& window);

/// Series minus reference at their common instants. If the instants differ, those of the coarser history between the
/// first and the last common time are used, and the denser one is interpolated. Instants without a number are omitted.
/// The reference is converted to the units of the series. Throws Error if fewer than two instants are common, and for
/// units of other quantities.
Series difference(const Series& series, const Series& reference, const TimeWindow& window);

/// Reference that belongs to `run`: the one with the same channel, or the only reference if none has this channel.
/// Throws Error if there is none or more than one. `all`: series that contain the references.
const Series& reference_of(const Series& run, const std::vector<Series>& all);

/// Appends to `series` the difference of each run from its reference. Throws Error if there is no run, or if a run has
/// not exactly one reference.
void append_differences(std::vector<Series>& series);

}  // namespace tisserand::mechanism
