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

/// Matrix [W Bᵀ; B 0] with its factors and their age, and a prediction of μ. Index 3 leaves it empty.
///
/// Factors serve many steps, while B turns from B₀ to B_m. The projection therefore solves W δ + B₀ᵀ(μ − μ₁) + B_mᵀ μ₁
/// = 0 with the multipliers μ₁ of the previous step. Only the change of μ over one step has the old direction B₀. The
/// sum of all corrections of a step depends on the closed violations alone, not on the number of iterations.
struct PositionProjection {
  void forget();
  bool has_factors() const { return step > 0.0; }

  /// Entry of B₀: its slot in the matrix, its row and coordinate, and its value when the factors were made.
  struct Entry {
    int slot, coordinate, row;
    double value;
  };

  std::optional<SaddleSystem> system;
  std::vector<Entry> entries;
  Eigen::VectorXd turns;   ///< boundary: 1 for rotations of bodies with mass, else 0
  Eigen::VectorXd open;    ///< rows that are still to be closed
  Eigen::VectorXd closed;  ///< rows that the latest change closes
  // μ divided by the scale of the matrix.
  Eigen::VectorXd multipliers;  ///< μ of this step so far
  Eigen::VectorXd expected;     ///< μ₁
  Eigen::VectorXd old;          ///< B₀ᵀ μ₁
  Eigen::VectorXd turned;       ///< buffer: (B₀ − B_m)ᵀ μ₁
  Eigen::VectorXd upper;        ///< the part of `turned` that solutions of this step already contain
  Eigen::VectorXd held;         ///< boundary: 0 for coordinates without mass that no constraint holds, else 1
  double taken = 0.0;           ///< length of the step that is being taken
  double expected_step = 0.0;   ///< length of the previous step, to which μ₁ belongs; zero: none
  double elapsed = 0.0;         ///< time from B₀ to the start of the step
  double step = 0.0;            ///< step for which W was made; zero: there are no factors
  double age = 0.0;             ///< used fraction of the life of the factors; at 1 they are made again
  bool renewed = false;         ///< factors belong to an iterate of this step, and end with it
};

/// Prepares μ₁ and [W Bᵀ; B 0] for a step from `state`, W = c_m M + c_k K of the bodies alone. The matrix is made again
/// at `state` if bodies have turned too far or too many steps have passed. It is also made again if the step is more
/// than twice or less than half of the former one. Motions of bodies with mass and numbers of steps decide, not
/// iterations.
[[nodiscard]] FactorReport prepare_projection(const Model& model, const State& state, const StepScheme& scheme,
                                              Evaluation& evaluation, PositionProjection& projection);

/// Makes [W Bᵀ; B 0] at the iterate of the last evaluation, for the rest of this step. A singular position may lie
/// between B₀ and B of the end of a step. Then a direction in which rows are nearly dependent has the other sign, and
/// corrections with B₀ open the constraints instead of closing them, for any length of the step. The next step makes
/// its own.
[[nodiscard]] FactorReport renew_projection(const Model& model, const State& state, const StepScheme& scheme,
                                            Evaluation& evaluation, PositionProjection& projection);

/// Resets the sums of a step before its first iteration.
void start_projection(PositionProjection& projection);

/// Sets `correction` to d with B d = projection.open, approximately. B is that of prepare_projection(), or, if bodies
/// have turned much since, that of the last evaluate(). PositionProjection gives the direction of the sum of the
/// corrections of a step. Internal coordinates of superelements stay. Nodes without mass have no weight, so kept and
/// eliminated virtual bodies give the same correction.
void project_positions(const Model& model, const StepTuning& tuning, const Evaluation& evaluation,
                       PositionProjection& projection, Eigen::VectorXd& correction);

/// Ages the factors by an accepted step.
void age_projection(const Model& model, const StepTuning& tuning, const Evaluation& evaluation,
                    PositionProjection& projection);

}  // namespace tisserand::mechanism
