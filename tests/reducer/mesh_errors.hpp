// Parts on coarse meshes beside fine ones: what the estimate of the error of the mesh is measured with.
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

/// Beams of solids, one to eight across, plates, discs, cylinders, a panel, tubes, blocks.
std::vector<MeshErrorCase> mesh_error_cases();

/// Relative: errors and estimates below have no quotient.
inline constexpr double least_compared_error = 1.5e-3;

/// Free elastic modes of a mesh.
struct FreeShapes {
  Mesh mesh;
  Eigen::VectorXd frequency;
  Eigen::MatrixXd translation;  ///< 3 rows per node
  MeshErrors estimate;          ///< of the five lowest
};
FreeShapes free_shapes(const Mesh& mesh, int modes);

/// Of one of the five lowest modes of a coarse mesh: the error of its frequency against that of the mode of the
/// reference whose shape is most like its own, the estimate, and whether that is said to be known.
struct ComparedError {
  double error = 0.0;
  double estimate = 0.0;
  MeshDoubt doubt = MeshDoubt::none;

  bool compared() const {
    return doubt == MeshDoubt::none && std::max(std::abs(error), std::abs(estimate)) >= least_compared_error;
  }
};
std::vector<ComparedError> compared_errors(const FreeShapes& coarse, const FreeShapes& reference);

/// Steel in SI, boundary at three nodes (translations), 30 internal modes.
Reduction reduction_for_mesh_errors(const Mesh& mesh);

/// Thickness 0.01 of a square plate with side 1 in one layer of first-order tetrahedra.
Mesh plate_of_single_tetrahedra(int cells);

}  // namespace tisserand::reducer
