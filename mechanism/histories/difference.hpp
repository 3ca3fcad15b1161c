// A history against another one, over time.
#pragma once

#include <vector>

#include "mechanism/histories/tables.hpp"

namespace tisserand::mechanism {

/// Series minus reference, as a curve of its own, and its norms.
struct Difference {
  Series curve;
  Deviation norms;
};

/// At the instants that both have in common or, where they differ, at those of the one that has fewer of them between
/// the first and the last common time: there it has values, and the other one, which is denser, is interpolated by the
/// cubic through its four nearest instants (value_at()). Instants without a number are left out. Throws Error if fewer
/// than two instants are left.
Difference difference(const Series& series, const Series& reference, const TimeWindow& window);

/// The differences of the runs from their references behind the series. The reference of a channel is the one of its
/// name; of one that has none of its name the only one. Throws Error if there is none, or more than one.
void append_differences(std::vector<Series>& series);

}  // namespace tisserand::mechanism
