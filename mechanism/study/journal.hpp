// SPDX-License-Identifier: GPL-3.0-or-later
// Journal of a study on the disk: a line per run, so that none is repeated after an interruption.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tisserand::mechanism {

/// Outcome of a run of a study. `over_budget`: it was ended at its limit of time.
enum class CellOutcome { completed, failed, over_budget };

/// Record of one finished run of a study.
struct RunRecord {
  CellOutcome outcome = CellOutcome::completed;
  std::string message;       ///< reason why the run did not complete
  double cpu_seconds = 0.0;  ///< processor time of the process, including reading, building and writing
  double limit = 0.0;        ///< for over_budget: limit of wall clock time [s]
  int coordinates = 0;
  long steps = 0, iterations = 0;
  std::vector<double> errors;  ///< error of each quantity; empty if the run did not complete
};

/// Journal of a study on the disk: the records of its runs by the key of their cell, one line per run.
class Journal {
 public:
  /// Reads <folder>/journal*.jsonl, and opens <folder>/journal<suffix>.jsonl to append records. `measure`: key of how
  /// errors are measured (measure_key()). An incomplete last line is dropped. Throws Error for a damaged file, and for
  /// one of another version or measure.
  Journal(const std::string& folder, const std::string& suffix, const std::string& measure);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Records of the cell with this key; empty if there are none.
  const std::vector<RunRecord>& runs(const std::string& key) const;
  /// Adds a record. On return it is on the disk.
  void add(const std::string& key, const RunRecord& record);
  /// Keys of all cells with records.
  std::vector<std::string> keys() const;

 private:
  void read(const std::string& path, const std::string& measure);
  std::string path_;
  int file_ = -1;
  std::map<std::string, std::vector<RunRecord>> runs_;
};

}  // namespace tisserand::mechanism
