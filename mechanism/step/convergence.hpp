// When Newton's iteration of a step has converged: forces against those of the motion, constraints against what it
// moves.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Ratios are values divided by what is allowed.
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

/// Largest component of boundary coordinates, positions relative to the characteristic length.
double size_of(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& increment);

/// Largest residuals against the running maxima of forces, moments and internal forces; largest violations against the
/// characteristic length (rates: against length/step).
Norms measure(const Model& model, const formats::IntegratorSpec& options, double step, const State& state,
              Evaluation& evaluation);

}  // namespace tisserand::mechanism
