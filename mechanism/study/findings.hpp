// SPDX-License-Identifier: GPL-3.0-or-later
// Findings of a study: the cheapest settings for an error, and the decrease of errors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/study/campaign.hpp"

namespace tisserand::mechanism {

/// Data of one setting of a study: its cell, outcome, times, counts and errors.
struct StudyRow {
  const Cell* cell = nullptr;
  CellOutcome outcome = CellOutcome::failed;
  bool has_run = false;
  bool is_reference = false;  ///< whether it is the reference, which has no error
  std::string message;        ///< reason why the run did not complete
  MedianTime time;
  int repeats = 0;
  int coordinates = 0;
  long steps = 0, iterations = 0;
  std::vector<double> errors;  ///< error of each quantity; empty unless the run completed
  /// Observed order of each quantity relative to the next coarser row of the line, by observed_orders().
  std::vector<std::optional<double>> orders;

  /// Largest error of the quantities with these indices.
  double worst_error(const std::vector<int>& quantities) const;

  /// Whether the row has errors.
  bool is_measured() const { return has_run && !is_reference && outcome == CellOutcome::completed; }
};

/// Rows of one series that differ along one axis alone, from coarse to fine, as indices of rows.
struct StudyLine {
  int series = 0;
  int axis = 0;       ///< index of the axis in the series; -1: the series has no axes
  std::string label;  ///< common settings of the line: "beam: modes = 4"
  std::vector<int> rows;
};

/// Rows of all cells of the study, with the data that the journal holds.
std::vector<StudyRow> rows_of(const formats::Study& study, const StudyCells& plan, const Journal& journal);

/// Lines of all series, each along one axis: the axis `along` of the study, or the last axis of the series.
std::vector<StudyLine> lines_of(const formats::Study& study, const std::vector<StudyRow>& rows);
/// All lines of one series along one of its axes.
std::vector<StudyLine> lines_along(const formats::Study& study, const std::vector<StudyRow>& rows, int series,
                                   int axis);

/// Observed orders log(e_coarse/e_fine) / |log(h_coarse/h_fine)| between neighbours of a line, one per row. e are
/// errors of the quantity, and h the positive numbers on the axis of the line. The first row and rows without a number
/// or an error have none. Orders are positive where errors fall, both for steps (falling numbers) and for counts
/// (rising numbers).
std::vector<std::optional<double>> observed_orders(const std::vector<StudyRow>& rows, const StudyLine& line,
                                                   int quantity);

/// Index in a line from which the error stays within 5 % of its value at the end, so that further values of the axis
/// change nothing. Absent if the last value still changes the error, or if some of these settings were not measured.
std::optional<std::size_t> plateau(const std::vector<StudyRow>& rows, const StudyLine& line, int quantity);

/// Number in the text of a value of an axis; absent if the text is not a number.
std::optional<double> number_of(const std::string& value);

/// Indices of the rows that no other row beats in both time and error, in ascending order of time.
std::vector<int> pareto_front(const std::vector<StudyRow>& rows, int quantity);

/// Index of the row with the least time whose errors are within the tolerance. The errors of all finer settings of its
/// line must be within the tolerance too, so that a dip where errors cancel does not count. `quantities`: indices of
/// the errors that count. −1: there is no such row.
int cheapest(const std::vector<StudyRow>& rows, const std::vector<StudyLine>& lines, const std::vector<int>& quantities,
             double tolerance);

}  // namespace tisserand::mechanism
