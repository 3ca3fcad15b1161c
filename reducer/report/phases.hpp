// Time and memory per phase of a reduction, and a sign of life on stderr when one takes longer than a second.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace tisserand::reducer {

/// A phase ends when the next begins, and goes on when one of its name begins. A watching thread reports a phase after
/// its first second, then ever more rarely.
class Phases {
 public:
  Phases();
  ~Phases();
  Phases(const Phases&) = delete;
  Phases& operator=(const Phases&) = delete;

  void begin(const std::string& name);
  /// How much of the phase is done, 0 to 1: the line then says how long it will still take.
  void share(double done);
  /// `columns` > 0: so many are solved from now on with the factor of the inside; 0: until now.
  void solve(int columns);
  void end();
  /// "mesh 0.010 s, assembly 0.021 s, ..., total 0.310 s" by the clock.
  std::string text() const;
  /// The same of the processor, all threads together.
  std::string processor_text() const;
  /// "mesh 61 MB, assembly 102 MB, ...": the most that the process has held until the end of each phase.
  std::string memory_text() const;
  /// How many columns were solved in all.
  int columns() const;
  /// "126 columns 0.512 s" by the processor, all phases together.
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
  bool finished_ = false;  ///< the watching thread shall end
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::thread watcher_;
};

}  // namespace tisserand::reducer
