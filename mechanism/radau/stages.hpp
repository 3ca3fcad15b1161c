// The three stages of a step: displacements from its start, and their rates by collocation.
#pragma once

#include <Eigen/Core>

#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/radau/coefficients.hpp"
#include "mechanism/step/step.hpp"

namespace tisserand::mechanism::radau {

/// Column i: stage i. d: displacements and rotation vectors θ from the start of the step, in the order of velocities.
struct Stages {
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  explicit Stages(const Sizes& sizes);

  double step = 0.0;  ///< h; 0: none yet
  StepEnd end;
  Columns d, v, a, lambda;
  Eigen::VectorXd v_begin, a_begin;  ///< where the step begins
  Eigen::VectorXd displacement;      ///< buffer of interpolate()
  Eigen::Vector3d load_power = Eigen::Vector3d::Zero(), damping_power = Eigen::Vector3d::Zero();
};

/// v and a from d: THEORY (74).
void update_rates(const Model& model, Stages& stages);

/// Predicts v and λ of a step to `end` from the polynomials of the step `last` before; in the first step from v̇ and λ
/// of the state. Then d from v: two sweeps of θ̇ = T⁻¹(θ) Ω.
void predict(const Model& model, const State& state, const StepEnd& end, const Stages& last, Stages& stages);

/// Positions, velocities, accelerations and multipliers at the share `tau` of the step that began at `begin`:
/// polynomials of order 4 through start and stages with the rates of the start, and for λ through the stages. The
/// result does not yet satisfy the constraints.
void interpolate(const Model& model, const State& begin, double tau, Stages& stages, State& state);

/// ∫ of a power from the start of the step to the share `tau`, by its polynomial through the stages (order 5 at 1).
double integral(const Stages& stages, const Eigen::Vector3d& power, double tau);

}  // namespace tisserand::mechanism::radau
