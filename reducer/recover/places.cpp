// SPDX-License-Identifier: GPL-3.0-or-later
// Names and places of nodes and elements, and stress points around nodes.
#include "reducer/recover/places.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::reducer {
namespace {

/// Reads "x,y,z" as three finite numbers.
bool read_position(const std::string& text, Eigen::Vector3d& position) {
  const char* at = text.c_str();
  for (int k = 0; k < 3; ++k) {
    char* end = nullptr;
    position[k] = std::strtod(at, &end);
    if (end == at || *end != (k < 2 ? ',' : '\0') || !std::isfinite(position[k])) return false;
    at = end + 1;
  }
  return true;
}

}  // namespace

std::string element_text(const formats::Recovery& r, int element) {
  const char* kind = element < r.beams() ? "beam" : element < r.beams() + r.shells() ? "shell" : "solid";
  return fmt::format("{} {} of '{}'", kind, r.elements.id[element],
                     printable_line(r.group_name[r.elements.group[element]], 60));
}

Eigen::Vector3d element_middle(const formats::Recovery& r, int element) {
  const int first = r.elements.first[element], end = r.elements.first[element + 1];
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int k = first; k < end; ++k) middle += r.position.col(r.elements.node[k]);
  return middle / (end - first);
}

SolidPoints solid_points(const formats::Recovery& r) {
  std::vector<int> order(r.stress_node.size());
  for (int p = 0; p < std::ssize(order); ++p) order[p] = p;
  const auto key = [&r](int p) { return std::pair(r.stress_node[p], r.stress_group[p]); };
  std::sort(order.begin(), order.end(), [&key](int a, int b) { return key(a) < key(b); });
  SolidPoints points;
  points.first.push_back(0);
  for (int e = 0; e < r.elements.count(); ++e) {
    for (int k = r.elements.first[e]; e >= r.beams() + r.shells() && k < r.elements.first[e + 1]; ++k) {
      const std::pair wanted(r.elements.node[k], r.elements.group[e]);
      const auto found = std::lower_bound(order.begin(), order.end(), wanted,
                                          [&key](int p, const auto& value) { return key(p) < value; });
      if (found != order.end() && key(*found) == wanted) points.point.push_back(*found);
    }
    points.first.push_back(count_of(points.point));
  }
  return points;
}

int find_node(const formats::Recovery& r, const std::string& point, const std::string& where) {
  const auto boundary = std::find(r.boundary_name.begin(), r.boundary_name.end(), point);
  if (boundary != r.boundary_name.end()) return r.boundary_node[boundary - r.boundary_name.begin()];
  const auto label = std::find(r.node_label.begin(), r.node_label.end(), point);
  if (label != r.node_label.end()) return static_cast<int>(label - r.node_label.begin());
  if (Eigen::Vector3d position; read_position(point, position)) {
    Eigen::Index nearest = 0;
    (r.position.colwise() - position).colwise().squaredNorm().minCoeff(&nearest);
    return static_cast<int>(nearest);
  }
  throw Error(fmt::format("has no node '{}'", printable_line(point, 60)), where,
              "give the name of a boundary node, a node label such as " +
                  listed(nearest_names(point, r.boundary_name)) + ", or coordinates x,y,z in the part frame");
}

}  // namespace tisserand::reducer
