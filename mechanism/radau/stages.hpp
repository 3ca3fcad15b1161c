// SPDX-License-Identifier: GPL-3.0-or-later
// The three stages of a step: displacements from its start, and their rates by collocation.
#pragma once

#include <Eigen/Core>

#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/radau/coefficients.hpp"
#include "mechanism/step/step.hpp"

namespace tisserand::mechanism::radau {

/// Stages of one step, one per column. `d` are displacements from the start of the step, in rotations the rotation
/// vectors θ, in the order of velocity coordinates. `v`, `a` and `lambda` are velocities, accelerations and
/// multipliers.
struct Stages {
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  explicit Stages(const Sizes& sizes);

  double step = 0.0;  ///< length h; 0: none yet
  StepEnd end;
  Columns d, v, a, lambda;
  Eigen::VectorXd v_begin, a_begin;  ///< v and v̇ at the start of the step
  Eigen::VectorXd displacement;      ///< buffer of interpolate()
  Eigen::Vector3d load_power = Eigen::Vector3d::Zero(), damping_power = Eigen::Vector3d::Zero();
};

/// Computes velocities and accelerations of the stages from the displacements, THEORY (74).
void update_rates(const Model& model, Stages& stages);

/// Predicts the stages of a step to `end`. Velocities and multipliers follow from the polynomials of the previous step
/// `last`, in the first step from v̇ and λ of the state. Then two sweeps of θ̇ = T⁻¹(θ) Ω give displacements from
/// velocities.
void predict(const Model& model, const State& state, const StepEnd& end, const Stages& last, Stages& stages);

/// Sets positions, velocities, accelerations and multipliers of `state` to the fraction `tau` of the step that began at
/// `begin`. Polynomials of order 4 pass through start and stages with the rates of the start. The polynomial of
/// multipliers passes through the stages alone. The result does not yet satisfy the constraints.
void interpolate(const Model& model, const State& begin, double tau, Stages& stages, State& state);

/// Integral of a power over the fraction `tau` of the step, by the polynomial through its values at the stages. The
/// order is 5 at `tau` = 1.
double integral(const Stages& stages, const Eigen::Vector3d& power, double tau);

}  // namespace tisserand::mechanism::radau
