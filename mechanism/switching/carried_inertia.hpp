// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia that the joints of a deforming body carry along, which its own frequencies do not contain.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/iteration_matrix.hpp"

namespace tisserand::mechanism {

/// A body that deforms by y without rigid motion moves markers of its joints by B ẏ. The rigid motion v of all bodies
/// that compensates this with the least kinetic energy, B v = −B ẏ, has T = ½ vᵀM v = ½ μᵀB ẏ. T is added to that of ẏ.
/// So a cantilever bends slower than a free beam, and still slower with a mass at its tip.
class CarriedInertia {
 public:
  /// `running`: the model that runs, in which the bodies are rigid. Both models must outlive this object.
  CarriedInertia(const Model& running, const Model& whole);

  /// Sets the state of the run and factors once for the following energies().
  void set(const State& running, double step);
  /// Whether energies() is valid: the models have the same constraints, or the running one has none.
  bool knows() const { return usable_ || running_.sizes.constraints == 0; }
  /// Energy T of each deforming body (deformation.hpp) of the whole model, at an evaluated state of it. `rates`: one
  /// per body; empty ones are at rest. Zero if the models have different constraints or the factorisation failed.
  std::vector<double> energies(const std::vector<Eigen::VectorXd>& rates, const Evaluation& whole);

 private:
  /// Adds the velocity of a body to `v`.
  void add_velocity(std::size_t index, const Eigen::VectorXd& rate, const Evaluation& now, Eigen::VectorXd& v) const;

  const Model& running_;
  const Model& whole_;
  Evaluation now_;
  IterationMatrix matrix_;
  bool usable_ = false;
};

}  // namespace tisserand::mechanism
