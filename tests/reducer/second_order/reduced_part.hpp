// SPDX-License-Identifier: GPL-3.0-or-later
// Reduction of a mesh with its companion, as in reduce(), and load factors of buckling in the reduced coordinates.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "formats/companion/companion.hpp"
#include "formats/part/part.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::testing {

struct ReducedPart {
  formats::Superelement element;
  formats::Companion companion;
};

/// Reduced part, checked. `weights` of the floating frame, one per boundary node (none: default); `shapes` of Λ.
ReducedPart reduce_with_companion(const reducer::Mesh& mesh, const formats::ModeSelection& modes,
                                  const Eigen::VectorXd& weights = {}, int shapes = 0);

/// Reduced part with the given number of internal modes.
ReducedPart reduce_with_companion(const reducer::Mesh& mesh, int modes, const Eigen::VectorXd& weights = {},
                                  int shapes = 0);

/// Adds a node and returns its number.
int add_node(reducer::Mesh& mesh, const Eigen::Vector3d& position);

/// Adds a beam of property 0.
void add_beam(reducer::Mesh& mesh, int first, int second, const Eigen::Vector3d& orientation);

/// Adds a boundary node at `position` that leads `nodes` rigidly, and returns its number.
int add_rigid_end(reducer::Mesh& mesh, const std::string& name, const std::vector<int>& nodes,
                  const Eigen::Vector3d& position);

/// Geometric stiffness Σ w_j H_j.
Eigen::MatrixXd stress_stiffness(const formats::Companion& companion, const Eigen::VectorXd& w);

/// Columns of the identity of this size that are not among `held`.
Eigen::MatrixXd free_directions(Eigen::Index size, const std::vector<int>& held);

/// The `count` lowest positive λ, ascending, with det Zᵀ(S + λ K_G)Z = 0; ZᵀSZ positive definite.
Eigen::VectorXd buckling_factors(const Eigen::MatrixXd& S, const Eigen::MatrixXd& K_G, const Eigen::MatrixXd& Z,
                                 int count);

/// Load on a part that can move along `preloaded` under it, and buckle along Z. `own`: second-order part of the load
/// itself (none: a dead load on the boundary).
struct Preload {
  Eigen::VectorXd load;
  Eigen::MatrixXd preloaded;
  Eigen::MatrixXd own = {};
};
Eigen::VectorXd buckling_factors(const ReducedPart& part, const Preload& preload, const Eigen::MatrixXd& Z, int count);

}  // namespace tisserand::testing
