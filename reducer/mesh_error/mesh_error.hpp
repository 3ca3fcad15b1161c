// SPDX-License-Identifier: GPL-3.0-or-later
// Discretisation error, which more modes cannot reduce: estimate for the lowest frequencies, from stresses that jump
// between elements.
#pragma once

#include <string>
#include <vector>

#include "reducer/mesh_error/doubts.hpp"
#include "reducer/modes/free_motions.hpp"

namespace tisserand::reducer {

/// Estimated discretisation errors of the lowest modes of FreeMotions.
struct MeshErrors {
  bool boundary_held = false;
  Eigen::VectorXd lambda;    ///< ω² of the modes, ascending
  Eigen::VectorXd relative;  ///< estimate of (f_h − f)/f, f without discretisation error; at most 1
  /// Contribution of beams, shells and solids (rows) to (λ_h − λ)/λ_h of each mode (3 x modes).
  Eigen::Matrix3Xd by_kind;
  std::vector<std::string> place;  ///< for each mode: name of the property whose elements cause most of the error
  MeshDoubts doubts;               ///< reasons why `relative` is not known within a factor of two
};

/// Estimates the discretisation errors of at most `most` modes. With smooth stresses σ* the continuous part has λ ≈
/// HR(σ*, u)/M(u) of THEORY (92), whose error is the product of the errors of σ* and u. So THEORY (93) gives λ_h − λ ≈
/// Σ energy_error() over the elements for uᵀ M u = 1, and (f_h − f)/f = √(λ_h/λ) − 1. Springs, masses, spiders and
/// equations have no error of this kind. The estimate does not include stress concentrations at edges of spiders, nor
/// flat faces of solids on curved surfaces.
MeshErrors mesh_errors(const Mesh& mesh, const System& system, const FreeMotions& modes, int most);

}  // namespace tisserand::reducer
