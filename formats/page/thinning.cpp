// SPDX-License-Identifier: GPL-3.0-or-later
// Vertex clustering on a cubic grid.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <set>
#include <unordered_map>

#include <Eigen/Geometry>

#include "formats/page/surface.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Vector3d;

/// Cluster index of each vertex, and the number of clusters.
struct Clusters {
  std::vector<int> of;
  int count = 0;
};

Clusters clusters_of(const std::vector<Vector3d>& vertices, const Eigen::AlignedBox3d& box, double cell) {
  constexpr std::int64_t most = 1 << 20;
  Clusters clusters;
  std::unordered_map<std::int64_t, int> number;
  for (const Vector3d& vertex : vertices) {
    std::int64_t key = 0;
    for (int k = 0; k < 3; ++k)
      key = key * most + std::min<std::int64_t>(static_cast<std::int64_t>((vertex[k] - box.min()[k]) / cell), most - 1);
    const auto [found, is_new] = number.try_emplace(key, clusters.count);
    if (is_new) ++clusters.count;
    clusters.of.push_back(found->second);
  }
  return clusters;
}

/// Vertex nearest to the mean of each cluster.
std::vector<int> middle_vertices(const std::vector<Vector3d>& vertices, const Clusters& clusters) {
  std::vector<Vector3d> mean(clusters.count, Vector3d::Zero());
  std::vector<int> size(clusters.count, 0), middle(clusters.count, -1);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    mean[clusters.of[i]] += vertices[i];
    ++size[clusters.of[i]];
  }
  std::vector<double> distance(clusters.count, std::numeric_limits<double>::infinity());
  for (int i = 0; i < std::ssize(vertices); ++i) {
    const int c = clusters.of[i];
    const double d = (vertices[i] - mean[c] / size[c]).squaredNorm();
    if (d < distance[c]) distance[c] = d, middle[c] = i;
  }
  return middle;
}

/// Faces between clusters, each once, without degenerate ones.
template <std::size_t N>
std::vector<std::array<int, N>> faces_between(const std::vector<std::array<int, N>>& faces, const Clusters& clusters) {
  std::vector<std::array<int, N>> kept;
  std::set<std::array<int, N>> known;
  for (std::array<int, N> face : faces) {
    for (int& corner : face) corner = clusters.of[corner];
    std::array<int, N> sorted = face;
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end() || !known.insert(sorted).second) continue;
    kept.push_back(face);
  }
  return kept;
}

}  // namespace

Thinned thinned(const Surface& surface, int most) {
  if (surface.size() <= most) {
    std::vector<int> all(surface.vertices.size());
    std::iota(all.begin(), all.end(), 0);
    return {all, surface.triangles, surface.lines};
  }
  Eigen::AlignedBox3d box;
  for (const Vector3d& vertex : surface.vertices) box.extend(vertex);
  const double extent = std::max(box.diagonal().maxCoeff(), std::numeric_limits<double>::min());
  double coarse = 2.0 * extent, fine = extent / (1 << 19);  // `coarse` keeps one vertex, few enough
  for (int k = 0; k < 40 && coarse > 1.02 * fine; ++k) {
    const double cell = std::sqrt(coarse * fine);
    (clusters_of(surface.vertices, box, cell).count <= most ? coarse : fine) = cell;
  }
  const Clusters clusters = clusters_of(surface.vertices, box, coarse);
  return {middle_vertices(surface.vertices, clusters), faces_between(surface.triangles, clusters),
          faces_between(surface.lines, clusters)};
}

}  // namespace tisserand::formats
