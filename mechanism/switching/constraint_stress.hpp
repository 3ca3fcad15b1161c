// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies that constraints can stress without loads. Their flexibility decides reactions.
#pragma once

#include <vector>

#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// Flags of the deforming bodies (deformation.hpp) that reactions can stress without any load. A body gets this flag if
/// there are multipliers λ that are in balance on every body taken as rigid, and that deform this body. With the
/// motions T of rigid bodies, Tᵀ Bᵀ λ = 0 and Bᵀ λ ≠ 0 on the body. Requires evaluate().
///
/// Rigid bodies do not determine the size of such a λ. If λ does work on a drive or on the gap of a loop, rigid bodies
/// cannot move. A four-bar with one axis out of line moves only because its bodies deform. There are as many
/// independent λ as rows beyond the rank of Tᵀ Bᵀ. A loop of hinges has them for any axes, parallel or not, independent
/// of round-off. The function tests one random vector without its component along the rows, which has a component along
/// every such λ.
std::vector<bool> stressed_by_constraints(const Model& model, const Evaluation& now);

}  // namespace tisserand::mechanism
