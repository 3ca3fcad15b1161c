// SPDX-License-Identifier: GPL-3.0-or-later
// Progress reports of a reduction.
#pragma once

#include <functional>
#include <string>
#include <utility>

namespace tisserand::reducer {

/// Receives phases by name when they begin, the share that is done, begin and end of substitutions with the factor of
/// the inside, and lines for immediate output. The caller measures time and shows progress.
struct PhaseListener {
  template <class Begin>
  PhaseListener(Begin heard) : begin(std::move(heard)) {}
  void operator()(const std::string& phase) const { begin(phase); }

  std::function<void(const std::string& phase)> begin;
  std::function<void(double)> share = [](double /*done*/) {};  ///< approximately, 0 to 1
  std::function<void(int)> solve;                              ///< Factor::tell_solutions
  std::function<void(const std::string&)> tell = [](const std::string& /*line*/) {};
};

}  // namespace tisserand::reducer
