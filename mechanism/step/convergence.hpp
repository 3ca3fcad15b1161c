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

/// Sizes of residuals and violations. Ratios are values divided by their limits.
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

/// Largest component of boundary coordinates. Translations are relative to the characteristic length.
double size_of(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& increment);

/// Largest residuals relative to the running maxima of forces, moments and internal forces, and largest violations
/// relative to the characteristic length (rates: to length/step).
Norms measure(const Model& model, const formats::IntegratorSpec& options, double step, const State& state,
              Evaluation& evaluation);

}  // namespace tisserand::mechanism
