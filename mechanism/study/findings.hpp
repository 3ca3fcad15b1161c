// SPDX-License-Identifier: GPL-3.0-or-later
// Findings of a study: the cheapest settings for an error, and the decrease of errors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/study/campaign.hpp"

namespace tisserand::mechanism {

/// One setting of a study with all its data.
struct StudyRow {
  const Cell* cell = nullptr;
  CellOutcome outcome = CellOutcome::failed;
  bool has_run = false;
  bool is_reference = false;  ///< it is the reference and has no error
  std::string message;
  MedianTime time;
  int repeats = 0;
  int coordinates = 0;
  long steps = 0, iterations = 0;
  std::vector<double> errors;  ///< one per quantity; empty unless completed
  std::vector<std::optional<double>> orders;  ///< one per quantity: observed_orders() along its line

  /// Largest error of these quantities.
  double worst_error(const std::vector<int>& quantities) const;

  bool is_measured() const { return has_run && !is_reference && outcome == CellOutcome::completed; }
};

/// Settings of one series that differ along one axis alone, from coarse to fine, as indices of rows.
struct StudyLine {
  int series = 0;
  int axis = 0;       ///< axis of the series; -1: the series has no axes
  std::string label;  ///< common settings of the line: "beam: modes = 4"
  std::vector<int> rows;
};

std::vector<StudyRow> rows_of(const formats::Study& study, const StudyCells& plan, const Journal& journal);

/// All lines of each series along one axis: `along`, or the last one.
std::vector<StudyLine> lines_of(const formats::Study& study, const std::vector<StudyRow>& rows);
/// All lines of a series along one of its axes.
std::vector<StudyLine> lines_along(const formats::Study& study, const std::vector<StudyRow>& rows, int series,
                                   int axis);

/// Observed orders log(e_coarse/e_fine) / log(h_coarse/h_fine) between neighbours of a line with positive numbers h on
/// its axis. The first row and rows without a number have none. Orders are positive where errors fall, for an axis of
/// steps (falling) or counts (rising: per doubling of the count).
std::vector<std::optional<double>> observed_orders(const std::vector<StudyRow>& rows, const StudyLine& line,
                                                   int quantity);

/// Index in a line from which an error stays within 5 % of its value at the end: further values of the axis change
/// nothing. Absent: the last value still changes it, or some of its settings were not measured.
std::optional<std::size_t> plateau(const std::vector<StudyRow>& rows, const StudyLine& line, int quantity);

/// Number in a value of an axis, if it is one.
std::optional<double> number_of(const std::string& value);

/// Rows that no other beats in both time and error, in ascending order of time.
std::vector<int> pareto_front(const std::vector<StudyRow>& rows, int quantity);

/// Index of the cheapest row whose errors (of these quantities) stay within the tolerance there and at all finer
/// settings of its line. A dip where errors cancel does not count. −1: none.
int cheapest(const std::vector<StudyRow>& rows, const std::vector<StudyLine>& lines, const std::vector<int>& quantities,
             double tolerance);

}  // namespace tisserand::mechanism
