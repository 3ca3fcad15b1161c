// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of a study: each is a child process. Its errors are measured and recorded before the next begins.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mechanism/histories/series.hpp"
#include "mechanism/study/cells.hpp"
#include "mechanism/study/journal.hpp"

namespace tisserand::mechanism {

/// Callbacks between a study and its caller.
struct StudyControl {
  /// Returns whether the user has interrupted; called ten times a second and between runs.
  std::function<bool()> interrupted;
  std::function<double()> clock;  ///< returns seconds of wall clock time
};

/// Data that all runs of a campaign share.
struct Campaign {
  const formats::Study& study;
  const std::string& folder;
  Journal& journal;
  const StudyControl& control;
};

/// Histories of the quantities in the reference of a study, with which the errors of runs are measured.
struct ReferenceHistories {
  std::vector<Series> histories;  ///< reference history of each quantity
  std::vector<double> agreement;  ///< error of the second reference run against the first; empty: there is none
};

/// Runs the references of a study, or reads its reference file. Throws Error if a run fails, if two references disagree
/// (with both values), or if a quantity is not stored.
ReferenceHistories make_reference(Campaign& campaign, const std::vector<Cell>& references);

/// Median of the times of a cell [s] and its confidence interval from `least` to `greatest`, by order statistics. From
/// 3 runs on the confidence is at least 3/4. For 3 to 5 runs the interval goes from the least time to the greatest one.
/// For more runs it goes from the second least to the second greatest one, and so on.
struct MedianTime {
  double median = 0.0, least = 0.0, greatest = 0.0;
};
/// Median and confidence interval of the times `seconds`.
MedianTime median_of(std::vector<double> seconds);

/// Whether a cell needs no further run: it failed, or its times are known as the study demands. That needs at least
/// three runs with the interval of the median within ± `within`, or `repeats` runs.
bool is_known(const formats::Study& study, const std::vector<RunRecord>& runs);

/// Makes the superelement files that the cells need, each once. Throws Error.
void make_all_parts(const Campaign& campaign, const std::vector<Cell>& cells);

/// Histories of the quantities in a cell. Runs the cell once more to get them. Throws Error.
std::vector<Series> histories_of(const Campaign& campaign, const Cell& cell);

/// Runs the cells that the journal lacks. It runs one at a time if times count, else several in parallel on the cores.
/// Ends early when interrupted. Throws Error if a superelement file cannot be made.
void run_cells(Campaign& campaign, const std::vector<Cell>& cells, const ReferenceHistories& reference);

}  // namespace tisserand::mechanism
