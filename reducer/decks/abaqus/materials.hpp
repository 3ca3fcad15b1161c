// SPDX-License-Identifier: GPL-3.0-or-later
// *MATERIAL with *ELASTIC and *DENSITY, and the material data of sections.
#pragma once

#include "reducer/decks/abaqus/model.hpp"
#include "reducer/properties/laminate.hpp"

namespace tisserand::reducer::abaqus {

/// Fills Model::materials from the blocks of the assembly.
void read_materials(Model& model);

/// Material by name; null, with a fault, if it does not exist or is not elastic.
const AbaqusMaterial* find_material(Model& model, const std::string& name, const std::string& where);
/// Material that the block's parameter MATERIAL names.
const AbaqusMaterial* find_material(Model& model, const Block& block);

/// Layer of this material with thickness and angle 0. Orthotropic materials are in plane stress: σ33 = 0.
Ply ply_of(const AbaqusMaterial& material);

/// C in part axes; R_PM has the material axes as columns. Throws Error for constants that are not positive definite.
/// The material must not be a lamina (check before).
SolidMaterial solid_of(const AbaqusMaterial& material, const Eigen::Matrix3d& R_PM);

}  // namespace tisserand::reducer::abaqus
