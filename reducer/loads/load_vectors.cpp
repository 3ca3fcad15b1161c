// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of the elements' consistent loads.
#include "reducer/loads/load_vectors.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/error.hpp"
#include "reducer/elements/element_loads.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// One load case on the coordinates of the mesh.
class NodalForces {
 public:
  NodalForces(const Mesh& mesh, const Coordinates& coordinates)
      : mesh_(mesh), coordinates_(coordinates), force_(Eigen::VectorXd::Zero(coordinates.count())) {}

  /// Adds [force; moment], or a force only, to a node that has these coordinates.
  void add(int node, const Eigen::Ref<const Eigen::VectorXd>& value) {
    const Index size = coordinates_.rotates(node) ? value.size() : 3;
    force_.segment(coordinates_.of(node, 0), size) += value.head(size);
  }

  void add(const MeshLoadCase& load) {
    for (const NodeLoad& force : load.forces) {
      if (!coordinates_.rotates(force.node) && !force.value.tail<3>().isZero(0.0))
        throw Error(fmt::format("load case '{}': moment of '{}' on {}, which has no rotations", load.name, force.name,
                                mesh_.node_label[force.node]),
                    load.where, "apply it to a spider that connects several nodes there");
      add(force.node, force.value);
    }
    for (const ShellPressure& pressure : load.shells) {
      const ShellElement& shell = mesh_.shells[pressure.shell];
      const Eigen::Matrix3Xd value = shell_pressure_load(mesh_, shell, pressure.pressure);
      for (int k = 0; k < shell.corners(); ++k) add(shell.nodes[k], value.col(k));
    }
    for (const FacePressure& face : load.faces) {
      const Eigen::Matrix3Xd value = face_pressure_load(mesh_, face);
      for (int k = 0; k < face.count; ++k) add(face.nodes[k], value.col(k));
    }
    for (const BeamLineLoad& line : load.beams) {
      const BeamElement& beam = mesh_.beams[line.beam];
      const Eigen::Matrix<double, 12, 1> value = beam_node_load(mesh_, beam, {line.force, Eigen::Vector3d::Zero()});
      add(beam.first, value.head<6>());
      add(beam.second, value.tail<6>());
    }
    for (const EdgeLineLoad& edge : load.edges) {
      const Eigen::Matrix3Xd value = edge_line_load(mesh_, edge);
      for (int k = 0; k < edge.count; ++k) add(edge.nodes[k], value.col(k));
    }
  }

  const Eigen::VectorXd& force() const { return force_; }

  Vector6 at(int node) const {
    Vector6 value = Vector6::Zero();
    const Index size = coordinates_.rotates(node) ? 6 : 3;
    value.head(size) = force_.segment(coordinates_.of(node, 0), size);
    return value;
  }

 private:
  const Mesh& mesh_;
  const Coordinates& coordinates_;
  Eigen::VectorXd force_;
};

[[noreturn]] void fail_lost(const Mesh& mesh, const System& system, const MeshLoadCase& load,
                            const NodalForces& nodal) {
  std::string place = "some node";
  for (const int x : system.inactive)
    if (const int node = system.coordinates.node[x]; !nodal.at(node).isZero(0.0))
      place = coordinate_name(mesh, system, x);
  throw Error(fmt::format("load case '{}': {} has neither stiffness nor mass to carry its load", load.name, place),
              load.where, "load another node or direction, or give the elements there stiffness in this direction");
}

}  // namespace

LoadVectors load_vectors(const Mesh& mesh, const System& system) {
  constexpr double negligible = 1e-9;
  const auto cases = static_cast<Index>(mesh.load_cases.size());
  LoadVectors loads{Eigen::MatrixXd::Zero(system.coordinates.count(), cases),
                    Eigen::MatrixXd::Zero(system.size(), cases), Eigen::MatrixXd::Zero(6, cases),
                    Eigen::VectorXd::Zero(cases)};
  const Eigen::MatrixXd R = rigid_motions_about(system, Eigen::Vector3d::Zero());
  for (Index c = 0; c < cases; ++c) {
    const MeshLoadCase& load = mesh.load_cases[c];
    NodalForces nodal(mesh, system.coordinates);
    nodal.add(load);
    Vector6 resultant = Vector6::Zero();
    for (int node = 0; node < mesh.nodes(); ++node) {
      const Vector6 value = nodal.at(node);
      const Eigen::Vector3d force = value.head<3>();
      resultant.head<3>() += force;
      resultant.tail<3>() += value.tail<3>() + Eigen::Vector3d(mesh.position.col(node)).cross(force);
      loads.size[c] += force.norm() + value.tail<3>().norm() / system.length;
    }
    loads.x.col(c) = nodal.force();
    loads.q.col(c) = gather(system.T, nodal.force());
    loads.applied.col(c) = R.transpose() * loads.q.col(c);
    const double far = system.length + system.middle.norm();
    const Vector6 lost = loads.applied.col(c) - resultant;  // share on coordinates without stiffness and mass
    if (lost.head<3>().norm() + lost.tail<3>().norm() / far > negligible * loads.size[c])
      fail_lost(mesh, system, load, nodal);
    if (load.gravity.isZero(0.0)) continue;
    const Eigen::VectorXd weight = system.MR.leftCols<3>() * load.gravity;
    loads.q.col(c) += weight;
    const Vector6 weight_resultant = R.transpose() * weight;
    loads.applied.col(c) += weight_resultant;
    loads.size[c] += weight_resultant.head<3>().norm();
  }
  return loads;
}

}  // namespace tisserand::reducer
