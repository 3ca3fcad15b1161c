// SPDX-License-Identifier: GPL-3.0-or-later
// Distributed loads of beams as forces at their ends and nodes.
#include "reducer/elements/beam/ends.hpp"
#include "reducer/elements/beam/mesh_beam.hpp"
#include "reducer/elements/element_loads.hpp"

namespace tisserand::reducer {

using Vector12 = Eigen::Matrix<double, 12, 1>;

Vector12 beam_end_load(const Mesh& mesh, const BeamElement& beam, const BeamLoad& load) {
  const BeamElementData data = data_of(mesh, beam);
  const Eigen::Vector3d line = beam.R_PE.transpose() * load.line;
  Vector12 force = Vector12::Zero();
  if (is_rod(data))
    force.segment<3>(0) = force.segment<3>(6) = 0.5 * data.length * line;
  else if (!line.isZero(0.0))
    for (const BeamField& field : beam_fields(data))
      force += field.weight * (field.motion.topRows<3>().transpose() * line);
  if (load.gravity.isZero(0.0) && beam.released == 0) return force;
  const BeamMatrices matrices = at_the_ends(data);
  Vector12 fall = Vector12::Zero();
  fall.segment<3>(0) = fall.segment<3>(6) = beam.R_PE.transpose() * load.gravity;
  force += matrices.mass * fall;
  if (beam.released != 0) force = (release(beam.released, matrices.stiffness).T.transpose() * force).eval();
  return force;
}

Vector12 beam_node_load(const Mesh& mesh, const BeamElement& beam, const BeamLoad& load) {
  return ends_from_nodes(beam).transpose() * beam_end_load(mesh, beam, load);
}

}  // namespace tisserand::reducer
