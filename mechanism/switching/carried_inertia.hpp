// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia that the joints of a deforming body carry along, which its own frequencies do not contain.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/iteration_matrix.hpp"

namespace tisserand::mechanism {

/// Inertia that the joints of a deforming body carry along. A body that deforms at the rate ẏ without rigid motion
/// moves the markers of its joints by B ẏ. The rigid motion v of all bodies compensates this with the least kinetic
/// energy: B v = −B ẏ. It has the energy T = ½ vᵀM v = ½ μᵀB ẏ with the multipliers μ, which adds to the energy of ẏ
/// itself. So a cantilever vibrates more slowly than a free beam, and still more slowly with a mass at its tip.
class CarriedInertia {
 public:
  /// Prepares the calculation for two models of one scene. `running`: model that runs, in which the bodies are rigid.
  /// `whole`: model in which the bodies deform. Requires that both models outlive this object.
  CarriedInertia(const Model& running, const Model& whole);

  /// Takes the state of the run and factors the matrix for the following calls of energies(). `step`: size of the step
  /// [time].
  void set(const State& running, double step);
  /// Whether energies() is valid: both models have the same number of constraints and the factorisation succeeded, or
  /// the running model has no constraints.
  bool knows() const { return usable_ || running_.sizes.constraints == 0; }
  /// Carried energy T of each deforming body (deformation.hpp) of the whole model. `rates`: ẏ of each body; empty: it
  /// does not deform. `whole`: evaluation of the whole model at the state of set(). All are zero if the models have
  /// different constraints or the factorisation failed.
  std::vector<double> energies(const std::vector<Eigen::VectorXd>& rates, const Evaluation& whole);

 private:
  /// Adds to `v` the velocities of the nodes of body `index` that deforms at the rate `rate`.
  void add_velocity(std::size_t index, const Eigen::VectorXd& rate, const Evaluation& now, Eigen::VectorXd& v) const;

  const Model& running_;
  const Model& whole_;
  Evaluation now_;
  IterationMatrix matrix_;
  bool usable_ = false;
};

}  // namespace tisserand::mechanism
