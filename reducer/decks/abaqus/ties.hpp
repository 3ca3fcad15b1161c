// SPDX-License-Identifier: GPL-3.0-or-later
// Seventh step of read_abaqus(): couplings, rigid bodies, MPCs and equations become spiders and equations of the mesh.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

/// Reads the constraints of a scope into the mesh: *COUPLING with *KINEMATIC or *DISTRIBUTING, *KINEMATIC COUPLING,
/// *RIGID BODY, *MPC and *EQUATION.
void read_ties(Model& model, int scope);

/// Reads *EQUATION, for read_ties().
void read_equation(Model& model, int scope, const Block& block);

/// Components from the first to the last (1 to 6) that a data line gives in the fields `field` and `field` + 1.
/// Without the last it is the first only; without both it is all six. Returns nothing, after a fault, for anything
/// else.
std::optional<Components> read_components(Model& model, const Line& line, std::size_t field);

/// Finds one node by its number or by a set of one node. Returns nothing, after a fault, otherwise. `where`: place for
/// the message.
std::optional<int> find_one_node(Model& model, int scope, std::string_view text, const std::string& where);

}  // namespace tisserand::reducer::abaqus
