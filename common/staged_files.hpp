// SPDX-License-Identifier: GPL-3.0-or-later
// Publishes the files of one result together: all are written under temporary names, then renamed.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tisserand {

/// Group of files that are replaced together. If something fails before publish(), the old files stay. Files are
/// renamed in the order of addition, so add the file that refers to the others last.
class StagedFiles {
 public:
  StagedFiles() = default;
  /// Removes the files that were not published.
  ~StagedFiles();
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;

  /// Writes a temporary file in the folder of `path` and waits for the disk. Throws Error (no permission, disk full).
  void add(const std::string& path, const std::string& contents);
  /// Takes over a complete, closed temporary file in the folder of `path`.
  void adopt(const std::string& temporary, const std::string& path);
  /// Renames all temporary files to their final names. Throws Error.
  void publish();

 private:
  std::vector<std::pair<std::string, std::string>> files_;  ///< temporary and final name
};

}  // namespace tisserand
