// *MATERIAL with *ELASTIC and *DENSITY, and what sections need of them.
#pragma once

#include "reducer/decks/abaqus/model.hpp"
#include "reducer/properties/laminate.hpp"

namespace tisserand::reducer::abaqus {

/// Fills Model::materials from the blocks of the assembly.
void read_materials(Model& model);

/// Nothing, with a fault, if it does not exist or is not elastic.
const AbaqusMaterial* find_material(Model& model, const std::string& name, const std::string& where);
/// Finds the material that the block's parameter MATERIAL names.
const AbaqusMaterial* find_material(Model& model, const Block& block);

/// Layer of this material, thickness and angle left 0. Orthotropic materials in plane stress: σ33 = 0.
Ply ply_of(const AbaqusMaterial& material);

/// C in part axes, the material axes in the columns of R_PM. Throws Error for constants that are not positive definite;
/// lamina is none (find out before).
SolidMaterial solid_of(const AbaqusMaterial& material, const Eigen::Matrix3d& R_PM);

}  // namespace tisserand::reducer::abaqus
