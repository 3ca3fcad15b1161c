// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of a model, groups of parts that are connected, and closed loops of joints.
#pragma once

#include <string>
#include <vector>

#include "common/math/count.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Parts of a model: sets of nodes that would move together if every flexible body were rigid. Lists have one entry
/// per part unless stated.
struct Parts {
  std::vector<int> of_node;       ///< per node of the model: index of its part
  std::vector<std::string> name;  ///< name of the body of each part
  std::vector<int> first_node;    ///< one node of each part, the origin of the part
  std::vector<double> mass;       ///< mass of each part; 0: massless
  int count() const { return count_of(name); }
  bool is_massless(int node) const { return mass[of_node[node]] == 0.0; }
};

/// Finds the parts of the model: one per superelement, rigid body, nonlinear beam (elements that share nodes) and
/// massless node.
Parts find_parts(const Model& model);

/// Groups of parts, by name, that joints, springs and couplings connect, directly or through other parts. One group
/// contains the ground.
std::vector<std::vector<std::string>> connected_groups(const Model& model, const Parts& parts);

/// Finds the loops of the model: the biconnected components of the graph of its nodes and the ground, with joints as
/// edges. Joints on one modal body share its modes, and all terms of a coupling share a multiplier, so each of these
/// sets is in one loop. Requires the maps of joints and couplings.
std::vector<Loop> find_loops(const Model& model);

}  // namespace tisserand::mechanism
