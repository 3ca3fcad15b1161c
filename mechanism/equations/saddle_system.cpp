// SPDX-License-Identifier: GPL-3.0-or-later
// Scaling of the saddle system around the solver.
#include "mechanism/equations/saddle_system.hpp"

namespace tisserand::mechanism {

SaddleSystem::SaddleSystem(const Model& model)
    : matrix(model),
      unknowns(Eigen::VectorXd::Zero(model.pattern->size())),
      solver_(*model.pattern, model.solver.kind) {}

FactorReport SaddleSystem::factor(const Model& model) {
  Eigen::Map<Eigen::ArrayXd>(matrix.values.data(), model.value_scale.size()) *= model.value_scale;
  return solver_.numeric(matrix.values);
}

void SaddleSystem::solve(const Model& model) {
  unknowns.array() *= model.equation_scale;
  solver_.solve({unknowns.data(), static_cast<std::size_t>(unknowns.size())});
  unknowns.array() *= model.equation_scale;
}

}  // namespace tisserand::mechanism
