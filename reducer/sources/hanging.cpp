// SPDX-License-Identifier: GPL-3.0-or-later
// Hanging nodes: nodes on an edge or face of another element without a node there, so that they are not connected to
// it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "reducer/mesh/solid_faces.hpp"
#include "reducer/sources/apart_on_purpose.hpp"
#include "reducer/sources/mesh_builder.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr double beside_face = 1e-4;    ///< of the longest edge of a face: nodes within this distance lie on it
constexpr double beside_corner = 1e-3;  ///< of that edge: nodes this near to the element's nodes coincide

/// Tree of points, halved repeatedly along their longest extent; finds the points in a box.
class PointTree {
 public:
  PointTree(const MeshBuilder& builder, std::vector<int> nodes) : builder_(builder), nodes_(std::move(nodes)) {
    split(0, nodes_.size());
  }

  template <class Visit>
  void inside(const AlignedBox3d& box, const Visit& visit) const {
    inside(box, 0, nodes_.size(), visit);
  }

 private:
  static constexpr std::size_t leaf = 8;

  AlignedBox3d box_of(std::size_t begin, std::size_t end) const {
    AlignedBox3d box;
    for (std::size_t k = begin; k < end; ++k) box.extend(builder_.position(nodes_[k]));
    return box;
  }

  void split(std::size_t begin, std::size_t end) {
    if (end - begin <= leaf) return;
    Eigen::Index axis = 0;
    box_of(begin, end).sizes().maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t k) { return nodes_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](int a, int b) { return builder_.position(a)[axis] < builder_.position(b)[axis]; });
    axis_.resize(std::max(axis_.size(), middle + 1), 0);
    axis_[middle] = static_cast<char>(axis);
    split(begin, middle);
    split(middle, end);
  }

  template <class Visit>
  void inside(const AlignedBox3d& box, std::size_t begin, std::size_t end, const Visit& visit) const {
    if (end - begin <= leaf) {
      for (std::size_t k = begin; k < end; ++k)
        if (box.contains(builder_.position(nodes_[k]))) visit(nodes_[k]);
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const Eigen::Index axis = axis_[middle];
    const double border = builder_.position(nodes_[middle])[axis];
    if (box.min()[axis] <= border) inside(box, begin, middle, visit);
    if (box.max()[axis] >= border) inside(box, middle, end, visit);
  }

  const MeshBuilder& builder_;
  std::vector<int> nodes_;
  std::vector<char> axis_;  ///< axes of the splits, indexed by their middle
};

/// Shell, or outer face of a solid.
struct TouchedFace {
  std::vector<int> corners;
  std::vector<int> nodes;  ///< nodes of its element
  bool shell = false;
  int element = 0;  ///< shell or solid
};

std::vector<TouchedFace> touched_faces(const Mesh& mesh) {
  std::vector<TouchedFace> faces;
  for (int s = 0; s < std::ssize(mesh.shells); ++s) {
    const auto nodes = nodes_of(mesh.shells[s]);
    const std::vector<int> corners(nodes.begin(), nodes.end());
    faces.push_back({corners, corners, true, s});
  }
  for (const OuterFace& outer : outer_faces_of_solids(mesh)) {
    const SolidElement& solid = mesh.solids[outer.solid];
    TouchedFace face{{}, {solid.nodes.begin(), solid.nodes.begin() + node_count(solid.shape)}, false, outer.solid};
    for (const int k : outer.corners) face.corners.push_back(solid.nodes[k]);
    faces.push_back(std::move(face));
  }
  return faces;
}

bool in_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& x, double tolerance) {
  const Vector3d n = (b - a).cross(c - a).normalized();
  if (std::abs(n.dot(x - a)) > tolerance) return false;
  const auto inside = [&](const Vector3d& p, const Vector3d& q) {
    return n.cross((q - p).normalized()).dot(x - p) > -tolerance;
  };
  return inside(a, b) && inside(b, c) && inside(c, a);
}

/// Whether x lies on the face, away from the nodes of its element.
class HangingPlace {
 public:
  HangingPlace(const MeshBuilder& builder, const TouchedFace& face) : builder_(builder), face_(face) {
    const std::size_t n = face.corners.size();
    for (std::size_t k = 0; k < n; ++k) size_ = std::max(size_, (x(k) - x((k + 1) % n)).norm());
    for (std::size_t k = 0; k < n; ++k) box_.extend(x(k));
    const Vector3d margin = Vector3d::Constant(beside_face * size_);
    box_.min() -= margin;
    box_.max() += margin;
  }

  const AlignedBox3d& box() const { return box_; }

  bool holds(int node) const {
    const Vector3d& p = builder_.position(node);
    for (const int own : face_.nodes)
      if (own == node || (builder_.position(own) - p).norm() < beside_corner * size_) return false;
    const double tolerance = beside_face * size_;
    if (in_triangle(x(0), x(1), x(2), p, tolerance)) return true;
    return face_.corners.size() == 4 &&
           (in_triangle(x(0), x(2), x(3), p, tolerance) || in_triangle(x(0), x(1), x(3), p, tolerance) ||
            in_triangle(x(1), x(2), x(3), p, tolerance));
  }

 private:
  const Vector3d& x(std::size_t k) const { return builder_.position(face_.corners[k]); }

  const MeshBuilder& builder_;
  const TouchedFace& face_;
  double size_ = 0.0;
  AlignedBox3d box_;
};

/// Elements at each node: shells and solids.
class ElementsAtNodes {
 public:
  explicit ElementsAtNodes(const Mesh& mesh, std::size_t nodes) : of_(nodes) {
    for (const ShellElement& shell : mesh.shells) add(nodes_of(shell));
    for (const SolidElement& solid : mesh.solids) add(nodes_of(solid));
  }

  /// Whether an element at `node` also has one of the other nodes.
  bool meets(int node, const std::vector<int>& others) const {
    return std::ranges::any_of(of_[node], [&](int element) {
      return std::ranges::any_of(nodes_[element], [&](int n) { return std::ranges::find(others, n) != others.end(); });
    });
  }

 private:
  void add(std::span<const int> nodes) {
    for (const int n : nodes) of_[n].push_back(count_of(nodes_));
    nodes_.emplace_back(nodes.begin(), nodes.end());
  }

  std::vector<std::vector<int>> of_;
  std::vector<std::vector<int>> nodes_;
};

std::string name_of_element(const Mesh& mesh, const TouchedFace& face) {
  if (face.shell) {
    const ShellElement& shell = mesh.shells[face.element];
    return fmt::format("shell {} of '{}'", shell.id, mesh.shell_properties[shell.property].name);
  }
  const SolidElement& solid = mesh.solids[face.element];
  return fmt::format("solid {} of '{}'", solid.id, mesh.solid_properties[solid.property].name);
}

}  // namespace

void report_hanging_nodes(MeshBuilder& builder) {
  const Mesh& mesh = builder.mesh;
  const std::vector<TouchedFace> faces = touched_faces(mesh);
  std::vector<int> nodes;
  for (const TouchedFace& face : faces) nodes.insert(nodes.end(), face.corners.begin(), face.corners.end());
  for (const TouchedFace& face : faces)  // middle nodes of second-order solids may lie on edges of first-order ones
    if (face.nodes.size() > 8) nodes.insert(nodes.end(), face.nodes.begin(), face.nodes.end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const PointTree tree(builder, nodes);
  std::vector<std::pair<int, std::size_t>> touching;  // node, face
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const HangingPlace place(builder, faces[f]);
    tree.inside(place.box(), [&](int node) {
      if (place.holds(node)) touching.emplace_back(node, f);
    });
  }
  if (touching.empty()) return;
  const ElementsAtNodes neighbours(mesh, builder.cells.position.size());
  const ApartOnPurpose apart(mesh);
  std::set<int> hanging;
  std::optional<std::pair<int, std::size_t>> first;
  for (const auto& [node, f] : touching) {
    const std::vector<int>& own = faces[f].nodes;
    if (!neighbours.meets(node, own) || std::ranges::any_of(own, [&](int n) { return apart(node, n); })) continue;
    hanging.insert(node);
    if (!first || std::pair(node, f) < *first) first = std::pair(node, f);
  }
  if (!first) return;
  const Vector3d& x = builder.position(first->first);
  builder.mesh.warnings.push_back(fmt::format(
      "hanging nodes: {}, first {} at ({:.6g}, {:.6g}, {:.6g}) on {}. A hanging node lies on an edge or face of an "
      "element without being connected to it. Divide the elements on both sides in the same way, or connect each "
      "hanging node to the adjacent nodes by an equation or a spider",
      hanging.size(), builder.label[first->first], x.x(), x.y(), x.z(), name_of_element(mesh, faces[first->second])));
}

}  // namespace tisserand::reducer
