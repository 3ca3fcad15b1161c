// Tables for people: the channels of a results file, its export as CSV, and runs measured against a reference.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {

/// One line per channel, "name  [unit]", with the number of instants and, of an interrupted run, the reason above.
/// `patterns` choose as in formats::select_channels(); none: all.
std::string channels_table(const std::string& file, const std::vector<std::string>& patterns);

/// Writes the chosen channels (none chosen: all) as CSV with the header "time [s],name [unit],...".
void export_table(const std::string& file, const std::vector<std::string>& patterns, const std::string& output);

/// Value of a series at `x`, inside its range: Lagrange's cubic through the four nearest instants. Increasing abscissae;
/// repeated instants (after a switch) count once.
double value_at(const Series& series, double x);

/// Differences of one history from a reference, at the reference's instants from `from` to `to`.
struct Deviation {
  std::string label;
  std::string channel;
  std::string unit;
  double from = 0.0;  ///< first and last instant compared
  double to = 0.0;
  std::size_t instants = 0;
  double largest = 0.0;        ///< max |y - y_ref|
  double rms = 0.0;            ///< sqrt(∫(y - y_ref)² dt / ∫dt), trapezoid rule
  double reference_rms = 0.0;  ///< the same of y_ref alone
};

struct TimeWindow {
  std::optional<double> from;
  std::optional<double> to;
};

/// Measures `series` against `reference`. Where an instant of the reference falls between two of the series, a cubic
/// through the four nearest instants gives the value (exact where they coincide). Throws Error if fewer than two
/// instants are common.
Deviation deviation(const Series& series, const Series& reference, const TimeWindow& window);

/// Every series of a request against its only reference. Throws Error unless there is exactly one.
std::vector<Deviation> compare(const SeriesRequest& request, const TimeWindow& window);

/// The table as text, one line per deviation.
std::string deviations_table(const std::vector<Deviation>& deviations);

}  // namespace tisserand::mechanism
