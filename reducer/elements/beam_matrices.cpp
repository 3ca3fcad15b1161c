// Matrices of a beam element of the mesh about its nodes, in part axes: what assembly asks for.
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {

void element_matrices(const Mesh& mesh, const BeamElement& beam, ElementMatrices& out) {
  BeamElementData data = mesh.beam_properties[static_cast<std::size_t>(beam.property)].data;
  data.length = (mesh.position.col(beam.second) - mesh.position.col(beam.first)).norm();
  out.S = to_part_axes(beam_stiffness(data), beam.R_PE);
  out.M = to_part_axes(beam_mass(data), beam.R_PE);
}

}  // namespace tisserand::reducer
