// A history against another one, over time.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {

struct TimeWindow {
  std::optional<double> from;
  std::optional<double> to;
};

/// Value of a series at `x`, inside its range: Lagrange's cubic through the four nearest instants. Increasing
/// abscissae; repeated instants (after a switch) count once.
double value_at(const Series& series, double x);

/// Series minus reference, as a curve with its norms, at the reference's instants in the window. Where one falls
/// between two of the series, value_at() is taken (exact where they coincide). Throws Error if fewer than two are
/// common.
Series difference_at_reference(const Series& series, const Series& reference, const TimeWindow& window);
/// Its norms.
Deviation deviation(const Series& series, const Series& reference, const TimeWindow& window);

/// The same at the instants that both have in common or, where they differ, at those of the one that has fewer of them
/// between the first and the last common time: there it has values, and the other one, which is denser, is
/// interpolated. Instants without a number are left out; the reference is converted to the units of the series. Throws
/// Error also for units of other quantities.
Series difference(const Series& series, const Series& reference, const TimeWindow& window);

/// The reference of the channel's name; where none has it the only one. Throws Error if there is none, or more than
/// one.
const Series& reference_of(const Series& run, const std::vector<Series>& all);

/// The differences of the runs from their references behind the series. Throws Error also if there is no run.
void append_differences(std::vector<Series>& series);

}  // namespace tisserand::mechanism
