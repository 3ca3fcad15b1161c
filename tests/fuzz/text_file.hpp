// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes of one fuzzing run as a file that the readers can open.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>

namespace tisserand {

/// A folder for the files of this process, in that of temporary files; gone when it returns from main.
class Scratch {
 public:
  Scratch() { std::filesystem::create_directory(path_); }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  /// Path of a file in it.
  static std::string file(const std::string& name) {
    static const Scratch scratch;
    return scratch.path_ + "/" + name;
  }

 private:
  std::string path_ = std::filesystem::temp_directory_path() / ("tisserand-fuzz-" + std::to_string(::getpid()));
};

/// Path of a file with these bytes, the same one in every run of this process.
inline std::string text_file(const std::uint8_t* data, std::size_t size) {
  static const std::string path = Scratch::file("input.yaml");
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return path;
  if (size > 0) std::fwrite(data, 1, size, file);
  std::fclose(file);
  return path;
}

}  // namespace tisserand
