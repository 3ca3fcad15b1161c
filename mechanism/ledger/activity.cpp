// SPDX-License-Identifier: GPL-3.0-or-later
// Activities from residuals at stored states.
#include "mechanism/ledger/activity.hpp"

#include <cmath>

#include "mechanism/equations/evaluate.hpp"

namespace tisserand::mechanism {
namespace {

Eigen::VectorXd whole_residual(const Model& model, const State& state, Evaluation& now) {
  evaluate(model, state, now);
  Eigen::VectorXd r(model.sizes.velocities());
  gather_residual(model, now, r);
  return r;
}

double strain_of(const Model& model, const std::string& body, const State& state, Evaluation& now) {
  evaluate(model, state, now);
  for (std::size_t i = 0; i < model.superelements.size(); ++i)
    if (model.superelements[i].name == body)
      return energy(body_of(model, i), now.superelements[i], Eigen::Vector3d::Zero()).strain;
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i)
    if (const ModalBody& modal = model.modal_bodies[i]; modal.name == body)
      return 0.5 * modal.stiffness.dot(now.modal_bodies[i].w.cwiseAbs2());
  return 0.0;
}

}  // namespace

SampledPowers::SampledPowers(const Model& model, const std::vector<WindowHistory>& windows)
    : model_(model), windows_(windows) {
  Evaluation now(model);
  for (const WindowHistory& window : windows) {
    residuals_.emplace_back();
    for (const State& state : window.states) residuals_.back().push_back(whole_residual(model, state, now));
  }
}

double SampledPowers::of_difference(const Model& other) const {
  Evaluation now(other);
  double sum = 0.0;
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    const WindowHistory& window = windows_[w];
    double before = 0.0;
    for (std::size_t k = 0; k < window.states.size(); ++k) {
      const State& state = window.states[k];
      const double power = std::abs(state.v().dot(whole_residual(other, state, now) - residuals_[w][k]));
      if (k > 0) sum += 0.5 * (before + power) * (window.time[k] - window.time[k - 1]);
      before = power;
    }
  }
  return sum;
}

double SampledPowers::of_strain(const std::string& body) const {
  Evaluation now(model_);
  double sum = 0.0;
  for (const WindowHistory& window : windows_) {
    double before = 0.0;
    for (std::size_t k = 0; k < window.states.size(); ++k) {
      const double strain = strain_of(model_, body, window.states[k], now);
      if (k > 0) sum += std::abs(strain - before);
      before = strain;
    }
  }
  return sum;
}

}  // namespace tisserand::mechanism
