// What a study has run, on the disk: a line per run, so that none is repeated after an interruption.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace tisserand::mechanism {

enum class CellOutcome { completed, failed, over_budget };

/// One run that has ended.
struct RunRecord {
  CellOutcome outcome = CellOutcome::completed;
  std::string message;       ///< of one that did not complete
  double cpu_seconds = 0.0;  ///< of the process: reading, building and writing included
  double limit = 0.0;        ///< over_budget: seconds by the clock that it was given
  int coordinates = 0;
  long steps = 0, iterations = 0;
  std::vector<double> errors;  ///< of the quantities; empty of one that did not complete
};

/// Runs by the key of their cell.
class Journal {
 public:
  /// Reads <folder>/journal*.jsonl and appends to <folder>/journal<suffix>.jsonl. `measure` says what errors mean. A
  /// last line that was cut off is dropped. Throws Error: damaged, or of another version or measure.
  Journal(const std::string& folder, const std::string& suffix, const std::string& measure);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::vector<RunRecord>& runs(const std::string& key) const;
  /// On the disk when this returns.
  void add(const std::string& key, const RunRecord& record);
  /// Keys that are recorded.
  std::vector<std::string> keys() const;

 private:
  void read(const std::string& path, const std::string& measure);
  std::string path_;
  int file_ = -1;
  std::map<std::string, std::vector<RunRecord>> runs_;
};

}  // namespace tisserand::mechanism
