// SPDX-License-Identifier: GPL-3.0-or-later
// Blocks of solid elements, distorted or not.
#include "tests/support/meshes/solid_mesh.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <utility>

namespace tisserand::reducer {

std::string solid_name(SolidShape shape) {
  return std::array<const char*, 6>{
      "tetrahedron4", "tetrahedron10", "hexahedron8", "hexahedron20", "prism6", "prism15"}[static_cast<int>(shape)];
}

bool is_quadratic(SolidShape shape) {
  return shape == SolidShape::tetrahedron10 || shape == SolidShape::hexahedron20 || shape == SolidShape::prism15;
}

Eigen::Matrix3Xd natural_nodes(SolidShape shape) {
  return with_shape(shape, []<SolidShape s>() {
    Eigen::Matrix3Xd points(3, SolidBasis<s>::nodes.size());
    for (std::size_t a = 0; a < SolidBasis<s>::nodes.size(); ++a)
      points.col(a) = Eigen::Vector3d::Map(SolidBasis<s>::nodes[a].data());
    return points;
  });
}

Mesh one_solid(SolidShape shape, const Eigen::Matrix3Xd& position, const SolidProperty& property) {
  Mesh mesh;
  mesh.position = position;
  mesh.solid_properties = {property};
  SolidElement element;
  element.shape = shape;
  for (Eigen::Index a = 0; a < position.cols(); ++a) {
    element.nodes[a] = static_cast<int>(a);
    mesh.node_label.push_back("node " + std::to_string(a + 1));
  }
  mesh.solids = {element};
  return mesh;
}

std::vector<std::vector<int>> cell_elements(SolidShape shape, const std::array<int, 8>& h) {
  if (shape == SolidShape::hexahedron8 || shape == SolidShape::hexahedron20) return {{h.begin(), h.end()}};
  if (shape == SolidShape::prism6 || shape == SolidShape::prism15)
    return {{h[0], h[1], h[2], h[4], h[5], h[6]}, {h[0], h[2], h[3], h[4], h[6], h[7]}};
  return {{h[0], h[1], h[2], h[6]}, {h[0], h[2], h[3], h[6]}, {h[0], h[3], h[7], h[6]},
          {h[0], h[7], h[4], h[6]}, {h[0], h[4], h[5], h[6]}, {h[0], h[5], h[1], h[6]}};
}

namespace {

/// Adds the node at the middle of an edge, once.
class MiddleNodes {
 public:
  explicit MiddleNodes(std::vector<Eigen::Vector3d>& nodes) : nodes_(nodes) {}
  int operator()(int a, int b) {
    const auto [place, is_new] = known_.try_emplace(std::minmax(a, b), static_cast<int>(nodes_.size()));
    if (is_new) nodes_.push_back(0.5 * (nodes_[a] + nodes_[b]));
    return place->second;
  }

 private:
  std::vector<Eigen::Vector3d>& nodes_;
  std::map<std::pair<int, int>, int> known_;
};

}  // namespace

std::vector<Eigen::Vector3d> block_corners(const SolidBlock& block) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-block.distortion, block.distortion);
  const Eigen::Array3d cells(block.cells[0], block.cells[1], block.cells[2]);
  std::vector<Eigen::Vector3d> nodes;
  for (int k = 0; k <= block.cells[2]; ++k)
    for (int j = 0; j <= block.cells[1]; ++j)
      for (int i = 0; i <= block.cells[0]; ++i) {
        const bool inner = i > 0 && j > 0 && k > 0 && i < block.cells[0] && j < block.cells[1] && k < block.cells[2];
        Eigen::Array3d p(i, j, k);
        if (inner) p += Eigen::Array3d(shift(random), shift(random), shift(random));
        nodes.push_back(p / cells * block.size.array());
      }
  return nodes;
}

Mesh solid_block(const SolidBlock& block, const SolidProperty& property) {
  std::vector<Eigen::Vector3d> nodes = block_corners(block);
  MiddleNodes middle(nodes);
  Mesh mesh;
  mesh.solid_properties = {property};
  const int nx = block.cells[0] + 1, ny = block.cells[1] + 1;
  for (int k = 0; k < block.cells[2]; ++k)
    for (int j = 0; j < block.cells[1]; ++j)
      for (int i = 0; i < block.cells[0]; ++i) {
        const int o = i + nx * (j + ny * k), up = nx * ny;
        for (const std::vector<int>& corners : cell_elements(
                 block.shape, {o, o + 1, o + 1 + nx, o + nx, o + up, o + up + 1, o + up + 1 + nx, o + up + nx})) {
          SolidElement element;
          element.shape = block.shape;
          element.id = static_cast<int>(mesh.solids.size()) + 1;
          std::copy(corners.begin(), corners.end(), element.nodes.begin());
          if (is_quadratic(block.shape))
            with_shape(block.shape, [&]<SolidShape s>() {
              for (std::size_t e = 0; e < SolidBasis<s>::edges.size(); ++e)
                element.nodes[corners.size() + e] =
                    middle(corners[SolidBasis<s>::edges[e][0]], corners[SolidBasis<s>::edges[e][1]]);
            });
          mesh.solids.push_back(element);
        }
      }
  mesh.position.resize(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    mesh.position.col(n) = nodes[n];
    mesh.node_label.push_back("node " + std::to_string(n + 1));
  }
  return mesh;
}

}  // namespace tisserand::reducer
