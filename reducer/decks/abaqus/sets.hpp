// SPDX-License-Identifier: GPL-3.0-or-later
// Fourth step of read_abaqus(): sets, surfaces and orientations of one scope, and resolution of numbers and names.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

/// Finds a node: "7" in the scope, or "wing-1.7" in the instance wing-1. Returns nothing if it does not exist.
std::optional<int> find_node(const Model& model, int scope, std::string_view text);

/// Finds a node ("7", "wing-1.7"), or all nodes of a set ("tip", "wing-1.tip"). Returns nothing, after a fault, if it
/// does not exist or has no nodes. `where`: place for the message.
std::optional<std::vector<int>> find_nodes(Model& model, int scope, std::string_view text, const std::string& where);

/// Finds the elements of a set, or a single element. Returns nothing, after a fault, if it does not exist. `where`:
/// place for the message.
std::optional<std::vector<int>> find_elements(Model& model, int scope, std::string_view text, const std::string& where);

/// Finds the surface with this name; null after a fault, if there is none. `where`: place for the message.
const Surface* find_surface(Model& model, int scope, const std::string& name, const std::string& where);

/// Finds the orientation with this name in the scope, then in the assembly; null after a fault, if there is none.
/// `where`: place for the message.
const Orientation* find_orientation(Model& model, int scope, const std::string& name, const std::string& where);

/// Sorts the members and removes duplicates.
void unify(std::vector<int>& members);

/// Appends the nodes of all `elements` to `members`.
void add_nodes_of(const Model& model, const std::vector<int>& elements, std::vector<int>& members);

/// Reads *ELSET, then *NSET, *SURFACE, *ORIENTATION and *TRANSFORM of a scope. Must be called for all instances before
/// the assembly.
void read_sets(Model& model, int scope);

/// Adds the sets of all scopes to Deck. A set of the assembly or of a deck without parts keeps its name. A set of an
/// instance is "instance.set", and also "set" if this name is unique. Surfaces become node sets if no set has their
/// name.
void publish_sets(Model& model);

}  // namespace tisserand::reducer::abaqus
