// SPDX-License-Identifier: GPL-3.0-or-later
// Forms, sizes and nodal shares of cells.
#include "reducer/mesh/cells.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/math/count.hpp"

namespace tisserand::reducer {
namespace {

constexpr std::array<CellForm, 12> forms{{{1, 1, 2, 2},
                                          {8, 1, 3, 2},
                                          {2, 2, 3, 3},
                                          {9, 2, 6, 3},
                                          {3, 2, 4, 4},
                                          {16, 2, 8, 4},
                                          {4, 3, 4, 4},
                                          {11, 3, 10, 4},
                                          {5, 3, 8, 8},
                                          {17, 3, 20, 8},
                                          {6, 3, 6, 6},
                                          {18, 3, 15, 6}}};

using Points = std::vector<Eigen::Vector3d>;

double tetrahedron_volume(const Points& x, const Cell& cell, const std::array<int, 4>& k) {
  const auto at = [&](int i) { return x[cell.nodes[k[i]]]; };
  return std::abs((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0))) / 6.0;
}

/// Area of a triangle or (warped) quadrilateral: half of the cross product of the diagonals.
double face_area(const Points& x, const Cell& cell, int corners) {
  const auto at = [&](int i) { return x[cell.nodes[i]]; };
  if (corners == 3) return 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
  return 0.5 * (at(2) - at(0)).cross(at(3) - at(1)).norm();
}

double volume(const Points& x, const Cell& cell, int corners) {
  if (corners == 4) return tetrahedron_volume(x, cell, {0, 1, 2, 3});
  if (corners == 6)
    return tetrahedron_volume(x, cell, {0, 1, 2, 3}) + tetrahedron_volume(x, cell, {1, 2, 3, 4}) +
           tetrahedron_volume(x, cell, {2, 3, 4, 5});
  constexpr std::array<std::array<int, 4>, 5> five{
      {{0, 1, 3, 4}, {1, 2, 3, 6}, {1, 4, 5, 6}, {3, 4, 6, 7}, {1, 3, 4, 6}}};
  double sum = 0.0;
  for (const auto& tetrahedron : five) sum += tetrahedron_volume(x, cell, tetrahedron);
  return sum;
}

}  // namespace

CellForm form_of(CellShape shape) { return forms[static_cast<int>(shape)]; }

std::optional<CellShape> cell_shape(int gmsh_type) {
  const auto form = std::ranges::find(forms, gmsh_type, &CellForm::gmsh_type);
  if (form == forms.end()) return std::nullopt;
  return static_cast<CellShape>(form - forms.begin());
}

std::span<const int> nodes_of(const Cell& cell) {
  return {cell.nodes.data(), static_cast<std::size_t>(form_of(cell.shape).nodes)};
}

std::span<const int> corners_of(const Cell& cell) {
  return {cell.nodes.data(), static_cast<std::size_t>(form_of(cell.shape).corners)};
}

Eigen::Vector3d middle_of(const Cell& cell, const Points& position) {
  const std::span<const int> corners = corners_of(cell);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int node : corners) sum += position[node];
  return sum / count_of(corners);
}

FaceKey face_key(std::span<const int> corners) {
  FaceKey key{-1, -1, -1, -1};
  std::ranges::copy(corners, key.begin());
  std::ranges::sort(key);
  return key;
}

const char* dimension_word(int dimension) {
  constexpr std::array<const char*, 4> words{"node", "edge", "face", "volume"};
  return words[dimension];
}

std::string name_of(const Entity& entity) {
  if (entity.number == 0) return entity.label;
  const std::string number = fmt::format("{} {}", dimension_word(entity.dimension), entity.number);
  return entity.label.empty() ? number : fmt::format("{} ('{}')", number, entity.label);
}

NodeShares node_shares(const Cell& cell, const Points& position) {
  const CellForm form = form_of(cell.shape);
  NodeShares result;
  if (form.dimension == 1)
    result.size = (position[cell.nodes[1]] - position[cell.nodes[0]]).norm();
  else
    result.size = form.dimension == 2 ? face_area(position, cell, form.corners) : volume(position, cell, form.corners);
  // Share of one corner; the middle nodes share the rest equally. These numbers come from halving the edges. The
  // triangle's corner touches one of four triangles, the quadrilateral's one of four quadrilaterals, whose middle
  // belongs to the four middle nodes.
  double corner = 1.0 / form.corners;
  if (cell.shape == CellShape::line3) corner = 1.0 / 4.0;
  if (cell.shape == CellShape::triangle6) corner = 1.0 / 12.0;
  if (cell.shape == CellShape::quadrilateral8) corner = 1.0 / 16.0;
  if (form.dimension == 3 && form.nodes > form.corners) corner = 1.0 / 32.0;
  const int middle = form.nodes - form.corners;
  for (int i = 0; i < form.nodes; ++i)
    result.share[i] = i < form.corners ? corner : (1.0 - form.corners * corner) / middle;
  return result;
}

}  // namespace tisserand::reducer
