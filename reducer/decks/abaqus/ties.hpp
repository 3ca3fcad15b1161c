// SPDX-License-Identifier: GPL-3.0-or-later
// Seventh step of read_abaqus(): couplings, rigid bodies, MPCs and equations become spiders and equations of the mesh.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

/// Reads *COUPLING with *KINEMATIC or *DISTRIBUTING, *KINEMATIC COUPLING, *RIGID BODY, *MPC, *EQUATION of a scope.
void read_ties(Model& model, int scope);

/// Reads *EQUATION, for read_ties().
void read_equation(Model& model, int scope, const Block& block);

/// Components first to last (1-6) of a data line from `field` on. Without last it is first; without first it is all
/// six. Empty, with a fault, for anything else.
std::optional<Components> read_components(Model& model, const Line& line, std::size_t field);

/// One node by number or by a set of one node. Empty, with a fault, otherwise.
std::optional<int> find_one_node(Model& model, int scope, std::string_view text, const std::string& where);

}  // namespace tisserand::reducer::abaqus
