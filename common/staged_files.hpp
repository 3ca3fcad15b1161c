// Files of one result that belong together: all are written and closed under temporary names, then take their own.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tisserand {

/// A failure before publish() leaves the files of before; files take their names in the order in which they were added,
/// so the one that names the others comes last.
class StagedFiles {
 public:
  StagedFiles() = default;
  /// Removes what was not published.
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Writes beside `path` until the data have reached the disk. Throws Error (no permission, disk full).
  void add(const std::string& path, const std::string& contents);
  /// Takes over a complete, closed file beside `path`.
  void adopt(const std::string& temporary, const std::string& path);
  /// Renames all. Throws Error.
  void publish();

 private:
  std::vector<std::pair<std::string, std::string>> files_;  ///< temporary and final name
};

}  // namespace tisserand
