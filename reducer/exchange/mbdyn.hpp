// SPDX-License-Identifier: GPL-3.0-or-later
// Export of the FEM data file of MBDyn's modal joint.
#pragma once

#include <string>

#include <Eigen/Core>

#include "formats/superelement/superelement.hpp"

namespace tisserand::reducer::exchange {

/// Elastic modes of the free superelement in its mean axes.
struct ElasticModes {
  Eigen::MatrixXd shape;      ///< n x (n − 6): y = shape q
  Eigen::VectorXd mass;       ///< 1, or 0 for shapes without mass
  Eigen::VectorXd stiffness;  ///< ω², or 1
};

/// Diagonalises S̄ y = ω² M̄ y over the coordinates y with Rᵀ M̄ y = 0 (R: rigid motions; for a motion without inertia,
/// Rᵀ y = 0). With the rigid motions the modes span the whole superelement, so nothing is lost; they have no momentum.
/// Throws Error (at `where`) if the superelement has no elastic stiffness.
ElasticModes elastic_modes(const formats::Superelement& element, const std::string& where);

/// Record groups 1 to 10 and 12 of the MBDyn input manual, appendix "FEM File Format". FEM nodes are the boundary
/// nodes. Group 11 (lumped masses of FEM nodes) is omitted, since a superelement has no masses of nodes. MBDyn then
/// uses the inertia of the undeformed part for the rigid motion. Throws Error if a node has no rotations or no
/// translations, because MBDyn cannot connect it.
std::string mbdyn_text(const formats::Superelement& element, const std::string& where);

}  // namespace tisserand::reducer::exchange
