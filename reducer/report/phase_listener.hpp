// What a reduction tells while it runs.
#pragma once

#include <functional>
#include <string>
#include <utility>

namespace tisserand::reducer {

/// Hears when a phase begins, by its name, how much of it is done, when substitutions with the factor of the inside
/// begin and end, and lines for the user at once: the caller measures time and shows progress.
struct PhaseListener {
  template <class Begin>
  PhaseListener(Begin heard) : begin(std::move(heard)) {}
  void operator()(const std::string& phase) const { begin(phase); }

  std::function<void(const std::string& phase)> begin;
  std::function<void(double)> share = [](double /*done*/) {};  ///< 0 to 1, about
  std::function<void(int)> solve;                              ///< Factor::tell_solutions
  std::function<void(const std::string&)> tell = [](const std::string& /*line*/) {};
};

}  // namespace tisserand::reducer
