// SPDX-License-Identifier: GPL-3.0-or-later
// Projection of positions in stabilised index 2: the smallest change, weighted with mass and stiffness of the bodies,
// that satisfies the constraints; THEORY (67), after [GGL85]. B of Bᵀμ belongs to the middle of the step. A direction
// of another instant would feed energy into the motion.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/equations/saddle_system.hpp"
#include "mechanism/step/generalised_alpha.hpp"
#include "mechanism/step/tuning.hpp"

namespace tisserand::mechanism {

/// Projection of positions, THEORY (67): matrix [W Bᵀ; B 0] with its factors and their age, and a prediction of the
/// multipliers μ. Index 3 leaves it empty. Factors serve many steps, while B turns from B₀ (at the factors) to B_m
/// (middle of the step). The projection therefore solves W δ + B₀ᵀ(μ − μ₁) + B_mᵀ μ₁ = 0 with the multipliers μ₁ of the
/// previous step. Only the change of μ over one step has the old direction B₀. The sum of all corrections of a step
/// depends on the closed violations alone, not on the number of iterations.
struct PositionProjection {
  void forget();
  bool has_factors() const { return step > 0.0; }

  /// Entry of B₀: its slot in the matrix, its coordinate and constraint row, and its value when the factors were made.
  struct Entry {
    int slot, coordinate, row;
    double value;
  };

  std::optional<SaddleSystem> system;
  std::vector<Entry> entries;
  Eigen::VectorXd turns;   ///< per boundary coordinate: 1 for rotations of bodies with mass
  Eigen::VectorXd open;    ///< violations that are still to be closed
  Eigen::VectorXd closed;  ///< part of `open` that the latest change closes
  // μ divided by the scale of the matrix.
  Eigen::VectorXd multipliers;  ///< μ of this step so far
  Eigen::VectorXd expected;     ///< μ₁ of the previous step
  Eigen::VectorXd old;          ///< B₀ᵀ μ₁ in boundary coordinates
  Eigen::VectorXd turned;       ///< buffer: (B₀ − B_m)ᵀ μ₁
  Eigen::VectorXd upper;        ///< part of `turned` that solutions of this step contain
  /// Flag per boundary coordinate: 0 for coordinates without mass that no constraint holds, else 1.
  Eigen::VectorXd held;
  double taken = 0.0;          ///< length of the present step
  double expected_step = 0.0;  ///< length of the step to which μ₁ belongs; zero: none
  double elapsed = 0.0;        ///< time from the state of B₀ to the start of the step
  double step = 0.0;           ///< length of the step for which W was made; zero: no factors
  double age = 0.0;            ///< used part of the life of the factors; made again at 1
  bool renewed = false;        ///< factors belong to an iterate, and end with this step
};

/// Prepares μ₁ and the matrix [W Bᵀ; B 0] for a step from `state`, with W = c_m M + c_k K of the bodies alone. The
/// matrix is made again at `state` if bodies have turned too far or too many steps have passed. It is also made again
/// if the step is more than twice or less than half of the former one. Turns of bodies with mass and numbers of steps
/// decide, not iterations.
[[nodiscard]] FactorReport prepare_projection(const Model& model, const State& state, const StepScheme& scheme,
                                              Evaluation& evaluation, PositionProjection& projection);

/// Makes the matrix [W Bᵀ; B 0] at the iterate of the last evaluation, for the rest of this step. It is for a singular
/// position between B₀ and B of the end of a step. There a direction in which rows are nearly dependent has the other
/// sign, and corrections with B₀ open the constraints for any length of the step. The next step makes its own matrix.
[[nodiscard]] FactorReport renew_projection(const Model& model, const State& state, const StepScheme& scheme,
                                            Evaluation& evaluation, PositionProjection& projection);

/// Resets the sums of multipliers and directions of a step. The caller must call it before the first iteration.
void start_projection(PositionProjection& projection);

/// Sets `correction` to the smallest change d with B d = projection.open, approximately. B is that of the factors, or
/// that of the last evaluate() if bodies have turned much since. PositionProjection gives the direction of the sum of
/// the corrections of a step. Internal coordinates of superelements stay. Nodes without mass have no weight, so kept
/// and eliminated virtual bodies give equal corrections.
void project_positions(const Model& model, const StepTuning& tuning, const Evaluation& evaluation,
                       PositionProjection& projection, Eigen::VectorXd& correction);

/// Adds an accepted step to the age of the factors, and keeps its multipliers as μ₁ of the next step.
void age_projection(const Model& model, const StepTuning& tuning, const Evaluation& evaluation,
                    PositionProjection& projection);

}  // namespace tisserand::mechanism
