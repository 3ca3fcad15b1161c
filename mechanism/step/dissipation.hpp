// Energy that the damping of superelements takes in a step, by the mean rates of the step.
//
// Positions turn with Ω while velocities of nodes follow Newmark's rule: between both are O(h²) of a turning body's
// speed, which are rates of deformation though nothing deforms, and times a stiff D a power that nothing loses. Δy has
// none.
#pragma once

#include <vector>

#include "mechanism/bodies/superelement/evaluate.hpp"
#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

class Dissipation {
 public:
  void forget() { known_ = false; }

  /// Energy of the step that ends at the last evaluation beyond that of the trapezoidal rule for evaluation.body_power:
  /// zero for the first step after forget(). Keeps what the next step begins with.
  double beyond_trapezoid(const Model& model, double step, const Evaluation& now);

 private:
  bool known_ = false;
  double power_ = 0.0;                   ///< body_power where the step begins
  std::vector<StepDeformation> before_;  ///< per use; empty where the body is not damped
};

}  // namespace tisserand::mechanism
