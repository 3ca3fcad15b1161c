// Projection of positions in stabilised index 2: the smallest change, weighted with mass and stiffness of the bodies,
// that meets the constraints; equation (5) of step.hpp, after [GGL85].
#pragma once

#include <optional>

#include "mechanism/equations/saddle_system.hpp"
#include "mechanism/step/generalised_alpha.hpp"
#include "mechanism/step/tuning.hpp"

namespace tisserand::mechanism {

/// [W Bᵀ; B 0] with its factors and their age. Index 3 leaves it empty.
struct PositionProjection {
  void forget();
  bool has_factors() const { return step > 0.0; }

  std::optional<SaddleSystem> system;
  Eigen::VectorXd turns;   ///< boundary: 1 for rotations of bodies with mass, else 0
  Eigen::VectorXd open;    ///< rows that are still to be closed
  Eigen::VectorXd closed;  ///< rows that the latest change closes
  double step = 0.0;       ///< with which W was made; zero: there are no factors
  double age = 0.0;        ///< share of what the factors may serve that is used up
};

/// Readies [W Bᵀ; B 0] for a step from `state`, W = c_m M + c_k K of the bodies alone: made anew, at `state`, where
/// bodies have turned too far or too many steps have passed since the last one, or the step is more than twice or less
/// than half of what it was then. What decides are motions of bodies with mass and numbers of steps, no numbers of
/// iterations.
[[nodiscard]] FactorReport prepare_projection(const Model& model, const State& state, const StepScheme& scheme,
                                              Evaluation& evaluation, PositionProjection& projection);

/// correction <- d with W d + Bᵀ μ = 0 for W and Bᵀ of prepare_projection(), and B d = projection.open, about: for B of
/// then, or, where bodies have turned much since, of the last evaluate(). Internal coordinates of superelements stay.
/// All corrections of a step lie in the range of one W⁻¹Bᵀ: their sum follows from what they close, whatever the
/// iterations on the way. Nodes without mass have no weight, so that those of virtual bodies, kept or eliminated,
/// change nothing.
void project_positions(const Model& model, const StepTuning& tuning, const Evaluation& evaluation,
                       PositionProjection& projection, Eigen::VectorXd& correction);

/// Notes what an accepted step uses up.
void age_projection(const Model& model, const StepTuning& tuning, const Evaluation& evaluation,
                    PositionProjection& projection);

}  // namespace tisserand::mechanism
