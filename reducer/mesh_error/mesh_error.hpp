// SPDX-License-Identifier: GPL-3.0-or-later
// Discretisation error, which more modes cannot reduce: estimate for the lowest frequencies, from stresses that jump
// between elements.
#pragma once

#include <string>
#include <vector>

#include "reducer/mesh_error/doubts.hpp"
#include "reducer/modes/free_motions.hpp"

namespace tisserand::reducer {

/// Estimated errors of the lowest modes of FreeMotions.
struct MeshErrors {
  bool boundary_held = false;
  Eigen::VectorXd lambda;    ///< ω²
  Eigen::VectorXd relative;  ///< estimate of (f_h − f)/f: positive if the frequency is too high; at most 1
  /// Share of beams, shells, solids in λ_h − λ, relative to λ_h: 3 x modes.
  Eigen::Matrix3Xd by_kind;
  std::vector<std::string> place;  ///< per mode: the property whose elements cause most of it
  MeshDoubts doubts;               ///< shows where `relative` is not known within a factor of two
};

/// Estimates for at most `most` modes. With smooth stresses σ* the continuous part has λ ≈ HR(σ*, u)/M(u)
/// (energy_error() of the elements), THEORY (92), whose error is the product of those of σ* and u. So THEORY (93), λ_h
/// − λ ≈ Σ energy_error for uᵀ M u = 1, and (f_h − f)/f = √(λ_h/λ) − 1. Springs, masses, spiders and equations have no
/// such error. The estimate does not include stress concentrations at edges of spiders, nor flat faces of solids on
/// curved surfaces.
MeshErrors mesh_errors(const Mesh& mesh, const System& system, const FreeMotions& modes, int most);

}  // namespace tisserand::reducer
