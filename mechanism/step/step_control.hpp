// SPDX-License-Identifier: GPL-3.0-or-later
// Local error of a step of generalised alpha or HHT, and the size of the next one.
#pragma once

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

struct LocalError {
  double ratio = 0.0;  ///< error over the error that one step may add; at most 1: accepted
  int worst_coordinate = -1;
};

/// Leading term of the local error of the positions, THEORY (71): C h³ v̈ with C = 1/6 − β − (α_m − α_f)/2 [ABC15]. h
/// v̈ ≈ a_{n+1} − a_n, the rebuilt algorithmic accelerations at both ends of the step ([NRO07] for HHT). It is exact up
/// to order h² for any previous steps. `last`: state before the step. `error`: boundary and internal coordinates.
void estimate_error(const formats::IntegratorSpec& options, double step, const State& state, const State& last,
                    Eigen::VectorXd& error);

/// Ratio of an estimated error to the error that one step may add: `share` times the tolerance. A step h of generalised
/// alpha may add the share h/(end − start), so that errors which add up reach about the tolerance at the end. Steps are
/// proportional to tolerance^(1/2), errors to step². Positions count relative to the characteristic length, rotations
/// in radians, internal coordinates of a superelement of mass m relative to length·sqrt(m).
LocalError measure_error(const Model& model, const formats::ErrorControl& control, double share,
                         const Eigen::Ref<const Eigen::VectorXd>& error);

/// Next step after one of size `step`, THEORY (72): 0.9 ratio^(−1/2) times it, between 0.2 and 2 times. It is unchanged
/// if it would grow by less than a fifth, so that factors are kept.
double next_step(const formats::IntegratorSpec& options, double step, double ratio);
/// Step to try instead of one that was too inaccurate, or did not converge (ratio 0).
double shorter_step(double step, double ratio);

/// Instants closer than this are equal: a small fraction of the step, but not less than two errors. These are the
/// round-off of the time, and the difference between grids of steps and rows whose spacings have twelve digits.
double instant_tolerance(double step, double time);

/// Limits of steps from `error_control`, or their defaults.
double least_step(const formats::IntegratorSpec& options);
double greatest_step(const formats::IntegratorSpec& options);

}  // namespace tisserand::mechanism
