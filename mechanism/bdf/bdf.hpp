// SPDX-License-Identifier: GPL-3.0-or-later
// Backward differentiation of variable order and step (SUNDIALS CVODE) for the index-1 equations, the method of [GA00].
#pragma once

#include <memory>
#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/step/step.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Whether this build includes CVODE.
bool bdf_available();

/// Counts of the work of the bdf method.
struct BdfCounts {
  long steps = 0;
  long iterations = 0;   ///< iterations of CVODE's Newton solver
  long evaluations = 0;  ///< computations of accelerations, including differences for the Jacobian
  /// Factorisations of [M Bᵀ; B 0]: one per evaluation (several with friction), plus those of the projection.
  long factorisations = 0;
  long error_failures = 0;  ///< number of steps that were repeated because of their error
  long convergence_failures = 0;
  long row_choices = 0;  ///< number of times that other constraint rows were chosen
  int order = 0;         ///< order of the last step, 1 to 5
};

/// Integrator of the method bdf: backward differentiation of variable order and step (SUNDIALS CVODE). It integrates
/// y = [x, p, internal coordinates, v, work, dissipated], with positions x, quaternions p and velocities v, by
///   ẋ = v, ṗ = ½ L(p)ᵀ Ω, [M Bᵀ; B 0][v̇; λ] = [F − G; −Ḃ v]
/// ([GA00] (14), (16); internal coordinates condensed). After each step CVODE's projection removes the drift in the
/// mass norm: positions, then velocities, then |p| = 1. Rotations use p/|p|, so no constraint on |p| is needed. Up to
/// 400 unknowns CVODE uses dense matrices by differences, above it GMRES.
class Bdf {
 public:
  /// Starts the integration. Requires that `state` is a consistent start. Throws Error if this build has no CVODE, or
  /// if a direction has no mass.
  Bdf(const formats::Scene& scene, const Model& model, State& state, Workspace& workspace);
  ~Bdf();
  Bdf(const Bdf&) = delete;
  Bdf& operator=(const Bdf&) = delete;

  /// Makes one step, at most to `stop`, with loads at most at `stop.load_time`. Returns an empty text, or the reason of
  /// a failure. Afterwards the state, with accelerations and multipliers, is that at the end of the step.
  [[nodiscard]] std::string step(const StepEnd& stop);
  /// Moves the state to the instant `time` within the last step, by interpolation with the order of the step and by
  /// projection.
  void go_to(double time);
  /// Restarts the method from the state with order 1. After a jump, loads are evaluated from the time `load_from` on.
  void restart(double load_from);

  /// Largest |Φ| of the state: lengths, and angles times characteristic length.
  double violation() const;
  BdfCounts counts() const;

 private:
  struct Data;
  friend struct BdfCallbacks;
  std::unique_ptr<Data> data_;
};

}  // namespace tisserand::mechanism
