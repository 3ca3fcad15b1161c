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
  std::string size;
  std::function<Mesh()> mesh;
  std::function<Mesh()> reference;  ///< whose own error is a hundredth
};

std::vector<MeshErrorCase> mesh_error_cases();

/// Relative: smaller errors, of parts that cancel (facets make curved shells too stiff, too), have no quotient.
inline constexpr double least_compared_error = 5e-4;

/// Steel in SI, boundary at three nodes (translations), 30 internal modes: they cost 1e-4 of the lowest frequencies.
Reduction reduction_for_mesh_errors(const Mesh& mesh);

/// Relative errors of the frequencies of a coarse mesh. Modes whose order it has changed stand in that of the
/// reference, by their corrected frequencies.
struct ComparedError {
  double error = 0.0;
  double estimate = 0.0;
};
std::vector<ComparedError> compared_errors(const MeshCertificate& coarse, const std::vector<double>& exact);

/// Thickness 0.01 of a square plate with side 1 in one layer of first-order tetrahedra.
Mesh plate_of_single_tetrahedra(int cells);

}  // namespace tisserand::reducer
