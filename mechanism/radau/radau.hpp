// SPDX-License-Identifier: GPL-3.0-or-later
// Radau IIA of three stages on the equations of motion with velocities on the constraints: order 5.
//
// Numbers are those of docs/THEORY.md, section 11. Stages c_1, c_2, c_3 = 1; w_ij: A⁻¹; d_i: displacements from the
// start of the step, rotations as rotation vectors θ_i.
//   (73) r(q_i, v_i, v̇_i, λ_i, t_i) = 0,  B v_i + Φ_t = 0,  q_i = q_0 ∘ exp(d_i)                [HW96] VII.1 (1.20)
//
//   (74) v_i = T(θ_i) Σ_j w_ij d_j/h; T = 1 except for rotations: velocities are the rates of d at the stages
//
//        v̇_i = Σ_j w_ij (v_j − v_0)/h
//
//   (75) q_1 = q_3 ∘ exp(δ), A δ + Bᵀμ = 0, Φ(q_1) = 0; then B v + Φ_t = 0 likewise: δ is of order h⁶, and μ acts
//        between the steps, not in the stages                                                 [GGL85], [HW96] VII.2
//
//   (76) error of q, with A and B_ω of (77), ω = γ/h: A e + Bᵀμ = ω² M e_q + ω (M e_v + C e_q), B_ω e = B e_q,
//        e_q = v_0/ω + Σ e_i d_i, e_v = v̇_0/ω + Σ e_i (v_i − v_0)                               [HW96] IV.8 (8.19)
//
//   (77) Newton: unknowns d and λ. With A⁻¹ = T Λ T⁻¹ one real and one complex system
//        [A Bᵀ; B_ω 0], A = ω² M + ω C + K, B_ω = B + ∂(B v)/∂q/ω, ω = γ/h and (α + iβ)/h          [HW96] IV.8 (8.5)
//
// The error test omits multipliers. They have order 3, positions and velocities order 5 where nothing is stiff.
#pragma once

#include "formats/scene/scene.hpp"
#include "mechanism/radau/newton.hpp"
#include "mechanism/radau/step_size.hpp"
#include "mechanism/step/step.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Integrator Radau IIA of three stages: takes steps, with its tangents, factors and step sizes.
class Radau {
 public:
  Radau(const Model& model, const formats::IntegratorSpec& options);

  /// Computes one step from `state` to `end`, as advance() of step/step.hpp. Requires an accepted, consistent state.
  /// With error control `report.proposed` is the length of the next step, or the length to try instead. Allocates
  /// memory only if constraint rows are chosen again.
  [[nodiscard]] StepReport advance(const StepEnd& end, State& state, Workspace& workspace);
  /// Sets `state` to an instant within the last accepted step. The result has order 4 and is projected on the
  /// constraints.
  void interpolate(double time, State& state, Workspace& workspace);
  /// Discards factors and history, so that the next step works like the first one.
  void forget();
  /// Declares a jump at the present instant. The next step then does not predict from the last one.
  void pass_jump() { last_.step = 0.0; }

  const SolverHealth& health() const { return newton_.health(); }
  radau::Tuning& tuning() { return tuning_; }

 private:
  StepReport take_step(const StepEnd& end, State& state, Workspace& workspace);
  bool solve_stages(const StepEnd& end, State& state, Workspace& workspace, StepReport& report);
  bool accurate(const State& begin, StepReport& report);
  bool ready_to_close(const State& state, Evaluation& now, StepReport& report);
  bool close(State& state, Evaluation& now, StepReport& report);
  void accept(State& state, Workspace& workspace, StepReport& report);
  radau::Accuracy accuracy() const;
  double farthest_turn() const;

  const Model& model_;
  const formats::IntegratorSpec& options_;
  radau::Tuning tuning_;
  radau::Newton newton_;
  radau::StepSize size_;
  radau::Stages stages_, last_;  ///< stages of this step, and of the last accepted one
  long parts_age_ = 0;           ///< steps since the tangents were renewed; −1: renewed at the end of this step
};

}  // namespace tisserand::mechanism
