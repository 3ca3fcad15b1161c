// SPDX-License-Identifier: GPL-3.0-or-later
// Condensation and expansion around the global solution.
#include "mechanism/equations/iteration_matrix.hpp"

#include <algorithm>
#include <cmath>

namespace tisserand::mechanism {

IterationMatrix::IterationMatrix(const Model& model)
    : increment(Eigen::VectorXd::Zero(model.sizes.velocities())),
      multipliers(Eigen::VectorXd::Zero(model.sizes.constraints)),
      correction(increment),
      projection_multipliers(multipliers),
      rows(multipliers),
      system_(model) {
  int boundary = 0;
  for (const SuperelementBody& body : model.superelement_bodies) boundary = std::max(boundary, body.boundary_size);
  element_boundary_.setZero(boundary);
}

FactorReport IterationMatrix::factor(const Model& model, const State& state, const TangentRequest& request,
                                     Evaluation& evaluation) {
  evaluate_tangent(model, state, request, evaluation, system_.matrix);
  const FactorReport report = system_.factor(model);
  factored_.reset();
  if (report.regular) factored_ = request;
  tangent_ = evaluation.tangents;
  return report;
}

void IterationMatrix::forget() {
  system_.forget();
  invalidate();
}

void IterationMatrix::gather(const Model& model, std::size_t superelement, const Eigen::VectorXd& boundary) {
  const std::vector<int>& coordinates = model.superelements.maps[superelement].coordinates;
  for (std::size_t k = 0; k < coordinates.size(); ++k) element_boundary_[k] = boundary[coordinates[k]];
}

void IterationMatrix::solve_increment(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& right,
                                      Evaluation& evaluation) {
  require_stage(evaluation, Stage::forces);
  const int n = model.sizes.boundary;
  const double scale = system_.matrix.scale;
  auto boundary = system_.unknowns.head(n);
  boundary = -evaluation.residual;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementScratch& scratch = evaluation.superelements[i];
    SuperelementWork& work = work_of(model, i, evaluation);
    condense(body_of(model, i), scratch, work);
    const std::vector<int>& coordinates = model.superelements.maps[i].coordinates;
    for (std::size_t k = 0; k < coordinates.size(); ++k)
      boundary[coordinates[k]] += scratch.forces.r_B[k] - work.r_B_condensed[k];
  }
  boundary /= scale;
  system_.unknowns.tail(model.sizes.constraints) = right.cwiseProduct(evaluation.active);
  system_.solve(model);
  increment.head(n) = system_.unknowns.head(n);
  multipliers = system_.unknowns.tail(model.sizes.constraints) * scale;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    gather(model, i, increment);
    expand(body_of(model, i), evaluation.superelements[i], element_boundary_.data(),
           increment.data() + n + model.internal_offset[i], work_of(model, i, evaluation));
  }
}

void IterationMatrix::solve_projection(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& right,
                                       Evaluation& evaluation) {
  require_stage(evaluation, Stage::forces);
  const int n = model.sizes.boundary;
  system_.unknowns.head(n).setZero();
  system_.unknowns.tail(model.sizes.constraints) = right.cwiseProduct(evaluation.active);
  system_.solve(model);
  correction.head(n) = system_.unknowns.head(n);
  projection_multipliers = system_.unknowns.tail(model.sizes.constraints) * system_.matrix.scale;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    gather(model, i, correction);
    expand_motion(body_of(model, i), evaluation.superelements[i], element_boundary_.data(),
                  correction.data() + n + model.internal_offset[i], work_of(model, i, evaluation));
  }
}

std::string IterationMatrix::weakest_equation(const Model& model) {
  Eigen::VectorXd& unknowns = system_.unknowns;
  unknowns.setOnes();
  Eigen::Index at = 0;
  for (int i = 0; i < 2; ++i) {
    system_.solve(model);
    const double largest = unknowns.cwiseAbs().maxCoeff(&at);
    if (!(largest > 0.0) || !std::isfinite(largest)) break;
    unknowns /= largest;
  }
  return at < model.sizes.boundary ? coordinate_name(model, static_cast<int>(at))
                                   : constraint_name(model, static_cast<int>(at) - model.sizes.boundary);
}

}  // namespace tisserand::mechanism
