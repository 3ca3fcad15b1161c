// SPDX-License-Identifier: GPL-3.0-or-later
// Fifth step of read_abaqus(): section keywords of one scope become properties of the mesh and of its elements.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

/// Reads the section keywords of a scope: *SHELL SECTION, *SOLID SECTION, *BEAM SECTION, *BEAM GENERAL SECTION, *MASS,
/// *ROTARY INERTIA and *SPRING.
void read_sections(Model& model, int scope);

/// Reads *BEAM SECTION or *BEAM GENERAL SECTION, the block with the index `index` of the scope. Blocks after it may
/// belong to it.
void read_beam_section(Model& model, int scope, std::size_t index);

/// Directions of an orientation for a shell: the axis that is near to the normal, and the axis whose projection is the
/// material x.
struct Projection {
  Eigen::Vector3d normal;
  Eigen::Vector3d x;
};
/// Directions of `orientation` for a shell. Throws Error if it is not rectangular or has no second data line. `name`:
/// name of the orientation for the message.
Projection projection_of(const Orientation& orientation, std::string_view name);

/// Layers of *SHELL SECTION, COMPOSITE. Their angles count from the direction `x`, which is zero without an
/// orientation.
struct Layers {
  std::vector<Ply> plies;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
};
/// Reads the layers of *SHELL SECTION, COMPOSITE. Returns nothing, after faults, if a layer is faulty. Throws Error
/// for orientations that cannot be used.
std::optional<Layers> read_layers(Model& model, int scope, const Block& block);

/// Appends the section `use` to the model, and assigns it to those elements of the set of `block` that are of its
/// kind. Adds faults for elements of other kinds and for elements with two sections.
void give_section(Model& model, int scope, const Block& block, const SectionUse& use);

/// Number in the field `field` of the data line `line` of `block`. Returns nothing, after a fault, if it is absent or
/// no number. `meaning`: name of the quantity for the message.
std::optional<double> number_at(Model& model, const Block& block, std::size_t line, std::size_t field,
                                std::string_view meaning);

}  // namespace tisserand::reducer::abaqus
