// SPDX-License-Identifier: GPL-3.0-or-later
// Fifth step of read_abaqus(): section keywords of one scope become properties of the mesh and of its elements.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

/// Reads *SHELL SECTION, *SOLID SECTION, *BEAM SECTION, *BEAM GENERAL SECTION, *MASS, *ROTARY INERTIA, *SPRING.
void read_sections(Model& model, int scope);

/// Reads *BEAM SECTION or *BEAM GENERAL SECTION, the block at `index` of the scope; the next blocks may belong to it.
void read_beam_section(Model& model, int scope, std::size_t index);

/// Axis near the normal and projected axis of an orientation. Throws Error if it has no second data line.
struct Projection {
  Eigen::Vector3d normal;
  Eigen::Vector3d x;
};
Projection projection_of(const Orientation& orientation, std::string_view name);

/// Layers of *SHELL SECTION, COMPOSITE, with angles from `x`, which is zero without orientations.
struct Layers {
  std::vector<Ply> plies;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
};
/// Layers of a section; empty, with faults, if a layer is faulty. Throws Error for orientations that cannot be used.
std::optional<Layers> read_layers(Model& model, int scope, const Block& block);

/// Appends the section and assigns it to the elements of its set that are of its kind. Adds faults for elements of
/// other kinds and those with two sections.
void give_section(Model& model, int scope, const Block& block, const SectionUse& use);

/// Number in a field of a data line; empty, with a fault, if it is absent or no number.
std::optional<double> number_at(Model& model, const Block& block, std::size_t line, std::size_t field,
                                std::string_view meaning);

}  // namespace tisserand::reducer::abaqus
