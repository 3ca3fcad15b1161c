// SPDX-License-Identifier: GPL-3.0-or-later
// Spiders and equations of a mesh as linear equations between its coordinates, the input of elimination.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/math/count.hpp"
#include "reducer/mesh/coordinates.hpp"

namespace tisserand::reducer {

/// Product of a coefficient and a coordinate in an equation of a tie.
struct Term {
  int coordinate = 0;
  double coefficient = 0.0;
};

/// Equation Σ coefficient x(coordinate) = 0 of a tie.
struct LinearEquation {
  std::vector<Term> terms;
  int preferred = -1;    ///< coordinate that becomes dependent unless its coefficient is small relative to another one
  int last_resort = -1;  ///< coordinates from this number on become dependent only if no other can; −1: none
  int tie = 0;           ///< index in TieSystem::name
};

/// Equations of all ties of a mesh. Their coordinates are those of the mesh, followed by auxiliary ones. Auxiliary
/// coordinates are weighted sums over groups of nodes of an averaging spider, which keep the equations of large
/// spiders short.
struct TieSystem {
  int mesh_coordinates = 0;
  int coordinates = 0;  ///< number of all coordinates, auxiliary ones included
  std::vector<LinearEquation> equations;
  std::vector<std::string> name;   ///< name of each spider and equation: "spider 'hub'"
  std::vector<int> auxiliary_tie;  ///< index in `name` of each auxiliary coordinate
  /// Six rigid motions of each coordinate about the mean of the nodes, with rotations divided by the characteristic
  /// length l.
  std::vector<Eigen::Matrix<double, 6, 1>> rigid;
  /// Factor that scales each coordinate to a length: l for rotations, 1 otherwise.
  std::vector<double> scale;

  /// Index of the last entry of `name`.
  int last_tie() const { return count_of(name) - 1; }
  /// Adds an equation of the tie whose name is the last entry of `name`.
  void add(LinearEquation equation) {
    equation.tie = last_tie();
    equations.push_back(std::move(equation));
  }
};

/// Collects the equations of all spiders and of Mesh::equations. Throws Error for spiders that hold no node or cannot
/// define a component of their reference. It also throws for equations that stop a rigid motion of the whole part.
TieSystem collect_ties(const Mesh& mesh, const Coordinates& coordinates, const std::string& where);

/// Name of a coordinate for messages: node and component, or the group of a spider.
std::string coordinate_text(const Mesh& mesh, const Coordinates& coordinates, const TieSystem& ties, int coordinate);

}  // namespace tisserand::reducer
