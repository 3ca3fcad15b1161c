// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of a model: sets of nodes that would move together if every flexible body were rigid.
#pragma once

#include <string>
#include <vector>

#include "common/math/count.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

struct Parts {
  std::vector<int> of_node;       ///< part of each node
  std::vector<std::string> name;  ///< name of the body
  std::vector<int> first_node;    ///< one node of each part; its place is the origin of the part
  std::vector<double> mass;       ///< 0: massless
  int count() const { return count_of(name); }
  bool is_massless(int node) const { return mass[of_node[node]] == 0.0; }
};

/// Parts of the model: one per superelement, rigid body, nonlinear beam (elements that share nodes) and massless node.
Parts find_parts(const Model& model);

/// Groups of names of parts that joints, springs and couplings connect, directly or through others. One group contains
/// the ground.
std::vector<std::vector<std::string>> connected_groups(const Model& model, const Parts& parts);

}  // namespace tisserand::mechanism
