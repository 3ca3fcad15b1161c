// SPDX-License-Identifier: GPL-3.0-or-later
// What the targets of binary files share: bytes -> a mutated copy of a sound file -> a reader.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "formats/hdf5/apart.hpp"
#include "formats/hdf5/container.hpp"
#include "tests/formats/hdf5/mutated_container.hpp"
#include "text_file.hpp"

namespace tisserand::formats::hdf5 {

/// In place of formats/hdf5/apart.cpp, whose child would hide a crash behind an Error and cost a fork: the containers
/// are sound, so nothing may crash here.
struct Apart::Impl {
  explicit Impl(const std::string& name) : path(name), file(name) {}
  std::string path;
  OpenFile file;
  std::optional<Container> container;
};

Apart::Apart(const std::vector<std::string>& paths, const ReadingLimits&)
    : impl_(std::make_unique<Impl>(paths.front())) {}
Apart::~Apart() = default;
std::optional<std::size_t> Apart::number_of(const std::string& path) const {
  return path == impl_->path ? std::optional<std::size_t>(0) : std::nullopt;
}
std::string Apart::open(std::size_t, Completeness completeness) {
  return opening_of(impl_->container.emplace(impl_->file, completeness));
}
void Apart::ask(std::size_t, const std::string& request, const Place& place) {
  answer(*impl_->container, request, place);
}
std::string Apart::ask(std::size_t file, const std::string& request) {
  std::string text;
  ask(file, request, [&text](std::uint64_t bytes) {
    text.resize(bytes);
    return text.data();
  });
  return text;
}
std::shared_ptr<Apart> Together::child_of(const std::string&) { return nullptr; }

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
