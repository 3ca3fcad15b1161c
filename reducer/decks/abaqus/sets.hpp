// Fourth step of read_abaqus(): sets, surfaces and orientations of one scope, and what a number or a name refers to.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

/// "7" in the scope, or "wing-1.7" in the instance wing-1.
std::optional<int> find_node(const Model& model, int scope, std::string_view text);

/// A node as above, or all nodes of a set ("tip", "wing-1.tip"). Nothing, with a fault, if it does not exist or is
/// empty.
std::optional<std::vector<int>> find_nodes(Model& model, int scope, std::string_view text, const std::string& where);

/// The elements of a set or a single element. Nothing, with a fault, if it does not exist.
std::optional<std::vector<int>> find_elements(Model& model, int scope, std::string_view text, const std::string& where);

/// Nothing, with a fault, if there is none of this name.
const Surface* find_surface(Model& model, int scope, const std::string& name, const std::string& where);

/// Looks in the scope, then in the assembly. Nothing, with a fault, if there is none of this name.
const Orientation* find_orientation(Model& model, int scope, const std::string& name, const std::string& where);

/// Sorts, each once.
void unify(std::vector<int>& members);

/// Appends the nodes of all these elements.
void add_nodes_of(const Model& model, const std::vector<int>& elements, std::vector<int>& members);

/// *ELSET, then *NSET, *SURFACE, *ORIENTATION and *TRANSFORM. Instances before the assembly, which refers to them.
void read_sets(Model& model, int scope);

/// Sets for Deck: "set" for those of the assembly and of a flat deck, "instance.set" for those of instances, also
/// "set" if it is the only one of this name. Surfaces become node sets where no set has their name.
void publish_sets(Model& model);

}  // namespace tisserand::reducer::abaqus
