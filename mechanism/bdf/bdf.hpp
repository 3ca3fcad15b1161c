// Backward differentiation of variable order and step (SUNDIALS CVODE) on the equations of index 1: the way of [GA00].
#pragma once

#include <memory>
#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/step/step.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Whether this build holds CVODE.
bool bdf_available();

struct BdfCounts {
  long steps = 0;
  long iterations = 0;      ///< of CVODE's Newton iteration
  long evaluations = 0;     ///< accelerations, differences for the Jacobian included
  long factorisations = 0;  ///< of [M Bᵀ; B 0]: one per evaluation, and those of the projection
  long error_failures = 0;  ///< steps taken again because of the error
  long convergence_failures = 0;
  long row_choices = 0;  ///< how often the constraint rows that are solved for were chosen anew
  int order = 0;         ///< of the last step, 1 to 5
};

/// y = [x, p, internal coordinates, v, work, dissipated] with ẋ, ṗ = ½ L(p)ᵀ Ω and [M Bᵀ; B 0][v̇; λ] = [F − G; −Ḃ v]
/// ([GA00] (14), (16); internal coordinates condensed). Drift is removed by CVODE's projection after each step, in the
/// mass norm: positions, then velocities, then |p| = 1. The rotation of p is that of p/|p|, so |p| needs no constraint.
/// Linear algebra of CVODE: dense with differences up to 400 unknowns, GMRES without a matrix above.
class Bdf {
 public:
  /// The state is started (consistent). Throws Error if this build has no CVODE, or if a direction has no mass.
  Bdf(const formats::Scene& scene, const Model& model, State& state, Workspace& workspace);
  ~Bdf();
  Bdf(const Bdf&) = delete;
  Bdf& operator=(const Bdf&) = delete;

  /// One step, not beyond `stop` and loads not beyond `stop.load_time`; empty, or why it failed. The state, with
  /// accelerations and multipliers, is that at its end.
  [[nodiscard]] std::string step(const StepEnd& stop);
  /// Moves the state to an instant within the last step: interpolated with the order of the step, then projected.
  void go_to(double time);
  /// Starts anew from the state: loads of the far side of a jump count from `load_from` on.
  void restart(double load_from);

  /// Largest |Φ| of the state (positions, and angles times length).
  double violation() const;
  BdfCounts counts() const;

 private:
  struct Data;
  friend struct BdfCallbacks;
  std::unique_ptr<Data> data_;
};

}  // namespace tisserand::mechanism
