// SPDX-License-Identifier: GPL-3.0-or-later
// Check that the edges of patches and beams that touch have the same nodes.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/sources/patches.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector3d;

/// Straight edge of an element; owner: the patch, or -1 for a beam.
struct Segment {
  int first = 0;
  int second = 0;
  int owner = -1;
};

/// All edges of the faces, and the nodes of edges that belong to one face only.
struct FaceEdges {
  std::vector<Segment> segments;
  std::vector<int> free_nodes;
};

FaceEdges face_edges(const CellMesh& patches) {
  FaceEdges result;
  std::map<std::pair<int, int>, int> uses;
  int owner = 0;
  for (const Entity& entity : patches.entities) {
    if (entity.dimension != 2) continue;
    for (std::size_t c = entity.first; c < entity.first + entity.count; ++c) {
      const Cell& cell = patches.cells[2][c];
      const int corners = form_of(cell.shape).corners;
      for (int k = 0; k < corners; ++k) {
        const int a = cell.nodes[k], b = cell.nodes[(k + 1) % corners];
        if (++uses[std::minmax(a, b)] == 1) result.segments.push_back({a, b, owner});
      }
    }
    ++owner;
  }
  for (const auto& [edge, count] : uses)
    if (count == 1) result.free_nodes.insert(result.free_nodes.end(), {edge.first, edge.second});
  std::ranges::sort(result.free_nodes);
  const auto rest = std::ranges::unique(result.free_nodes);
  result.free_nodes.erase(rest.begin(), rest.end());
  return result;
}

[[noreturn]] void refuse(const formats::Part& part, const OwnLines& lines, const Segment& segment, int node) {
  const auto label = [&lines](int n) { return lines.label[n]; };
  const bool patch = segment.owner >= 0;
  const std::string where = patch ? part.patches[segment.owner].where : part.file;
  throw Error(fmt::format("node {} lies on the edge from {} to {}, but is not one of its nodes", label(node),
                          label(segment.first), label(segment.second)),
              where, "give both edges the same number of elements, or divide one edge where the other ends");
}

/// Throws Error if one of the nodes in the grid lies inside the segment.
void check_segment(const formats::Part& part, const OwnLines& lines, const Segment& segment, const NodeGrid& grid,
                   double step) {
  const Vector3d a = lines.position[segment.first];
  const Vector3d d = lines.position[segment.second] - a;
  const double length = d.norm();
  const int samples = static_cast<int>(length / step) + 1;
  for (int k = 0; k <= samples; ++k)
    grid.near(a + d * (static_cast<double>(k) / samples), [&](int node) {
      if (node == segment.first || node == segment.second) return;
      const Vector3d x = lines.position[node] - a;
      const double s = x.dot(d) / (length * length);
      constexpr double slack = 1e-3;  // a node nearer to a foreign edge than this touches it
      if (s > -slack && s < 1.0 + slack && (x - std::clamp(s, 0.0, 1.0) * d).norm() < slack * length)
        refuse(part, lines, segment, node);
    });
}

double mean_length(const OwnLines& lines, const std::vector<Segment>& segments) {
  double sum = 0.0;
  for (const Segment& s : segments) sum += (lines.position[s.second] - lines.position[s.first]).norm();
  return sum / static_cast<double>(segments.size());
}

}  // namespace

void check_conformity(const formats::Part& part, const CellMesh& patches, const OwnLines& lines) {
  if (part.patches.empty() || (part.patches.size() == 1 && lines.beams.empty())) return;
  const FaceEdges faces = face_edges(patches);
  std::vector<Segment> beams;
  for (const std::vector<int>& beam : lines.beams)
    for (std::size_t k = 0; k + 1 < beam.size(); ++k) beams.push_back({beam[k], beam[k + 1], -1});
  if (faces.segments.empty()) return;
  const double step = mean_length(lines, faces.segments);
  NodeGrid of_patches(step), of_all(step);
  for (const int node : faces.free_nodes) {
    of_patches.add(lines.position[node], node);
    of_all.add(lines.position[node], node);
  }
  for (const std::vector<int>& beam : lines.beams)
    for (const int node : beam) of_all.add(lines.position[node], node);
  for (const Segment& segment : faces.segments) check_segment(part, lines, segment, of_all, step);
  for (const Segment& segment : beams) check_segment(part, lines, segment, of_patches, step);
}

}  // namespace tisserand::reducer
