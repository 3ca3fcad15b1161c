// The bytes of one fuzzing run as a file that the readers can open.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <string>

namespace tisserand {

/// Path of a file with these bytes, the same one in every run of this process.
inline std::string text_file(const std::uint8_t* data, std::size_t size) {
  static const std::string path = "/dev/shm/tisserand-fuzz-" + std::to_string(::getpid()) + ".yaml";
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return path;
  if (size > 0) std::fwrite(data, 1, size, file);
  std::fclose(file);
  return path;
}

}  // namespace tisserand
