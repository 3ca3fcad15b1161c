// SPDX-License-Identifier: GPL-3.0-or-later
// The three stages of a step: displacements from its start, and their rates by collocation.
#pragma once

#include <Eigen/Core>

#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/radau/coefficients.hpp"
#include "mechanism/step/step.hpp"

namespace tisserand::mechanism::radau {

/// Stages of one step, one per column. d: displacements and rotation vectors θ from its start, ordered as velocities.
struct Stages {
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  explicit Stages(const Sizes& sizes);

  double step = 0.0;  ///< h; 0: none yet
  StepEnd end;
  Columns d, v, a, lambda;
  Eigen::VectorXd v_begin, a_begin;  ///< v and v̇ at the start of the step
  Eigen::VectorXd displacement;      ///< buffer of interpolate()
  Eigen::Vector3d load_power = Eigen::Vector3d::Zero(), damping_power = Eigen::Vector3d::Zero();
};

/// Sets v and a from d by THEORY (74).
void update_rates(const Model& model, Stages& stages);

/// Predicts v and λ of a step to `end` from the polynomials of the previous step `last`; in the first step from v̇ and
/// λ of the state. Then two sweeps of θ̇ = T⁻¹(θ) Ω give d from v.
void predict(const Model& model, const State& state, const StepEnd& end, const Stages& last, Stages& stages);

/// Sets `state` to the fraction `tau` of the step that began at `begin`. Polynomials of order 4 pass through start and
/// stages with the rates of the start; for λ the polynomial passes through the stages alone. The result does not yet
/// satisfy the constraints.
void interpolate(const Model& model, const State& begin, double tau, Stages& stages, State& state);

/// Integral of a power over the fraction `tau` of the step, by its polynomial through the stages (order 5 at 1).
double integral(const Stages& stages, const Eigen::Vector3d& power, double tau);

}  // namespace tisserand::mechanism::radau
