// SPDX-License-Identifier: GPL-3.0-or-later
// Faces as shells of one group each, for the page of a part.
#include "reducer/survey/page.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "reducer/fields/fields.hpp"
#include "reducer/view/part_page.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector3d;

/// At most `most` of the places, evenly distributed.
std::vector<Vector3d> few_of(const std::vector<Vector3d>& places, std::size_t most) {
  std::vector<Vector3d> few;
  for (std::size_t k = 0; k < places.size(); k += 1 + places.size() / most) few.push_back(places[k]);
  return few;
}

/// Middles of the edges that belong to one cell only.
std::vector<Vector3d> rim_of(const FacePiece& piece, const std::vector<Vector3d>& position) {
  std::map<std::pair<int, int>, int> cells;
  for (const Cell& cell : piece.cells) {
    const int corners = form_of(cell.shape).corners;
    for (int k = 0; k < corners; ++k) ++cells[std::minmax({cell.nodes[k], cell.nodes[(k + 1) % corners]})];
  }
  std::vector<Vector3d> rim;
  for (const auto& [edge, count] : cells)
    if (count == 1) rim.push_back(0.5 * (position[edge.first] + position[edge.second]));
  return rim;
}

/// Places of a face's name: the cell farthest from its rim. Curved faces have more, far from one another, since one may
/// be hidden.
std::vector<Vector3d> places_on(const FacePiece& piece, const std::vector<Vector3d>& position) {
  constexpr std::size_t most = 400;
  std::vector<Vector3d> middles;
  for (const Cell& cell : piece.cells) middles.push_back(middle_of(cell, position));
  const std::vector<Vector3d> candidates = few_of(middles, most);
  std::vector<Vector3d> avoided = few_of(rim_of(piece, position), most), places;
  for (int k = 0; k < (piece.is_flat ? 1 : 4); ++k) {
    Vector3d best = candidates.front();
    double farthest = -1.0;
    for (const Vector3d& candidate : candidates) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vector3d& other : avoided) nearest = std::min(nearest, (candidate - other).norm());
      if (nearest > farthest) farthest = nearest, best = candidate;
    }
    places.push_back(best);
    avoided.push_back(best);
  }
  return places;
}

/// Mesh with the nodes of the pieces only, and their cells by corners.
Mesh mesh_of_pieces(const std::vector<FacePiece>& pieces, const std::vector<Vector3d>& position) {
  Mesh mesh;
  std::vector<int> row(position.size(), -1);
  std::vector<int> kept;
  for (const FacePiece& piece : pieces) {
    for (const Cell& cell : piece.cells) {
      ShellElement shell;
      for (int k = 0; k < form_of(cell.shape).corners; ++k) {
        int& node = row[cell.nodes[k]];
        if (node < 0) {
          node = count_of(kept);
          kept.push_back(cell.nodes[k]);
        }
        shell.nodes[k] = node;
      }
      shell.property = count_of(mesh.shell_properties);
      mesh.shells.push_back(shell);
    }
    ShellProperty property;
    property.name = piece.name;
    mesh.shell_properties.push_back(property);
  }
  mesh.position.resize(3, static_cast<Eigen::Index>(kept.size()));
  for (std::size_t n = 0; n < kept.size(); ++n) mesh.position.col(static_cast<Eigen::Index>(n)) = position[kept[n]];
  mesh.node_label.resize(kept.size());
  return mesh;
}

std::string hex_of(const std::array<double, 3>& colour) {
  const auto byte = [](double part) { return static_cast<int>(std::lround(255.0 * std::clamp(part, 0.0, 1.0))); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour[0]), byte(colour[1]), byte(colour[2]));
}

}  // namespace

std::string faces_page(const Survey& survey, const std::vector<FacePiece>& pieces, const std::string& title,
                       const std::string& source) {
  ViewedPart part;
  part.title = title;
  part.file = source;
  part.units = survey.units;
  part.tables = mesh_tables(mesh_of_pieces(pieces, survey.position));
  for (const FacePiece& piece : pieces) {
    part.looks.push_back({piece.form, hex_of(piece.colour)});
    if (piece.label.empty()) continue;
    for (const Vector3d& place : places_on(piece, survey.position)) part.faces.push_back({piece.label, place});
  }
  return part_page(part);
}

}  // namespace tisserand::reducer
