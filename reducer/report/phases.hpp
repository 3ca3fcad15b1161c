// SPDX-License-Identifier: GPL-3.0-or-later
// Time and memory per phase of a reduction, and progress on stderr if one takes longer than a second.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace tisserand::reducer {

/// Clock of the phases of a reduction: time and memory of each phase. A phase ends when the next one begins. It
/// continues when a phase of its name begins again. A thread reports a phase on stderr after its first second, then
/// less and less often.
class Phases {
 public:
  Phases();
  ~Phases();
  Phases(const Phases&) = delete;
  Phases& operator=(const Phases&) = delete;

  void begin(const std::string& name);
  /// Sets the completed share of the phase, 0 to 1. The progress line estimates the remaining time from it.
  void share(double done);
  /// Receives begin and end of a solution with the factor of the interior. `columns`: number of right-hand sides at
  /// its begin, 0 at its end.
  void solve(int columns);
  void end();
  /// Wall-clock time of each phase as text: "mesh 0.010 s, assembly 0.021 s, ..., total 0.310 s".
  std::string text() const;
  /// Processor time of each phase, summed over all threads, in the format of text().
  std::string processor_text() const;
  /// Peak memory of the process up to the end of each phase, as text: "mesh 61 MB, assembly 102 MB, ...".
  std::string memory_text() const;
  /// Total number of right-hand sides that solve() has received.
  int columns() const;
  /// Number of right-hand sides and processor time of their solutions in all phases, as text: "126 columns 0.512 s".
  std::string solutions_text() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Phase {
    std::string name;
    Clock::time_point start;
    double seconds = 0.0;
    double share = 0.0;
    double processor_start = 0.0;
    double processor_seconds = 0.0;
    double peak_bytes = 0.0;
  };
  void watch();

  std::vector<Phase> phases_;
  int columns_ = 0;
  double solving_since_ = 0.0;
  double solving_seconds_ = 0.0;
  bool running_ = false;   ///< the last phase has not ended
  bool finished_ = false;  ///< the watching thread must end
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::thread watcher_;
};

}  // namespace tisserand::reducer
