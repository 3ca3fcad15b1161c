// SPDX-License-Identifier: GPL-3.0-or-later
// Validity checks of a run: measured quantities beyond limits that have a source, one line each.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mechanism/doubts/balances.hpp"
#include "mechanism/doubts/doubt.hpp"

namespace tisserand::mechanism {

class Doubts {
 public:
  Doubts(const formats::Scene& scene, const Model& model);

  /// Observes a step from `before` to `end`.
  void after_step(const State& before, const Instant& end);
  /// Observes a state that is not the end of a step of generalised alpha, as in statics and in rows of bdf.
  void at_state(const Instant& at);
  void at_row(const Instant& at, const formats::ResultsRow& row);
  double energy_moved() const { return energy_.moved(); }

  /// All warnings. Costs nothing without warnings, except eigenvalues of bodies that spin.
  std::vector<std::string> tell(const Model& model, const StressedBodies& stressed) const;

  /// The first explanation that a check gives; empty: none.
  std::string explanation(Puzzle puzzle, const Model& model) const;

 private:
  EnergyBalance energy_;
  std::vector<std::unique_ptr<Doubt>> all_;  ///< in the order of their messages
};

}  // namespace tisserand::mechanism
