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

/// Limits of the time of one request to the reading process [s]. If `wall_seconds` is 0, both limits are replaced by
/// limits that grow with the size of the files.
struct ReadingLimits {
  double processor_seconds = 0.0;
  double wall_seconds = 0.0;
};

/// Child process that has some files open and answers requests until this object is destroyed. If the kernel lacks or
/// forbids the sandbox (seccomp), a note says so once, and the child runs without it.
class Apart {
 public:
  explicit Apart(const std::vector<std::string>& paths, const ReadingLimits& limits = {});
  ~Apart();
  Apart(const Apart&) = delete;
  Apart& operator=(const Apart&) = delete;

  /// Index of the file among the paths of the constructor; nothing if it is not there.
  std::optional<std::size_t> number_of(const std::string& path) const;
  /// Whether the child died or was ended. It then answers no more requests.
  bool is_gone() const;

  /// Opens a file in the child and returns the answer of opening_of(). `file`: index of the file. Throws Error as ask()
  /// does.
  std::string open(std::size_t file, Completeness completeness);
  /// Sends a request of entry.hpp about open file `file` and stores the answer at `place`. Throws the child's Error, or
  /// Error if the child died or exceeded the limits.
  void ask(std::size_t file, const std::string& request, const Place& place);
  /// Sends a request of entry.hpp about open file `file` and returns the answer, of at most 256 MiB. Throws Error as
  /// the other ask() does.
  std::string ask(std::size_t file, const std::string& request);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Makes InputFile read the given files in one shared child while this object exists, which costs less than one child
/// per file. A bad file can spoil the results of all files.
class Together {
 public:
  explicit Together(const std::vector<std::string>& paths);
  ~Together();
  Together(const Together&) = delete;
  Together& operator=(const Together&) = delete;

  /// Whether the shared child died, because of any of the files. Read each file alone to find out which.
  bool failed() const { return apart_->is_gone(); }
  /// Child that serves this file, or null.
  static std::shared_ptr<Apart> child_of(const std::string& path);

 private:
  std::shared_ptr<Apart> apart_;
};

}  // namespace tisserand::formats::hdf5
