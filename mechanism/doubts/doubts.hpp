// What a run doubts of its own results: measured quantities beyond limits that have a source, one line each.
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

  /// After a step from `before` to `end`.
  void after_step(const State& before, const Instant& end);
  /// Observes a state that is not the end of a step of generalised alpha, as in statics and in rows of bdf.
  void at_state(const Instant& at);
  void at_row(const Instant& at, const formats::ResultsRow& row);
  double energy_moved() const { return energy_.moved(); }

  /// Costs nothing while there is nothing to tell; eigenvalues of bodies that spin.
  std::vector<std::string> tell(const Model& model, const StressedBodies& stressed) const;

  /// The first one; empty: nothing.
  std::string explanation(Puzzle puzzle, const Model& model) const;

 private:
  EnergyBalance energy_;
  std::vector<std::unique_ptr<Doubt>> all_;  ///< in the order in which they are told
};

}  // namespace tisserand::mechanism
