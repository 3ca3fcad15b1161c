// SPDX-License-Identifier: GPL-3.0-or-later
// Parts with coarse and fine meshes, on which the estimate of the discretisation error is measured.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"
#include "reducer/mesh_error/mesh_error.hpp"
#include "reducer/reduce.hpp"

namespace tisserand::reducer {

/// A coarse mesh and a fine one of the same part. Cases of one `part` follow each other and have the same reference.
struct MeshErrorCase {
  std::string part;
  std::string element;
  std::string size;
  std::function<Mesh()> mesh;
  std::function<Mesh()> reference;
};

/// Cases: beams of solids, one to eight across, plates, discs, cylinders, a panel, tubes, blocks.
std::vector<MeshErrorCase> mesh_error_cases();

/// Relative limit: if error and estimate are both smaller, their quotient is not compared.
inline constexpr double least_compared_error = 1.5e-3;

/// Free elastic modes of a mesh.
struct MeshModes {
  Mesh mesh;
  Eigen::VectorXd frequency;
  Eigen::MatrixXd translation;  ///< 3 rows per node
  MeshErrors estimate;          ///< of the five lowest modes
};
MeshModes free_shapes(const Mesh& mesh, int modes);

/// Error of the frequency of one of the five lowest modes of a coarse mesh, against the mode of the reference with the
/// most similar shape. `doubt` says whether the estimate is known.
struct ComparedError {
  double error = 0.0;
  double estimate = 0.0;
  MeshDoubt doubt = MeshDoubt::none;

  bool compared() const {
    return doubt == MeshDoubt::none && std::max(std::abs(error), std::abs(estimate)) >= least_compared_error;
  }
};
std::vector<ComparedError> compared_errors(const MeshModes& coarse, const MeshModes& reference);

/// Reduction of a mesh in SI units, which has its boundary, with 30 internal modes.
Reduction reduction_for_mesh_errors(const Mesh& mesh);

/// Square plate of side 1 and thickness 0.01, one layer of first-order tetrahedra.
Mesh plate_of_single_tetrahedra(int cells);

}  // namespace tisserand::reducer
