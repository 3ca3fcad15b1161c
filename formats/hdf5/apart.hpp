// SPDX-License-Identifier: GPL-3.0-or-later
// The sandboxed process that reads a file with HDF5 and may only compute: no paths, no network, no programs. A damaged
// or crafted file can make HDF5 crash, loop or run foreign code; here that harms nothing.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/hdf5/entry.hpp"

namespace tisserand::formats::hdf5 {

/// Limits of one request. Without seconds they are proportional to the size of the file.
struct ReadingLimits {
  double processor_seconds = 0.0;
  double wall_seconds = 0.0;
};

/// Child process that has some files open and answers requests until this is destroyed. If the kernel lacks seccomp or
/// forbids it, a note says so once, and the child runs without a sandbox.
class Apart {
 public:
  explicit Apart(const std::vector<std::string>& paths, const ReadingLimits& limits = {});
  ~Apart();
  Apart(const Apart&) = delete;
  Apart& operator=(const Apart&) = delete;

  /// Index of the file among the paths; empty if it is not there.
  std::optional<std::size_t> number_of(const std::string& path) const;
  /// Whether the child died or was ended. It then answers nothing more.
  bool is_gone() const;

  /// Answer of opening_of() for a file. Throws Error as ask().
  std::string open(std::size_t file, Completeness completeness);
  /// Stores the answer to a request of entry.hpp about an open file at `place`. Throws the child's Error, or
  /// Error if the child died or exceeded the limits.
  void ask(std::size_t file, const std::string& request, const Place& place);
  /// Returns the answer, of at most 256 MiB.
  std::string ask(std::size_t file, const std::string& request);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// While it exists, InputFile reads these files in one shared child, which costs less than one child per file. A bad
/// file can spoil the results of all.
class Together {
 public:
  explicit Together(const std::vector<std::string>& paths);
  ~Together();
  Together(const Together&) = delete;
  Together& operator=(const Together&) = delete;

  /// Whether the child died, by any of the files. Read each file alone to find out which.
  bool failed() const { return apart_->is_gone(); }
  /// Child that serves this file, or null.
  static std::shared_ptr<Apart> child_of(const std::string& path);

 private:
  std::shared_ptr<Apart> apart_;
};

}  // namespace tisserand::formats::hdf5
