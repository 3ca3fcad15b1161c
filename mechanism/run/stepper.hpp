// SPDX-License-Identifier: GPL-3.0-or-later
// One step of the method of a scene: generalised alpha and HHT, or Radau IIA.
#pragma once

#include <optional>

#include "formats/scene/scene.hpp"
#include "mechanism/radau/radau.hpp"
#include "mechanism/step/step.hpp"

namespace tisserand::mechanism {

class Stepper {
 public:
  Stepper(const Model& model, const formats::IntegratorSpec& options);

  /// Computes one step, as advance() of step/step.hpp.
  [[nodiscard]] StepReport advance(const StepEnd& end, State& state, Workspace& workspace);
  /// Sets `state` to an instant within the last step, which ended at `state`. For Radau only.
  void interpolate(double time, State& state, Workspace& workspace);
  /// Discards factors and history of workspace and method.
  void forget(Workspace& workspace);
  /// Declares that a breakpoint of loads was passed.
  void pass_jump();
  SolverHealth health(const Workspace& workspace) const;

 private:
  const Model& model_;
  const formats::IntegratorSpec& options_;
  std::optional<Radau> radau_;
};

}  // namespace tisserand::mechanism
