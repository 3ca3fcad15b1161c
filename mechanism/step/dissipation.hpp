// Energy that the damping of superelements takes in a step, by the mean rates of the step.
//
// Orientations of nodes advance by Ω h, velocities by Newmark's rule. In a body that turns steadily they differ by
// O(h²). The rates of deformation are then not zero, though nothing deforms, and a stiff D makes a power of them that
// nothing loses. Δy is zero.
#pragma once

#include <vector>

#include "mechanism/bodies/superelement/evaluate.hpp"
#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

class Dissipation {
 public:
  explicit Dissipation(const Model& model);

  void forget() { known_ = false; }
  /// Whether begin() is due before the next step: after forget(), where a superelement is damped.
  bool begins() const { return damped_ && !known_; }
  /// Keeps the deformation at the last evaluation, where a step begins.
  void begin(const Model& model, const Evaluation& now);

  /// Energy of the step that ends at the last evaluation, less that of the trapezoidal rule for evaluation.body_power.
  /// Keeps what the next step begins with.
  double beyond_trapezoid(const Model& model, double step, const Evaluation& now);

 private:
  bool damped_ = false;
  bool known_ = false;
  double power_ = 0.0;                   ///< body_power where the step begins
  std::vector<StepDeformation> before_;  ///< per use; empty where the body is not damped
};

}  // namespace tisserand::mechanism
