// Plates, a curved shell, solids and beams on coarse meshes beside fine ones: what the estimate of the error of the
// mesh is measured with.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reducer/mesh/mesh.hpp"
#include "reducer/reduce.hpp"

namespace tisserand::reducer {

struct MeshErrorCase {
  std::string part;
  std::string element;
  std::string size;                 ///< of the coarse mesh
  std::function<Mesh(int)> mesh;    ///< n times as fine
  std::function<Mesh()> reference;  ///< whose own error is a hundredth
};

std::vector<MeshErrorCase> mesh_error_cases();

/// Steel in SI, boundary at three nodes (translations), 30 internal modes: they cost 1e-4 of the lowest frequencies.
Reduction reduction_for_mesh_errors(const Mesh& mesh);

/// Thickness 0.01 of a square plate with side 1 in one layer of first-order tetrahedra.
Mesh plate_of_single_tetrahedra(int cells);

}  // namespace tisserand::reducer
