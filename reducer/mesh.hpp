// The finite element model of a part: plain nodes, beam elements and masses, between meshing and assembly.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/part.hpp"
#include "reducer/elements/beam.hpp"

namespace tisserand::reducer {

/// Two nodes, the axes R_PE (columns: element x, y, z in part axes) and the element's data without its length.
struct BeamElement {
  int first = 0;
  int second = 0;
  Eigen::Matrix3d R_PE = Eigen::Matrix3d::Identity();
  int property = 0;  ///< row of Mesh::properties
};

/// What all elements of one line share; `length` is that of each of its equal elements (the chord, on an arc).
struct BeamProperty {
  BeamElementData data;
  std::string line;
};

struct NodalMass {
  int node = 0;
  double mass = 0.0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the node, part axes
};

/// A node that other bodies will see; the components that are not retained stay internal.
struct MeshBoundary {
  std::string name;
  int node = 0;
  bool translations = true;
  bool rotations = true;
};

struct Mesh {
  Eigen::Matrix3Xd position;            ///< part frame
  std::vector<std::string> node_label;  ///< for messages: "tip" or "spar[3]", the third inner node of line spar
  std::vector<BeamProperty> properties;
  std::vector<BeamElement> beams;
  std::vector<NodalMass> masses;
  std::vector<MeshBoundary> boundary;

  int nodes() const { return static_cast<int>(position.cols()); }
  int dofs() const { return 6 * nodes(); }
};

/// l = largest distance of a node from the mean of the nodes (1 if 0): the length with which rotations are scaled.
double characteristic_length(const Mesh& mesh);

/// The six rigid motions of the mesh (dofs x 6): unit translations, then (e_k × X_a, e_k) about the part origin.
Eigen::MatrixXd rigid_motions(const Mesh& mesh);

/// Throws Error naming the pieces, and the nearest pair of nodes between them, unless the elements form one piece.
void check_connected(const Mesh& mesh, const std::string& where);

/// Throws Error naming the free motions if the retained boundary coordinates leave a rigid motion of the part free.
void check_boundary_holds(const Mesh& mesh, const std::string& where);

}  // namespace tisserand::reducer
