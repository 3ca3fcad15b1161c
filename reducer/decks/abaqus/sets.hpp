// SPDX-License-Identifier: GPL-3.0-or-later
// Fourth step of read_abaqus(): sets, surfaces and orientations of one scope, and resolution of numbers and names.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

/// Node "7" in the scope, or "wing-1.7" in the instance wing-1.
std::optional<int> find_node(const Model& model, int scope, std::string_view text);

/// A node as above, or all nodes of a set ("tip", "wing-1.tip"). Empty, with a fault, if it does not exist or has no
/// nodes.
std::optional<std::vector<int>> find_nodes(Model& model, int scope, std::string_view text, const std::string& where);

/// Elements of a set, or a single element. Empty, with a fault, if it does not exist.
std::optional<std::vector<int>> find_elements(Model& model, int scope, std::string_view text, const std::string& where);

/// Surface of this name; null, with a fault, if there is none.
const Surface* find_surface(Model& model, int scope, const std::string& name, const std::string& where);

/// Orientation in the scope, then in the assembly. Null, with a fault, if there is none of this name.
const Orientation* find_orientation(Model& model, int scope, const std::string& name, const std::string& where);

/// Sorts the members and removes duplicates.
void unify(std::vector<int>& members);

/// Appends the nodes of all these elements.
void add_nodes_of(const Model& model, const std::vector<int>& elements, std::vector<int>& members);

/// Reads *ELSET, then *NSET, *SURFACE, *ORIENTATION and *TRANSFORM. Instances must precede the assembly.
void read_sets(Model& model, int scope);

/// Adds sets to Deck: "set" for those of the assembly and of a flat deck, "instance.set" for those of instances, also
/// "set" if the name is unique. Surfaces become node sets if no set has their name.
void publish_sets(Model& model);

}  // namespace tisserand::reducer::abaqus
