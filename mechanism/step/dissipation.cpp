// SPDX-License-Identifier: GPL-3.0-or-later
// Damping power from mean rates of a step instead of those at its ends.
#include "mechanism/step/dissipation.hpp"

namespace tisserand::mechanism {

Dissipation::Dissipation(const Model& model) : before_(model.superelements.size()) {
  for (std::size_t i = 0; i < before_.size(); ++i) damped_ = damped_ || body_of(model, i).damping.active;
}

void Dissipation::begin(const Model& model, const Evaluation& now) {
  for (std::size_t i = 0; i < before_.size(); ++i)
    if (const SuperelementBody& body = body_of(model, i); body.damping.active)
      keep_deformation(body, now.superelements[i], before_[i]);
  power_ = now.body_power;
  known_ = true;
}

double Dissipation::beyond_trapezoid(const Model& model, double step, const Evaluation& now) {
  if (!damped_) return 0.0;
  double power = -0.5 * (power_ + now.body_power);
  for (std::size_t i = 0; i < before_.size(); ++i)
    if (const SuperelementBody& body = body_of(model, i); body.damping.active)
      power += mean_damping_power(body, now.superelements[i], step, before_[i]);
  begin(model, now);
  return step * power;
}

}  // namespace tisserand::mechanism
