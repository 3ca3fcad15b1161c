// SPDX-License-Identifier: GPL-3.0-or-later
// Loops over a range in consecutive shares, one share per thread.
#pragma once

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

namespace tisserand {

/// Number of cores of this machine, at most 16: more do not speed up loops limited by memory.
inline int core_count() { return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 16); }

/// Share of a thread: the consecutive items from `first` to `end` − 1. share_of() divides `count` items into `shares`
/// shares of nearly equal size and returns number `share`.
struct Share {
  int first = 0;
  int end = 0;
};
inline Share share_of(int count, int share, int shares) {
  const auto at = [&](int k) { return static_cast<int>(static_cast<long>(count) * k / shares); };
  return {at(share), at(share + 1)};
}

/// Runs work(k) for k = 0 ... threads − 1, each on its own thread, and waits for all. If several throw, the exception
/// of the lowest k is rethrown.
template <class Work>
void on_threads(int threads, const Work& work) {
  std::vector<std::exception_ptr> failure(static_cast<std::size_t>(threads));
  const auto guarded = [&](int k) {
    try {
      work(k);
    } catch (...) {
      failure[k] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < threads; ++k) others.emplace_back(guarded, k);
    guarded(0);
  }
  for (const std::exception_ptr& f : failure)
    if (f) std::rethrow_exception(f);
}

/// Runs work(t, k) for all k from 0 to `count` − 1, where each thread t processes one share of them.
template <class Work>
void share_out(int count, int threads, const Work& work) {
  on_threads(threads, [&](int t) {
    const Share share = share_of(count, t, threads);
    for (int k = share.first; k < share.end; ++k) work(t, k);
  });
}

}  // namespace tisserand
