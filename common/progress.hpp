// A line on standard error while something takes longer than a second.
#pragma once

#include <cstdio>
#include <functional>
#include <string>

namespace tisserand {

/// Where progress goes and by which clock [s].
struct ProgressOutput {
  std::FILE* stream;
  bool terminal;  ///< one line rewritten ten times a second; else a line of its own every ten seconds
  std::function<double()> clock;
};

/// Standard error and the steady clock.
ProgressOutput standard_progress();

/// Silent during the first second. update() costs one look at the clock; call it at most every few microseconds.
///   running: 42 %, t = 1.2 s, 3 s gone, 4 s to go
class Progress {
 public:
  /// `total` <= 0: unknown, no per cent.
  Progress(std::string name, double total);
  Progress(std::string name, double total, ProgressOutput output);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(double done, const std::string& text);
  /// Removes the line from a terminal; says the time it took elsewhere, if anything was said before. What ends without
  /// it is not done.
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
