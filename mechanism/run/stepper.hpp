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

  /// See advance() of step/step.hpp.
  [[nodiscard]] StepReport advance(const StepEnd& end, State& state, Workspace& workspace);
  /// The state at an instant within the last step, which ended at `state`. Radau alone.
  void interpolate(double time, State& state, Workspace& workspace);
  /// Factors and what was learnt, of workspace and method.
  void forget(Workspace& workspace);
  /// A breakpoint of loads was passed.
  void pass_jump();
  SolverHealth health(const Workspace& workspace) const;

 private:
  const Model& model_;
  const formats::IntegratorSpec& options_;
  std::optional<Radau> radau_;
};

}  // namespace tisserand::mechanism
