// Tables for people: the channels of a results file, its export as CSV, and runs measured against a reference.
#pragma once

#include <string>
#include <vector>

#include "mechanism/histories/difference.hpp"

namespace tisserand::mechanism {

/// One line per channel, "name  [unit]", with the number of instants and, of an interrupted run, the reason above.
/// `patterns` choose as in formats::select_channels(); none: all.
std::string channels_table(const std::string& file, const std::vector<std::string>& patterns);

/// Writes the chosen channels (none chosen: all) as CSV with the header "time [s],name [unit],...".
void export_table(const std::string& file, const std::vector<std::string>& patterns, const std::string& output);

/// The difference of every series of a request from its only reference. Throws Error unless there is exactly one.
std::vector<Series> compare(const SeriesRequest& request, const TimeWindow& window);

/// The table as text, one line per difference.
std::string deviations_table(const std::vector<Series>& differences);

}  // namespace tisserand::mechanism
