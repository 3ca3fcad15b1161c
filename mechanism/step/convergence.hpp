// SPDX-License-Identifier: GPL-3.0-or-later
// Convergence test of Newton's iteration: forces relative to those of the motion, constraints relative to the motion of
// a step.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Sizes of residuals and constraint violations in one iteration. Ratios are values divided by their limits. `residual`
/// is the largest force (moments / length), `constraint` the largest violation (angles · length), with the length of
/// the model.
struct Norms {
  double force_ratio = 0.0;
  double constraint_ratio = 0.0;
  double residual = 0.0;
  double constraint = 0.0;
  int worst_coordinate = -1;
  int worst_constraint = -1;
  bool finite() const { return std::isfinite(force_ratio) && std::isfinite(constraint_ratio); }
  double worst() const { return std::max(force_ratio, constraint_ratio); }
};

/// Largest component of an increment of boundary coordinates. Translations count divided by the characteristic length,
/// rotations in radians.
double size_of(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& increment);

/// Measures residuals and constraint violations relative to their limits. The limit of a residual is the tolerance
/// times the running maximum of forces, moments or internal forces. The limit of a violation is the constraint
/// tolerance times the characteristic length (rates: times length/step), and less in slow motions. No limit is below
/// round-off.
Norms measure(const Model& model, const formats::IntegratorSpec& options, double step, const State& state,
              Evaluation& evaluation);

}  // namespace tisserand::mechanism
