// SPDX-License-Identifier: GPL-3.0-or-later
// Journal of a study on the disk: a line per run, so that none is repeated after an interruption.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tisserand::mechanism {

enum class CellOutcome { completed, failed, over_budget };

/// Record of one finished run.
struct RunRecord {
  CellOutcome outcome = CellOutcome::completed;
  std::string message;       ///< why it did not complete
  double cpu_seconds = 0.0;  ///< time of the process, with reading, building and writing
  double limit = 0.0;        ///< over_budget: limit of wall clock time [s]
  int coordinates = 0;
  long steps = 0, iterations = 0;
  std::vector<double> errors;  ///< one per quantity; empty if it did not complete
};

/// Records of runs by the key of their cell.
class Journal {
 public:
  /// Reads <folder>/journal*.jsonl and appends to <folder>/journal<suffix>.jsonl. `measure`: key of the meaning of
  /// errors. An incomplete last line is dropped. Throws Error: damaged, or of another version or measure.
  Journal(const std::string& folder, const std::string& suffix, const std::string& measure);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::vector<RunRecord>& runs(const std::string& key) const;
  /// Adds a record, which is on the disk on return.
  void add(const std::string& key, const RunRecord& record);
  /// Keys with records.
  std::vector<std::string> keys() const;

 private:
  void read(const std::string& path, const std::string& measure);
  std::string path_;
  int file_ = -1;
  std::map<std::string, std::vector<RunRecord>> runs_;
};

}  // namespace tisserand::mechanism
