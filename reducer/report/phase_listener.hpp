// SPDX-License-Identifier: GPL-3.0-or-later
// Progress reports of a reduction.
#pragma once

#include <functional>
#include <string>
#include <utility>

namespace tisserand::reducer {

/// Functions that receive the progress of a reduction. They receive the name of a phase when it begins, the completed
/// share, begin and end of solutions with the factor of the interior, and lines for immediate output. The caller
/// measures time and shows progress.
struct PhaseListener {
  template <class Begin>
  PhaseListener(Begin heard) : begin(std::move(heard)) {}
  void operator()(const std::string& phase) const { begin(phase); }

  std::function<void(const std::string& phase)> begin;
  /// Receives the approximate completed share of the phase, 0 to 1.
  std::function<void(double)> share = [](double /*done*/) {};
  /// Receives the number of columns, see Factor::report_solutions(); may be empty.
  std::function<void(int)> solve;
  std::function<void(const std::string&)> tell = [](const std::string& /*line*/) {};
};

}  // namespace tisserand::reducer
