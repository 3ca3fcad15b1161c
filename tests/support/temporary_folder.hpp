// SPDX-License-Identifier: GPL-3.0-or-later
// A folder of its own for a test that writes files, removed with all it holds; the text of a file.
#pragma once

#include <filesystem>
#include <string>

namespace tisserand::test_support {

class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// All bytes of a file; none if it cannot be read.
std::string text_of(const std::string& path);

}  // namespace tisserand::test_support
