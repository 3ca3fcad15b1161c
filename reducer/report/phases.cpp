// SPDX-License-Identifier: GPL-3.0-or-later
// Time and memory per phase, and the thread that reports long phases.
#include "reducer/report/phases.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "common/clock.hpp"

namespace tisserand::reducer {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Peak memory of this process (Linux counts in 1024 bytes).
double peak_bytes() {
  rusage usage{};
  return getrusage(RUSAGE_SELF, &usage) == 0 ? 1024.0 * static_cast<double>(usage.ru_maxrss) : 0.0;
}

/// Phases by name in the order of their beginnings. Times of equal names are added and the latest peak counts, because
/// a phase may continue after another.
template <class Phase>
std::vector<Phase> merged(const std::vector<Phase>& phases) {
  std::vector<Phase> list;
  for (const Phase& phase : phases) {
    const auto same = std::ranges::find(list, phase.name, &Phase::name);
    if (same == list.end()) {
      list.push_back(phase);
      continue;
    }
    same->seconds += phase.seconds;
    same->processor_seconds += phase.processor_seconds;
    same->peak_bytes = phase.peak_bytes;
  }
  return list;
}

/// Times as text: "mesh 0.010 s, ..., total 0.310 s".
template <class Phase>
std::string listed_times(const std::vector<Phase>& phases, double Phase::*seconds) {
  std::string text;
  double total = 0.0;
  for (const Phase& phase : merged(phases)) {
    text += fmt::format("{} {:.3f} s, ", phase.name, phase.*seconds);
    total += phase.*seconds;
  }
  return text + fmt::format("total {:.3f} s", total);
}

/// Text ", 40 %, about 12 s to go"; empty if too little is done for an estimate.
std::string rest_text(double share, double gone) {
  constexpr double known = 0.03;
  if (!(share > known && share < 1.0)) return "";
  return fmt::format(", {:.0f} %, about {:.0f} s to go", 100.0 * share, gone * (1.0 - share) / share);
}

}  // namespace

Phases::Phases() : watcher_([this] { watch(); }) {}

Phases::~Phases() {
  {
    const std::lock_guard lock(mutex_);
    finished_ = true;
  }
  changed_.notify_all();
  watcher_.join();
}

void Phases::begin(const std::string& name) {
  end();
  const std::lock_guard lock(mutex_);
  phases_.push_back({name, Clock::now(), 0.0, 0.0, processor_clock(), 0.0});
  running_ = true;
  changed_.notify_all();
}

void Phases::share(double done) {
  const std::lock_guard lock(mutex_);
  if (running_) phases_.back().share = done;
}

void Phases::solve(int columns) {
  const std::lock_guard lock(mutex_);
  columns_ += columns;
  if (columns > 0)
    solving_since_ = processor_clock();
  else
    solving_seconds_ += processor_clock() - solving_since_;
}

void Phases::end() {
  const std::lock_guard lock(mutex_);
  if (running_) {
    phases_.back().seconds = seconds_since(phases_.back().start);
    phases_.back().processor_seconds = processor_clock() - phases_.back().processor_start;
    phases_.back().peak_bytes = peak_bytes();
  }
  running_ = false;
  changed_.notify_all();
}

std::string Phases::text() const {
  const std::lock_guard lock(mutex_);
  return listed_times(phases_, &Phase::seconds);
}

std::string Phases::processor_text() const {
  const std::lock_guard lock(mutex_);
  return listed_times(phases_, &Phase::processor_seconds);
}

std::string Phases::memory_text() const {
  const std::lock_guard lock(mutex_);
  std::string text;
  for (const Phase& phase : merged(phases_))
    text += fmt::format("{}{} {:.0f} MB", text.empty() ? "" : ", ", phase.name, 1e-6 * phase.peak_bytes);
  return text;
}

int Phases::columns() const {
  const std::lock_guard lock(mutex_);
  return columns_;
}

std::string Phases::solutions_text() const {
  const std::lock_guard lock(mutex_);
  return fmt::format("{} columns {:.3f} s", columns_, solving_seconds_);
}

void Phases::watch() {
  std::unique_lock lock(mutex_);
  while (!finished_) {
    if (!running_) {
      changed_.wait(lock);
      continue;
    }
    const std::size_t phase = phases_.size();
    const Clock::time_point start = phases_.back().start;
    const auto is_over = [&] { return finished_ || !running_ || phases_.size() != phase; };
    for (int wait_ms = 1000; !changed_.wait_until(lock, start + std::chrono::milliseconds(wait_ms), is_over);
         wait_ms *= 2)
      fmt::print(stderr, "{} ... {} s{}\n", phases_.back().name, wait_ms / 1000,
                 rest_text(phases_.back().share, seconds_since(start)));
  }
}

}  // namespace tisserand::reducer
