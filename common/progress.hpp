// SPDX-License-Identifier: GPL-3.0-or-later
// A progress line on standard error for work that takes longer than a second.
#pragma once

#include <cstdio>
#include <functional>
#include <string>

namespace tisserand {

/// Output of progress lines: the stream, and the clock that times them [s].
struct ProgressOutput {
  std::FILE* stream;
  bool terminal;  ///< true: one line, redrawn ten times a second; false: a new line every ten seconds
  std::function<double()> clock;
};

/// Progress output to standard error, timed by the steady clock.
ProgressOutput standard_progress();

/// Progress display, silent in the first second. update() reads the clock: call it at most once every few microseconds.
///   running: 42 %, t = 1.2 s, 3 s gone, 4 s to go
class Progress {
 public:
  /// `total`: value of `done` at the end of the work; <= 0: unknown, no percentage is shown.
  Progress(std::string name, double total);
  Progress(std::string name, double total, ProgressOutput output);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(double done, const std::string& text);
  /// Ends the display of work that is done. Removes the line from a terminal. In other streams, prints the elapsed time
  /// if a line was printed before. Without this call the work does not count as done.
  void finish();

 private:
  std::string line(double done, const std::string& text, double elapsed) const;

  std::string name_;
  double total_;
  ProgressOutput output_;
  double start_;
  double next_;
  bool shown_ = false;
  bool finished_ = false;
};

}  // namespace tisserand
