// SPDX-License-Identifier: GPL-3.0-or-later
// Validity checks of a run: measured quantities beyond limits that have a source, one line each.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/doubts/balances.hpp"
#include "mechanism/doubts/doubt.hpp"

namespace tisserand::mechanism {

/// All validity checks of a run. Each compares a measured quantity with a limit that has a source.
class Doubts {
 public:
  /// Makes the checks that apply to the scene.
  Doubts(const formats::Scene& scene, const Model& model);

  /// Observes a step from the state `before` to `end`.
  void after_step(const State& before, const Instant& end);
  /// Observes a state that is not the end of a step of generalised alpha, as in statics and in rows of bdf.
  void at_state(const Instant& at);
  /// Observes a stored row and its state.
  void at_row(const Instant& at, const formats::ResultsRow& row);
  /// Largest energy that moved, EnergyBalance::moved().
  double energy_moved() const { return energy_.moved(); }

  /// All warnings of the checks. The call costs nothing without warnings, except eigenvalues of bodies that spin.
  std::vector<std::string> tell(const Model& model, const StressedBodies& stressed) const;

  /// First explanation that a check gives for the question; empty: none.
  std::string explanation(Puzzle puzzle, const Model& model) const;

 private:
  EnergyBalance energy_;
  std::vector<std::unique_ptr<Doubt>> all_;  ///< checks in the order of their messages
};

}  // namespace tisserand::mechanism
