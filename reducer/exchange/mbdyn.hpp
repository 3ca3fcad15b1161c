// SPDX-License-Identifier: GPL-3.0-or-later
// Export of the FEM data file of MBDyn's modal joint.
#pragma once

#include <string>

#include <Eigen/Core>

#include "formats/superelement/superelement.hpp"

namespace tisserand::reducer::exchange {

/// Elastic modes of a free superelement of n coordinates in its mean axes, with amplitudes q.
struct ElasticModes {
  Eigen::MatrixXd shape;      ///< n x (n − 6): coordinates y = shape q
  Eigen::VectorXd mass;       ///< modal mass: 1, or 0 for shapes without mass
  Eigen::VectorXd stiffness;  ///< modal stiffness: ω², or 1 for shapes without mass
};

/// Computes the elastic modes S̄ y = ω² M̄ y of a free superelement over the coordinates y with Rᵀ M̄ y = 0. R are the
/// rigid motions; for a motion without inertia the condition is Rᵀ y = 0. So the modes have no momentum. Together with
/// the rigid motions they span all motions of the superelement, so nothing is lost. Throws Error (at `where`) if the
/// superelement has no elastic stiffness.
ElasticModes elastic_modes(const formats::Superelement& element, const std::string& where);

/// FEM data file of the modal joint of MBDyn: record groups 1 to 10 and 12 of its input manual, appendix "FEM File
/// Format". The FEM nodes are the boundary nodes. Group 11 (lumped masses of FEM nodes) is omitted, since a
/// superelement has no masses of nodes. MBDyn then uses the inertia of the undeformed part for the rigid motion.
/// Throws Error if a node has no rotations or no translations, because MBDyn cannot connect it.
std::string mbdyn_text(const formats::Superelement& element, const std::string& where);

}  // namespace tisserand::reducer::exchange
