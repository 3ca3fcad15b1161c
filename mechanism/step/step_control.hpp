// SPDX-License-Identifier: GPL-3.0-or-later
// Local error of a step of generalised alpha or HHT, and the size of the next one.
#pragma once

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Local error of a step relative to its limit, and the coordinate that has it.
struct LocalError {
  double ratio = 0.0;  ///< error over its limit; a step with at most 1 is accepted
  int worst_coordinate = -1;
};

/// Estimates the local error of the positions by its leading term, THEORY (71): C h³ v̈ with
/// C = |1/6 − β − (α_m − α_f)/2| [ABC15]. h v̈ ≈ a_{n+1} − a_n are the rebuilt algorithmic accelerations at both ends
/// of the step ([NRO07] for HHT). It is exact up to order h² for any previous steps. `last`: state before the step.
/// `error` receives boundary and internal coordinates.
void estimate_error(const formats::IntegratorSpec& options, double step, const State& state, const State& last,
                    Eigen::VectorXd& error);

/// Ratio of an estimated error to the error that one step may add, which is `share` times the tolerance. For a step h
/// of generalised alpha the share is h/(end − start), so that errors which add up reach about the tolerance at the end.
/// Steps are then proportional to tolerance^(1/2), as errors are to step². Positions count relative to the
/// characteristic length, rotations in radians. Internal coordinates of a superelement of mass m count relative to
/// length·sqrt(m).
LocalError measure_error(const Model& model, const formats::ErrorControl& control, double share,
                         const Eigen::Ref<const Eigen::VectorXd>& error);

/// Length of the next step after a step with the error ratio `ratio`, THEORY (72): `step` times 0.9 ratio^(−1/2),
/// between 0.2 and 2 times. A step that would grow by less than a fifth stays, so that factors are kept.
double next_step(const formats::IntegratorSpec& options, double step, double ratio);
/// Length to try after a failed step, shorter than `step`. `ratio`: ratio of the local error to its limit; 0 if the
/// step did not converge.
double shorter_step(double step, double ratio);

/// Distance of instants below which they count as equal. It is a small fraction of the step, but not less than two
/// errors: the round-off of `time`, and the difference between grids of steps and rows whose spacings have twelve
/// digits.
double instant_tolerance(double step, double time);

/// Smallest step that `error_control` of the scene allows; by default a share 1e-12 of the time of the run.
double least_step(const formats::IntegratorSpec& options);
/// Largest step that `error_control` of the scene allows; by default a tenth of the time of the run.
double greatest_step(const formats::IntegratorSpec& options);

}  // namespace tisserand::mechanism
