// SPDX-License-Identifier: GPL-3.0-or-later
// Supports and load cases of a part, resolved to nodes and elements of its mesh.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace tisserand::reducer {

/// Support of a part: nodes with components that it holds.
struct MeshSupport {
  std::string name;
  std::vector<int> nodes;       ///< ascending, each once
  std::uint8_t components = 0;  ///< held components, see Components
  bool where_present = false;   ///< true: holds rotations only of nodes that have them; false: all nodes must have them
  std::string where;
};

/// Load [force; moment] on a node, in part axes.
struct NodeLoad {
  int node = 0;
  Eigen::Matrix<double, 6, 1> value = Eigen::Matrix<double, 6, 1>::Zero();
  std::string name;
};

/// Pressure on a shell: force per area, opposite to the normal of the shell.
struct ShellPressure {
  int shell = 0;
  double pressure = 0.0;
};

/// Pressure on a face of a solid, positive into the solid. The face has three, four, six or eight nodes: corners
/// counter-clockwise seen from outside, then the middles of the edges between them.
struct FacePressure {
  std::array<int, 8> nodes{};
  int count = 0;
  double pressure = 0.0;
};

/// Load on a beam: force per length of its axis, in part axes.
struct BeamLineLoad {
  int beam = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

/// Load on an edge of a shell or solid: force per length. Its nodes are the two ends, then the middle node if there is
/// one.
struct EdgeLineLoad {
  std::array<int, 3> nodes{};
  int count = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

/// Load case on a mesh: forces, pressures, line loads and gravity that act together.
struct MeshLoadCase {
  std::string name;
  std::vector<NodeLoad> forces;
  std::vector<ShellPressure> shells;
  std::vector<FacePressure> faces;
  std::vector<BeamLineLoad> beams;
  std::vector<EdgeLineLoad> edges;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< acceleration of gravity
  std::string where;
};

}  // namespace tisserand::reducer
