// Bodies that constraints can stress though no load acts: their flexibility decides reactions.
#pragma once

#include <vector>

#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// Marks bodies that deform (deformation.hpp) and that reactions alone can stress: λ exists that is in balance on every
/// body taken as a rigid one and deforms this one. With the motions T of rigid bodies, Tᵀ Bᵀ λ = 0 and Bᵀ λ ≠ 0 on the
/// body.
///
/// Equations of rigid bodies leave the size of such a λ open. Where it does work on a drive or on the gap of a loop,
/// rigid bodies cannot move either: a four-bar with one axis out of line moves only because its bodies deform. These λ
/// are as many as there are rows beyond the rank of Tᵀ Bᵀ. So a loop of hinges has them whether its axes are parallel,
/// nearly parallel or not, and no round-off decides.
///
/// After evaluate(). λ is one random vector without its part along the rows, which has a part along every such λ.
std::vector<bool> stressed_by_constraints(const Model& model, const Evaluation& now);

}  // namespace tisserand::mechanism
