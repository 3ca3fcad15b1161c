// What the targets of binary files share: bytes -> a mutated copy of a sound file -> a reader.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "formats/hdf5/file.hpp"
#include "tests/formats/hdf5/mutated_container.hpp"
#include "text_file.hpp"

namespace tisserand::formats::hdf5 {

/// In place of the child processes of formats/hdf5/rehearsal.cpp, which would hide a crash behind an Error and cost a
/// fork: the containers are sound, so nothing may crash here.
void rehearse(const std::string&, const std::function<void()>&) {}
void rehearse(const std::string&, const std::function<void()>&, const ReadingLimits&) {}
std::string read_apart(const std::string&, const std::function<std::string()>& read) { return read(); }
bool survives(const std::vector<std::string>&, const std::function<void(const std::string&)>&) { return true; }

}  // namespace tisserand::formats::hdf5

namespace tisserand {

/// Path of a sound file of this process, written once by `write`.
inline std::string sound_file(const std::string& kind, const std::function<void(const std::string&)>& write) {
  const std::string path = Scratch::file(kind + ".h5");
  write(path);
  return path;
}

/// One run: `read` gets the path of the mutated copy. It may throw Error, nothing else; the copy that no bytes change
/// must be read, unless the file needs its content_id.
inline void run_container(const std::string& sound, const std::uint8_t* data, std::size_t size, bool needs_content_id,
                          const std::function<void(const std::string&)>& read) {
  const std::string image = test_support::mutated_container(sound, data, size);
  const std::string path = text_file(reinterpret_cast<const std::uint8_t*>(image.data()), image.size());
  try {
    read(path);
  } catch (const Error& error) {
    if (size > 0 || needs_content_id) return;
    std::fprintf(stderr, "the sound file is refused: %s\n", error.what());
    std::abort();
  }
}

}  // namespace tisserand
