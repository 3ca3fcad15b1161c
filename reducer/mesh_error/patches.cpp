// SPDX-License-Identifier: GPL-3.0-or-later
// Patches of elements around corners.
#include "reducer/mesh_error/patches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include "common/stable_sort.hpp"

namespace tisserand::reducer {
namespace {

constexpr double smooth_cosine = 0.866;  ///< cosine of the angle between normals: 30 degrees
constexpr double fuller = 1.5;           ///< a patch whose angle is larger by this factor has elements on more sides

struct Corner {
  int element = 0;
  int corner = 0;
};

int shells(const Mesh& mesh) { return count_of(mesh.shells); }

double angle_of(const Mesh& mesh, const Corner& c) {
  return c.element < shells(mesh) ? angle_at_corner(mesh, mesh.shells[c.element], c.corner)
                                  : angle_at_corner(mesh, mesh.solids[c.element - shells(mesh)], c.corner);
}

/// Corners at each node.
std::vector<std::vector<Corner>> corners_at_nodes(const Mesh& mesh) {
  std::vector<std::vector<Corner>> at(static_cast<std::size_t>(mesh.nodes()));
  const int elements = shells(mesh) + count_of(mesh.solids);
  for (int e = 0; e < elements; ++e)
    for (int c = 0; c < corners_of(mesh, e); ++c) at[corner_node(mesh, e, c)].push_back({e, c});
  return at;
}

Eigen::Matrix3Xd normals_of(const Mesh& mesh) {
  Eigen::Matrix3Xd normal(3, shells(mesh));
  for (int s = 0; s < shells(mesh); ++s) {
    const ShellElement& shell = mesh.shells[s];
    const auto x = [&](int k) { return Eigen::Vector3d(mesh.position.col(shell.nodes[k])); };
    const Eigen::Vector3d across = shell.corners() == 3 ? Eigen::Vector3d((x(1) - x(0)).cross(x(2) - x(0)))
                                                        : Eigen::Vector3d((x(2) - x(0)).cross(x(3) - x(1)));
    normal.col(s) = across.normalized();
  }
  return normal;
}

/// Nodes next to a corner along its two edges.
std::array<int, 2> beside(const ShellElement& shell, int corner) {
  const int n = shell.corners();
  return {shell.nodes[(corner + 1) % n], shell.nodes[(corner + n - 1) % n]};
}

/// Edge from the corner to the next node, identified by its first corner.
int edge_towards(const ShellElement& shell, int corner, int node) {
  return beside(shell, corner)[0] == node ? corner : (corner + shell.corners() - 1) % shell.corners();
}

bool smooth_between(const Mesh& mesh, const Eigen::Matrix3Xd& normal, int e, int f) {
  const ShellElement &a = mesh.shells[e], &b = mesh.shells[f];
  const double cosine = normal.col(e).dot(normal.col(f));
  return a.property == b.property && a.offset == (cosine < 0.0 ? -b.offset : b.offset) &&
         std::abs(cosine) > smooth_cosine;
}

/// Group of each corner at one node, identified by the lowest connected corner.
class Groups {
 public:
  explicit Groups(std::size_t count) : of_(count) { std::iota(of_.begin(), of_.end(), 0); }
  int of(int k) const { return of_[k]; }
  void join(int a, int b) {
    const int from = std::max(of_[a], of_[b]), to = std::min(of_[a], of_[b]);
    std::replace(of_.begin(), of_.end(), from, to);
  }

 private:
  std::vector<int> of_;
};

/// Groups at a node: shells that share an edge with no third one, and solids of one property.
Groups groups_at(const Mesh& mesh, const Eigen::Matrix3Xd& normal, const std::vector<Corner>& corners,
                 std::vector<ShellEdges>& ending) {
  Groups groups(corners.size());
  const int count = count_of(corners), border = shells(mesh);
  const auto shares_edge = [&](const Corner& c, int node) {
    if (c.element >= border) return false;
    const auto ends = beside(mesh.shells[c.element], c.corner);
    return ends[0] == node || ends[1] == node;
  };
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      const int e = corners[i].element, f = corners[j].element;
      if (e >= border && f >= border && mesh.solids[e - border].property == mesh.solids[f - border].property) {
        groups.join(i, j);
      } else if (e < border && f < border && smooth_between(mesh, normal, e, f)) {
        for (const int node : beside(mesh.shells[e], corners[i].corner))
          if (shares_edge(corners[j], node) && std::count_if(corners.begin(), corners.end(), [&](const Corner& c) {
                                                 return shares_edge(c, node);
                                               }) == 2) {
            groups.join(i, j);
            ending[e][edge_towards(mesh.shells[e], corners[i].corner, node)] = false;
            ending[f][edge_towards(mesh.shells[f], corners[j].corner, node)] = false;
          }
      }
    }
  return groups;
}

/// Makes the patches of the nodes, and assigns every corner to one.
void make_patches(const Mesh& mesh, StressPatches& all) {
  const Eigen::Matrix3Xd normal = normals_of(mesh);
  const std::vector<std::vector<Corner>> at = corners_at_nodes(mesh);
  std::vector<int> patch_of;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const std::vector<Corner>& corners = at[node];
    const Groups groups = groups_at(mesh, normal, corners, all.ending);
    patch_of.assign(corners.size(), -1);
    for (int i = 0; i < std::ssize(corners); ++i) {
      int& patch = patch_of[groups.of(i)];
      if (patch < 0) {
        patch = count_of(all.patch);
        all.patch.emplace_back().node = node;
      }
      all.patch[patch].elements.push_back(corners[i].element);
      all.patch[patch].angle += angle_of(mesh, corners[i]);
      all.of_corner[all.first[corners[i].element] + corners[i].corner] = patch;
    }
  }
}

/// Patches at the other corners of the elements of `patch`.
std::vector<int> neighbours(const StressPatches& all, int patch) {
  std::vector<int> found;
  for (const int e : all.patch[patch].elements)
    for (int k = all.first[e]; k < all.first[e + 1]; ++k)
      if (all.of_corner[k] != patch) found.push_back(all.of_corner[k]);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool second_order(const Mesh& mesh, int element) {
  return element >= shells(mesh) && is_second_order(mesh.solids[element - shells(mesh)].shape);
}

/// Finds the sources of patches, those with the largest angles first, because others use their sources.
void find_sources(const Mesh& mesh, StressPatches& all) {
  std::vector<int> order(all.patch.size());
  std::iota(order.begin(), order.end(), 0);
  sort_stably(order, [&](int a, int b) { return all.patch[a].angle > all.patch[b].angle; });
  for (const int p : order) {
    StressPatch& patch = all.patch[p];
    const std::vector<int> others = neighbours(all, p);
    double most = 0.0;
    for (const int q : others) most = std::max(most, all.patch[q].angle);
    if (most < fuller * patch.angle || second_order(mesh, patch.elements.front())) {
      patch.source = {p};
      continue;
    }
    for (const int q : others)
      if (all.patch[q].angle > 0.9 * most)
        patch.source.insert(patch.source.end(), all.patch[q].source.begin(), all.patch[q].source.end());
    std::sort(patch.source.begin(), patch.source.end());
    patch.source.erase(std::unique(patch.source.begin(), patch.source.end()), patch.source.end());
  }
}

}  // namespace

int corners_of(const Mesh& mesh, int element) {
  return element < shells(mesh) ? mesh.shells[element].corners()
                                : corner_count(mesh.solids[element - shells(mesh)].shape);
}

int corner_node(const Mesh& mesh, int element, int corner) {
  return element < shells(mesh) ? mesh.shells[element].nodes[corner]
                                : mesh.solids[element - shells(mesh)].nodes[corner];
}

StressPatches stress_patches(const Mesh& mesh) {
  StressPatches all;
  const int elements = shells(mesh) + count_of(mesh.solids);
  all.first.push_back(0);
  for (int e = 0; e < elements; ++e) all.first.push_back(all.first.back() + corners_of(mesh, e));
  all.ending.assign(mesh.shells.size(), {true, true, true, true});
  all.of_corner.assign(static_cast<std::size_t>(all.first.back()), -1);
  make_patches(mesh, all);
  find_sources(mesh, all);
  return all;
}

}  // namespace tisserand::reducer
