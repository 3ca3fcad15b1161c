// Mean rates of a step in place of those at its ends.
#include "mechanism/step/dissipation.hpp"

namespace tisserand::mechanism {

double Dissipation::beyond_trapezoid(const Model& model, double step, const Evaluation& now) {
  before_.resize(model.superelements.size());
  double mean = 0.0;
  for (std::size_t i = 0; i < before_.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    if (!body.damping.active) continue;
    const SuperelementScratch& scratch = now.superelements[i];
    if (known_) mean += mean_damping_power(body, scratch, step, before_[i]);
    keep_deformation(body, scratch, before_[i]);
  }
  const double energy = known_ ? step * (mean - 0.5 * (power_ + now.body_power)) : 0.0;
  power_ = now.body_power;
  known_ = true;
  return energy;
}

}  // namespace tisserand::mechanism
