// SPDX-License-Identifier: GPL-3.0-or-later
// Orientation of closed boundaries: cells are turned one by one across edges, then all by the sign of the volume.
#include "reducer/faces/outward.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "reducer/mesh/mesh.hpp"
#include "reducer/mesh/solid_faces.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector3d;

/// Whether two cells with the same corners have the same orientation.
bool agree(const Cell& a, const Cell& b) {
  const int corners = form_of(a.shape).corners;
  for (int k = 0; k < corners; ++k)
    if (b.nodes[k] == a.nodes[0]) return b.nodes[(k + 1) % corners] == a.nodes[1];
  return false;
}

/// Signs from the solids on which the cells lie.
std::vector<int> signs_of_solids(const CellMesh& mesh) {
  Mesh solids;
  for (const Cell& cell : mesh.cells[3]) {
    SolidElement solid;
    solid.shape = static_cast<SolidShape>(static_cast<int>(cell.shape) - static_cast<int>(CellShape::tetrahedron4));
    solid.nodes = cell.nodes;
    solids.solids.push_back(solid);
  }
  std::map<FaceKey, Cell> outer;
  for (const Cell& face : outer_faces(solids, [](int) { return true; }))
    outer.emplace(face_key(corners_of(face)), face);
  std::vector<int> sign(mesh.cells[2].size(), 0);
  for (std::size_t c = 0; c < sign.size(); ++c)
    if (const auto found = outer.find(face_key(corners_of(mesh.cells[2][c]))); found != outer.end())
      sign[c] = agree(found->second, mesh.cells[2][c]) ? 1 : -1;
  return sign;
}

/// Boundary of one volume: its cells.
class Boundary {
 public:
  Boundary(const CellMesh& mesh, std::vector<std::size_t> members)
      : mesh_(mesh), members_(std::move(members)), sign_(members_.size(), 0) {
    for (std::size_t m = 0; m < members_.size(); ++m)
      for (const auto& [a, b] : edges(m)) at_edge_[std::minmax(a, b)].push_back({m, a < b});
  }

  /// Signs of the members. Empty if it is open, or if cells that meet at an edge cannot be distinguished.
  std::vector<int> signs() {
    for (const auto& [edge, meeting] : at_edge_)
      if (meeting.size() != 2) return {};
    double largest = -1.0;
    std::vector<std::vector<std::size_t>> shells;
    std::size_t outer = 0;
    for (std::size_t m = 0; m < members_.size(); ++m) {
      if (sign_[m] != 0) continue;
      shells.push_back(turned_from(m));
      if (shells.back().empty()) return {};
      if (const double size = box(shells.back()); size > largest) largest = size, outer = shells.size() - 1;
    }
    for (std::size_t s = 0; s < shells.size(); ++s)
      if ((volume(shells[s]) > 0.0) != (s == outer))
        for (const std::size_t m : shells[s]) sign_[m] = -sign_[m];
    return sign_;
  }
  const std::vector<std::size_t>& members() const { return members_; }

 private:
  const Cell& cell(std::size_t m) const { return mesh_.cells[2][members_[m]]; }
  std::vector<std::pair<int, int>> edges(std::size_t m) const {
    const int corners = form_of(cell(m).shape).corners;
    std::vector<std::pair<int, int>> result;
    for (int k = 0; k < corners; ++k) result.emplace_back(cell(m).nodes[k], cell(m).nodes[(k + 1) % corners]);
    return result;
  }

  /// Orients the shell of the cell `first` so that neighbours traverse edges oppositely; empty on a Moebius strip.
  std::vector<std::size_t> turned_from(std::size_t first) {
    std::vector<std::size_t> shell{first};
    sign_[first] = 1;
    for (std::size_t at = 0; at < shell.size(); ++at)
      for (const auto& [a, b] : edges(shell[at])) {
        const auto& meeting = at_edge_.at(std::minmax(a, b));
        const auto& [other, other_rises] = meeting[0].first == shell[at] ? meeting[1] : meeting[0];
        const int wanted = other_rises == (a < b) ? -sign_[shell[at]] : sign_[shell[at]];
        if (sign_[other] == 0) {
          sign_[other] = wanted;
          shell.push_back(other);
        } else if (sign_[other] != wanted) {
          return {};
        }
      }
    return shell;
  }

  double box(const std::vector<std::size_t>& shell) const {
    Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const std::size_t m : shell)
      for (int k = 0; k < form_of(cell(m).shape).corners; ++k) {
        const Vector3d& x = mesh_.position[cell(m).nodes[k]];
        low = low.cwiseMin(x), high = high.cwiseMax(x);
      }
    return (high - low).norm();
  }

  /// Six times the volume that the shell encloses with the present signs of its cells.
  double volume(const std::vector<std::size_t>& shell) const {
    const Vector3d origin = mesh_.position[cell(shell.front()).nodes[0]];
    double sum = 0.0;
    for (const std::size_t m : shell) {
      const auto at = [&](int k) { return Vector3d(mesh_.position[cell(m).nodes[k]] - origin); };
      for (int k = 2; k < form_of(cell(m).shape).corners; ++k) sum += sign_[m] * at(0).dot(at(k - 1).cross(at(k)));
    }
    return sum;
  }

  const CellMesh& mesh_;
  std::vector<std::size_t> members_;
  std::vector<int> sign_;
  std::map<std::pair<int, int>, std::vector<std::pair<std::size_t, bool>>> at_edge_;
};

/// Cells of dimension 2 by the volumes that they bound; without geometry, all of them as one.
std::map<int, std::vector<std::size_t>> cells_of_volumes(const CellMesh& mesh) {
  std::map<int, std::vector<std::size_t>> result;
  for (std::size_t e = 0; e < mesh.entities.size(); ++e) {
    const Entity& entity = mesh.entities[e];
    if (entity.dimension != 2) continue;
    const std::vector<int> none;
    const std::vector<int>& volumes = e < mesh.geometry.size() ? mesh.geometry[e].volumes : none;
    for (const int volume : mesh.geometry.empty() ? std::vector<int>{0} : volumes)
      for (std::size_t c = entity.first; c < entity.first + entity.count; ++c) result[volume].push_back(c);
  }
  return result;
}

}  // namespace

std::vector<int> outward_signs(const CellMesh& mesh) {
  if (!mesh.cells[3].empty()) return signs_of_solids(mesh);
  std::vector<int> sign(mesh.cells[2].size(), 0), bounds(sign.size(), 0);
  for (auto& [volume, members] : cells_of_volumes(mesh)) {
    for (const std::size_t c : members) ++bounds[c];
    Boundary boundary(mesh, std::move(members));
    const std::vector<int> own = boundary.signs();
    for (std::size_t m = 0; m < own.size(); ++m) sign[boundary.members()[m]] = own[m];
  }
  for (std::size_t c = 0; c < sign.size(); ++c)
    if (bounds[c] != 1) sign[c] = 0;
  return sign;
}

}  // namespace tisserand::reducer
