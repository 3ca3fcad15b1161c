// Projection of positions in stabilised index 2: the smallest change, weighted with mass and stiffness of the bodies,
// that meets the constraints; THEORY (67), after [GGL85]. B of Bᵀμ is that of the middle of the step: a
// direction of another instant leans to one side of the motion and feeds energy into it.
#pragma once

#include <optional>
#include <vector>

#include "mechanism/equations/saddle_system.hpp"
#include "mechanism/step/generalised_alpha.hpp"
#include "mechanism/step/tuning.hpp"

namespace tisserand::mechanism {

/// [W Bᵀ; B 0] with its factors and their age, and what is known of δ before it is found. Index 3 leaves it empty.
///
/// Factors serve many steps, and B turns meanwhile, from B₀ to B_m. Of W δ + B₀ᵀ(μ − μ₁) + B_mᵀ μ₁ = 0 with the
/// multipliers μ₁ of the step before, the old direction is left with the change of μ over one step alone. The sum of
/// all corrections of a step still follows from what they close, whatever the iterations on the way.
struct PositionProjection {
  void forget();
  bool has_factors() const { return step > 0.0; }

  /// Of B₀: its slot in the matrix, where it stands, and what it was when the factors were made.
  struct Entry {
    int slot, coordinate, row;
    double value;
  };

  std::optional<SaddleSystem> system;
  std::vector<Entry> entries;
  Eigen::VectorXd turns;   ///< boundary: 1 for rotations of bodies with mass, else 0
  Eigen::VectorXd open;    ///< rows that are still to be closed
  Eigen::VectorXd closed;  ///< rows that the latest change closes
  // μ as the system has it, that is over the scale of its matrix.
  Eigen::VectorXd multipliers;  ///< of this step so far
  Eigen::VectorXd expected;     ///< μ₁
  Eigen::VectorXd old;          ///< B₀ᵀ μ₁
  Eigen::VectorXd turned;       ///< buffer: (B₀ − B_m)ᵀ μ₁
  Eigen::VectorXd upper;        ///< of that, what solutions of this step have been given
  Eigen::VectorXd held;         ///< boundary: 0 for coordinates without mass that no constraint holds, else 1
  double taken = 0.0;           ///< length of the step that is being taken
  double expected_step = 0.0;   ///< of the step before, to which μ₁ belongs; zero: there is none
  double elapsed = 0.0;         ///< from B₀ to the start of the step
  double step = 0.0;            ///< with which W was made; zero: there are no factors
  double age = 0.0;             ///< share of what the factors may serve that is used up
  bool renewed = false;         ///< factors are those of an iterate of this step, and end with it
};

/// Readies μ₁ and [W Bᵀ; B 0] for a step from `state`, W = c_m M + c_k K of the bodies alone: made anew, at `state`,
/// where bodies have turned too far or too many steps have passed since the last one, or the step is more than twice or
/// less than half of what it was then. What decides are motions of bodies with mass and numbers of steps, no numbers of
/// iterations.
[[nodiscard]] FactorReport prepare_projection(const Model& model, const State& state, const StepScheme& scheme,
                                              Evaluation& evaluation, PositionProjection& projection);

/// [W Bᵀ; B 0] at the iterate of the last evaluation, for the rest of this step. Between B₀ and B of the end of a step
/// there may be a singular position: a direction in which rows are nearly dependent then has the other sign, and
/// corrections with B₀ open what they should close, whatever the length of the step. The next step makes its own.
[[nodiscard]] FactorReport renew_projection(const Model& model, const State& state, const StepScheme& scheme,
                                            Evaluation& evaluation, PositionProjection& projection);

/// Before the first iteration of a step: nothing is corrected yet.
void start_projection(PositionProjection& projection);

/// correction <- d with B d = projection.open, about: for B of prepare_projection(), or, where bodies have turned much
/// since, of the last evaluate(); the sum of the corrections of a step in the direction that PositionProjection says.
/// Internal coordinates of superelements stay. Nodes without mass have no weight, so that those of virtual bodies, kept
/// or eliminated, change nothing.
void project_positions(const Model& model, const StepTuning& tuning, const Evaluation& evaluation,
                       PositionProjection& projection, Eigen::VectorXd& correction);

/// Notes what an accepted step uses up.
void age_projection(const Model& model, const StepTuning& tuning, const Evaluation& evaluation,
                    PositionProjection& projection);

}  // namespace tisserand::mechanism
