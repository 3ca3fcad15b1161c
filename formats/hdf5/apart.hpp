// The process that reads a file with HDF5 and may only compute: no paths, no network, no programs. HDF5 can crash, loop
// or be led astray by a damaged or crafted file; here it harms nothing.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "formats/hdf5/entry.hpp"

namespace tisserand::formats::hdf5 {

/// What one request may take; no seconds: in proportion to the size of the file.
struct ReadingLimits {
  double processor_seconds = 0.0;
  double wall_seconds = 0.0;
};

/// A child process that has some files open and answers requests until this ends. Where the kernel lacks seccomp, or
/// another program forbids it, a note says so once, and the child is a child all the same.
class Apart {
 public:
  explicit Apart(const std::vector<std::string>& paths, const ReadingLimits& limits = {});
  ~Apart();
  Apart(const Apart&) = delete;
  Apart& operator=(const Apart&) = delete;

  /// The number of a file among the paths; nothing if it is not there.
  std::optional<std::size_t> number_of(const std::string& path) const;
  /// Whether the child died or was ended: it answers nothing more.
  bool is_gone() const;

  /// opening_of() a file. Throws Error as ask().
  std::string open(std::size_t file, Completeness completeness);
  /// Puts the answer to a request of entry.hpp about an open file where `place` says. Throws Error: what the child
  /// threw; it died, or needed more than the limits.
  void ask(std::size_t file, const std::string& request, const Place& place);
  /// The same, of at most 256 MiB.
  std::string ask(std::size_t file, const std::string& request);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// While it lives, InputFile reads these files in one child, which costs less than one for each: for files of which
/// each can spoil the result of all.
class Together {
 public:
  explicit Together(const std::vector<std::string>& paths);
  ~Together();
  Together(const Together&) = delete;
  Together& operator=(const Together&) = delete;

  /// Whether the child died, be it by the file that was read last or by one before. Read each alone to find out.
  bool failed() const { return apart_->is_gone(); }
  /// The child that has this file; null: there is none.
  static std::shared_ptr<Apart> child_of(const std::string& path);

 private:
  std::shared_ptr<Apart> apart_;
};

}  // namespace tisserand::formats::hdf5
