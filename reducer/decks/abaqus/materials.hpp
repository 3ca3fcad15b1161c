// SPDX-License-Identifier: GPL-3.0-or-later
// *MATERIAL with *ELASTIC and *DENSITY, and the material data of sections.
#pragma once

#include "reducer/decks/abaqus/model.hpp"
#include "reducer/properties/laminate.hpp"

namespace tisserand::reducer::abaqus {

/// Reads *MATERIAL of the assembly into Model::materials.
void read_materials(Model& model);

/// Material by its name; null after a fault, if it does not exist or is not elastic. `where`: place for the message.
const AbaqusMaterial* find_material(Model& model, const std::string& name, const std::string& where);
/// Material that the parameter MATERIAL of `block` names; null after a fault.
const AbaqusMaterial* find_material(Model& model, const Block& block);

/// Layer of `material` with thickness and angle 0. Orthotropic materials are reduced to plane stress, σ33 = 0.
Ply ply_of(const AbaqusMaterial& material);

/// Elasticity and density of `material` for solids, in part axes. The columns of `R_PM` are the material axes in part
/// axes. Throws Error for constants that are not positive definite. Requires a material that is no lamina.
SolidMaterial solid_of(const AbaqusMaterial& material, const Eigen::Matrix3d& R_PM);

}  // namespace tisserand::reducer::abaqus
