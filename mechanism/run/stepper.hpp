// SPDX-License-Identifier: GPL-3.0-or-later
// One step of the method of a scene: generalised alpha and HHT, or Radau IIA.
#pragma once

#include <optional>

#include "formats/scene/scene.hpp"
#include "mechanism/radau/radau.hpp"
#include "mechanism/step/step.hpp"

namespace tisserand::mechanism {

/// Time stepping method of a scene: generalised alpha, HHT or Radau IIA.
class Stepper {
 public:
  Stepper(const Model& model, const formats::IntegratorSpec& options);

  /// Computes one step to `end`, like advance() of step/step.hpp.
  [[nodiscard]] StepReport advance(const StepEnd& end, State& state, Workspace& workspace);
  /// Sets `state`, which is at the end of the last step, to the instant `time` within this step. Requires the method
  /// radau.
  void interpolate(double time, State& state, Workspace& workspace);
  /// Discards matrix factors and history in the workspace and in the method.
  void forget(Workspace& workspace);
  /// Tells the method that loads jump at the end of the last step. Radau then does not extrapolate its stages as start
  /// values of the next step; the other methods do nothing.
  void pass_jump();
  SolverHealth health(const Workspace& workspace) const;

 private:
  const Model& model_;
  const formats::IntegratorSpec& options_;
  std::optional<Radau> radau_;
};

}  // namespace tisserand::mechanism
