// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings about elements that touch without a common node, because they are not connected there.
#include <algorithm>
#include <limits>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "reducer/sources/apart_on_purpose.hpp"
#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/node_grid.hpp"
#include "reducer/sources/node_references.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector3d;

constexpr double touching = 1e-6;  ///< relative to an element's length
constexpr std::size_t most_listed = 10;

double longest_element(const MeshBuilder& builder) {
  double longest = 0.0;
  for (const std::vector<int>& nodes : builder.beam_nodes)
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k)
      longest = std::max(longest, (builder.position(nodes[k + 1]) - builder.position(nodes[k])).norm());
  return longest;
}

/// Line of a beam, which finds nodes of other beams on its elements.
class Line {
 public:
  Line(const MeshBuilder& builder, std::size_t number, const NodePairs& tied)
      : builder_(builder), nodes_(builder.beam_nodes[number]), own_(nodes_.begin(), nodes_.end()), tied_(tied) {}

  std::set<int> touched(const NodeGrid& grid) const {
    std::set<int> found;
    for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) {
      const Vector3d middle = 0.5 * (builder_.position(nodes_[k]) + builder_.position(nodes_[k + 1]));
      grid.near(middle, [&](int node) {
        if (!own_.contains(node) && touches(nodes_[k], nodes_[k + 1], node)) found.insert(node);
      });
    }
    return found;
  }

 private:
  bool touches(int first, int second, int node) const {
    const Vector3d a = builder_.position(first), d = builder_.position(second) - a, x = builder_.position(node) - a;
    const double s = std::clamp(x.dot(d) / d.squaredNorm(), 0.0, 1.0);
    return (x - s * d).norm() < touching * d.norm() && !tied_.contains(std::minmax(first, node)) &&
           !tied_.contains(std::minmax(second, node));
  }

  const MeshBuilder& builder_;
  const std::vector<int>& nodes_;
  std::set<int> own_;
  const NodePairs& tied_;
};

/// Marks nodes of the mesh file that have elements by 1.
std::vector<char> carrying_nodes(const MeshBuilder& builder) {
  const Mesh& mesh = builder.mesh;
  std::vector<char> carries(builder.cells.position.size(), 0);
  const auto add = [&](int node) {
    if (node >= builder.first_file_node && node < builder.last_file_node) carries[node] = 1;
  };
  for (const BeamElement& beam : mesh.beams) std::ranges::for_each(nodes_of(beam), add);
  for (const ShellElement& shell : mesh.shells) std::ranges::for_each(nodes_of(shell), add);
  for (const SolidElement& solid : mesh.solids) std::ranges::for_each(nodes_of(solid), add);
  return carries;
}

/// Diagonal of the box around the marked nodes.
double extent(const MeshBuilder& builder, const std::vector<char>& counts) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (std::size_t n = 0; n < counts.size(); ++n)
    if (counts[n] != 0) {
      low = low.cwiseMin(builder.cells.position[n]);
      high = high.cwiseMax(builder.cells.position[n]);
    }
  return (high - low).norm();
}

}  // namespace

void report_unjoined_beams(MeshBuilder& builder) {
  const double step = longest_element(builder);
  if (!(step > 0.0)) return;
  NodeGrid grid(step);
  std::set<int> added;
  for (const std::vector<int>& nodes : builder.beam_nodes)
    for (const int node : nodes)
      if (added.insert(node).second) grid.add(builder.position(node), node);
  const NodePairs tied = tied_pairs(builder.mesh);
  NodePairs met;  // nodes at the same place are found from both beams
  std::vector<std::string> texts;
  for (std::size_t b = 0; b < builder.beam_nodes.size(); ++b)
    for (const int node : Line(builder, b, tied).touched(grid)) {
      const Vector3d x = builder.position(node);
      const auto twin = std::ranges::find_if(builder.beam_nodes[b],
                                             [&](int n) { return (builder.position(n) - x).norm() < touching * step; });
      if (twin != builder.beam_nodes[b].end() && !met.insert(std::minmax(node, *twin)).second) continue;
      texts.push_back(fmt::format(
          "node {} lies on beam '{}' but is not connected to it. Beams are connected only at their ends, by points of "
          "the same name: end beam '{}' there, or connect both by a spring or spider",
          builder.label[node], builder.part.beams[b].name, builder.part.beams[b].name));
    }
  const std::size_t reported = std::min(texts.size(), most_listed);
  builder.mesh.warnings.insert(builder.mesh.warnings.end(), texts.begin(),
                               texts.begin() + static_cast<std::ptrdiff_t>(reported));
  if (reported < texts.size())
    builder.mesh.warnings.push_back(
        fmt::format("... and {} more nodes lie on beams to which they are not connected", texts.size() - reported));
}

void join_coincident_nodes(MeshBuilder& builder) {
  if (builder.last_file_node <= builder.first_file_node) return;
  const std::vector<char> carries = carrying_nodes(builder);
  const double tolerance = touching * extent(builder, carries);
  if (!(tolerance > 0.0)) return;
  const ApartOnPurpose apart(builder.mesh);
  NodeGrid grid(1e3 * tolerance);  // smaller than most elements
  std::vector<int> twin(carries.size(), -1);
  int count = 0, first = -1;
  for (int node = builder.first_file_node; node < builder.last_file_node; ++node) {
    if (carries[node] == 0) continue;
    const Vector3d& x = builder.position(node);
    grid.near(x, tolerance, [&](int other) {
      if (twin[node] < 0 && (builder.position(other) - x).norm() < tolerance && !apart(other, node)) twin[node] = other;
    });
    if (twin[node] < 0) {
      grid.add(x, node);
    } else if (count++ == 0) {
      first = node;
    }
  }
  if (count == 0) return;
  const Vector3d& x = builder.position(first);
  const std::string place = fmt::format("first {} and {} at ({:.6g}, {:.6g}, {:.6g})", builder.label[twin[first]],
                                        builder.label[first], x.x(), x.y(), x.z());
  if (builder.part.mesh.coincident == formats::CoincidentNodes::merge) {
    for (int n = 0; n < std::ssize(twin); ++n)
      if (twin[n] >= 0) builder.merged.insert(n);
    for_nodes(builder.mesh, [&twin](int& node) {
      if (twin[node] >= 0) node = twin[node];
    });
    builder.mesh.warnings.push_back(
        fmt::format("nodes merged with other nodes at the same place: {}, {}", count, place));
  } else {
    builder.mesh.warnings.push_back(
        fmt::format("nodes at the same place as other nodes, but not connected to them: {}, {}. To connect them, write "
                    "`coincident: merge` under mesh",
                    count, place));
  }
}

}  // namespace tisserand::reducer
