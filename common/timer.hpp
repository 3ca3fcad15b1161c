// Seconds per phase of a run, for its report.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace tisserand {

struct Phase {
  std::string name;
  double seconds = 0.0;
};

/// One phase at a time: start() ends the one before; a phase started again adds up. Two looks at the clock per change.
class PhaseTimer {
 public:
  void start(std::string_view name) {
    stop();
    for (current_ = 0; current_ < phases_.size() && phases_[current_].name != name;) ++current_;
    if (current_ == phases_.size()) phases_.push_back({std::string(name), 0.0});
    running_ = true;
    begin_ = Clock::now();
  }

  void stop() {
    if (running_) phases_[current_].seconds += std::chrono::duration<double>(Clock::now() - begin_).count();
    running_ = false;
  }

  /// In the order of their first start; without the time of the phase that is still running.
  const std::vector<Phase>& phases() const { return phases_; }

  double total() const {
    double sum = 0.0;
    for (const Phase& phase : phases_) sum += phase.seconds;
    return sum;
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<Phase> phases_;
  std::size_t current_ = 0;
  bool running_ = false;
  Clock::time_point begin_;
};

}  // namespace tisserand
