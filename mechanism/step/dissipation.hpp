// SPDX-License-Identifier: GPL-3.0-or-later
// Energy that the damping of superelements dissipates in a step, from the mean rates of the step.
//
// Orientations of nodes advance by Ω h, velocities by Newmark's rule. In a body that turns steadily they differ by
// O(h²). The rates of deformation are then not zero, though nothing deforms. A stiff D would give a dissipated power
// that does not exist. Δy is zero.
#pragma once

#include <vector>

#include "mechanism/bodies/superelement/evaluate.hpp"
#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// Energy that the damping of superelements dissipates in each step, from the mean rates of the step.
class Dissipation {
 public:
  explicit Dissipation(const Model& model);

  void forget() { known_ = false; }
  /// Whether the caller must call begin() before the next step: after forget(), if a superelement is damped.
  bool begins() const { return damped_ && !known_; }
  /// Stores the deformation at the last evaluation, which must be the start of a step.
  void begin(const Model& model, const Evaluation& now);

  /// Dissipated energy of the step that ends at the last evaluation, minus that of the trapezoidal rule for
  /// evaluation.body_power. Stores the deformation for the next step.
  double beyond_trapezoid(const Model& model, double step, const Evaluation& now);

 private:
  bool damped_ = false;
  bool known_ = false;
  double power_ = 0.0;                   ///< body_power at the start of the step
  std::vector<StepDeformation> before_;  ///< per use; empty if the body is not damped
};

}  // namespace tisserand::mechanism
