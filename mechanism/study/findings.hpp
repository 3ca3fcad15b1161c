// What the runs of a study show: which settings are cheapest for an error, and how errors fall.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanism/study/campaign.hpp"

namespace tisserand::mechanism {

/// One setting of a study with all that is known of it.
struct StudyRow {
  const Cell* cell = nullptr;
  CellOutcome outcome = CellOutcome::failed;
  bool has_run = false;
  bool is_reference = false;  ///< errors are measured against it: none of its own
  std::string message;
  MedianTime time;
  int repeats = 0;
  int coordinates = 0;
  long steps = 0, iterations = 0;
  std::vector<double> errors;  ///< of the quantities; empty unless completed
  std::vector<std::optional<double>> orders;  ///< of the quantities: observed_orders() along its line

  /// Largest error of these quantities.
  double worst_error(const std::vector<int>& quantities) const;

  bool is_measured() const { return has_run && !is_reference && outcome == CellOutcome::completed; }
};

/// Settings of one series that differ along one axis alone, from coarse to fine; indices of rows.
struct StudyLine {
  int series = 0;
  int axis = 0;       ///< of the series; -1 of a series without axes
  std::string label;  ///< what the line has in common: "beam: modes = 4"
  std::vector<int> rows;
};

std::vector<StudyRow> rows_of(const formats::Study& study, const StudyCells& plan, const Journal& journal);

/// All lines along an axis of each series: `along`, or the last one.
std::vector<StudyLine> lines_of(const formats::Study& study, const std::vector<StudyRow>& rows);
/// All lines of a series along one of its axes.
std::vector<StudyLine> lines_along(const formats::Study& study, const std::vector<StudyRow>& rows, int series,
                                   int axis);

/// log(e_coarse/e_fine) / log(h_coarse/h_fine) between neighbours of a line with positive numbers h on its axis: the
/// first row and rows without a number have none. Positive where errors fall, whether the axis is a step (falling) or a
/// count (rising: then per doubling of the count).
std::vector<std::optional<double>> observed_orders(const std::vector<StudyRow>& rows, const StudyLine& line,
                                                   int quantity);

/// The place in a line behind which an error stays as it is, within 5 % of what it is at the end: further values of the
/// axis change nothing. Nothing: the last value still changes it, or some of its settings were not measured.
std::optional<std::size_t> plateau(const std::vector<StudyRow>& rows, const StudyLine& line, int quantity);

/// The number that a value of an axis is, if it is one.
std::optional<double> number_of(const std::string& value);

/// Rows that no other beats in both time and error, by rising time.
std::vector<int> pareto_front(const std::vector<StudyRow>& rows, int quantity);

/// The cheapest row whose errors (of the quantities asked for) stay within the tolerance, there and at all finer
/// settings of its line: a dip where errors cancel is luck. −1: none.
int cheapest(const std::vector<StudyRow>& rows, const std::vector<StudyLine>& lines, const std::vector<int>& quantities,
             double tolerance);

}  // namespace tisserand::mechanism
