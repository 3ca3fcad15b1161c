// SPDX-License-Identifier: GPL-3.0-or-later
// Temporary files that are renamed together.
#include "common/staged_files.hpp"

#include <unistd.h>

#include "common/temporaries.hpp"
#include "common/text.hpp"

namespace tisserand {

StagedFiles::~StagedFiles() {
  for (const auto& [temporary, path] : files_) ::unlink(temporary.c_str());
}

void StagedFiles::add(const std::string& path, const std::string& contents) {
  TextFile file(path);
  file.write(contents);
  if (const std::string temporary = file.stage(); !temporary.empty()) adopt(temporary, path);
}

void StagedFiles::adopt(const std::string& temporary, const std::string& path) { files_.emplace_back(temporary, path); }

void StagedFiles::publish() {
  const auto lock = publishing();
  while (!files_.empty()) {
    publish_file(files_.front().first, files_.front().second);
    files_.erase(files_.begin());
  }
}

}  // namespace tisserand
