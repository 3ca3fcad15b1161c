// SPDX-License-Identifier: GPL-3.0-or-later
// Supports and load cases of a part, resolved to nodes and elements of its mesh.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace tisserand::reducer {

/// Nodes with held components.
struct MeshSupport {
  std::string name;
  std::vector<int> nodes;       ///< ascending, each once
  std::uint8_t components = 0;  ///< Components
  bool where_present = false;   ///< rotations only of nodes that have them; otherwise all nodes must have them
  std::string where;
};

/// [force; moment] on a node, part axes.
struct NodeLoad {
  int node = 0;
  Eigen::Matrix<double, 6, 1> value = Eigen::Matrix<double, 6, 1>::Zero();
  std::string name;
};

/// Force per area against the normal of a shell.
struct ShellPressure {
  int shell = 0;
  double pressure = 0.0;
};

/// Pressure on a face of a solid: three, four, six or eight nodes, corners counter-clockwise seen from outside, then
/// the middles of the edges between them.
struct FacePressure {
  std::array<int, 8> nodes{};
  int count = 0;
  double pressure = 0.0;
};

/// Force per length of the axis, part axes.
struct BeamLineLoad {
  int beam = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

/// Force per length on an edge of a shell or solid: two ends, then the middle node if there is one.
struct EdgeLineLoad {
  std::array<int, 3> nodes{};
  int count = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

struct MeshLoadCase {
  std::string name;
  std::vector<NodeLoad> forces;
  std::vector<ShellPressure> shells;
  std::vector<FacePressure> faces;
  std::vector<BeamLineLoad> beams;
  std::vector<EdgeLineLoad> edges;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< acceleration
  std::string where;
};

}  // namespace tisserand::reducer
