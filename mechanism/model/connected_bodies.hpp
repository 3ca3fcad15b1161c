// Rigid parts of a model: which nodes would move together if every flexible body were rigid.
#pragma once

#include <string>
#include <vector>

#include "common/math/count.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

struct Parts {
  std::vector<int> of_node;       ///< part of each node
  std::vector<std::string> name;  ///< of the body
  std::vector<int> first_node;    ///< one node of each, whose place is the part's origin
  std::vector<double> mass;       ///< 0: a body without mass
  int count() const { return count_of(name); }
  bool is_massless(int node) const { return mass[of_node[node]] == 0.0; }
};

/// One part per superelement, rigid body, nonlinear beam (elements that share nodes) and massless node.
Parts find_parts(const Model& model);

/// Parts that joints, springs and couplings connect with each other, directly or through others, by name; the ground is
/// one of them.
std::vector<std::vector<std::string>> connected_groups(const Model& model, const Parts& parts);

}  // namespace tisserand::mechanism
