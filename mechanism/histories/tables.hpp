// SPDX-License-Identifier: GPL-3.0-or-later
// Printed tables: the channels of a results file, its export as CSV, and comparisons of runs with a reference.
#pragma once

#include <string>
#include <vector>

#include "mechanism/histories/difference.hpp"

namespace tisserand::mechanism {

/// Table of the channels of a results file, one line "name [unit]" each, with the number of instants. For an
/// interrupted run the reason stands above. `patterns`: selection as in formats::select_channels(); empty: all.
std::string channels_table(const std::string& file, const std::vector<std::string>& patterns);

/// Writes the selected channels of a results file as CSV with the header "time [s],name [unit],...". `patterns`:
/// selection as in formats::select_channels(); empty: all.
void export_table(const std::string& file, const std::vector<std::string>& patterns, const std::string& output);

/// Differences of every series of a request from its reference. Throws Error unless each has exactly one.
std::vector<Series> compare(const SeriesRequest& request, const TimeWindow& window);

/// Table of differences as text, one line each.
std::string deviations_table(const std::vector<Series>& differences);

}  // namespace tisserand::mechanism
