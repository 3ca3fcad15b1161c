// SPDX-License-Identifier: GPL-3.0-or-later
// Mass points of a beam and their motion with the nodes, through releases and rigid arms.
#include "common/math/rotation.hpp"
#include "reducer/elements/beam/ends.hpp"
#include "reducer/elements/beam/mesh_beam.hpp"
#include "reducer/elements/second_order.hpp"
#include "reducer/elements/turning_mass.hpp"

namespace tisserand::reducer {

MovingMass moving_mass(const Mesh& mesh, const BeamElement& beam) {
  const BeamElementData data = data_of(mesh, beam);
  MovingMass moving;
  moving.coordinates = 12;
  moving.nodes.resize(3, 2);
  moving.nodes << mesh.position.col(beam.first), mesh.position.col(beam.second);
  moving.arms.resize(3, 2);
  moving.arms << beam.first_offset, beam.second_offset;
  const Matrix12 arms = ends_from_nodes(beam);
  Matrix12 ends = arms;
  if (beam.released != 0) ends = release(beam.released, at_the_ends(data).stiffness).T * arms;
  const Eigen::Vector3d length(data.length, 0.0, 0.0), start = moving.nodes.col(0) + moving.arms.col(0);
  moving.turn = beam.R_PE * turn_of_pair(length) * arms;
  for (const BeamMassPoint& from : beam_mass_points(data)) {
    const Eigen::Matrix<double, 6, 12> motion = from.motion * ends;
    MassPoint point;
    point.displacement = beam.R_PE * motion.topRows<3>();
    point.rotation = beam.R_PE * motion.bottomRows<3>();
    point.at = start + from.x * beam.R_PE.col(0);
    point.mass = from.mass(0, 0);
    Eigen::Matrix3d inertia = from.mass.bottomRightCorner<3, 3>();
    if (point.mass != 0.0) {  // mass matrix of the point: [m 1, −m c~; m c~, J − m c~ c~]
      const Eigen::Vector3d c = Eigen::Vector3d(from.mass(5, 1), from.mass(3, 2), from.mass(4, 0)) / point.mass;
      point.centre = beam.R_PE * c;
      inertia += point.mass * skew<double>(c) * skew<double>(c);
    }
    point.inertia = beam.R_PE * (0.5 * (inertia + inertia.transpose())) * beam.R_PE.transpose();
    moving.rotary.push_back({point.inertia, point.rotation});
    moving.points.push_back(point);
  }
  return moving;
}

}  // namespace tisserand::reducer
