// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes from points, numbers, positions and centroids.
#include "reducer/sources/places.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/sources/selection.hpp"

namespace tisserand::reducer {
namespace {

std::string text(const Eigen::Vector3d& x) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", x.x(), x.y(), x.z()); }

std::vector<std::string> place_names(const MeshBuilder& builder) {
  std::vector<std::string> names;
  for (const formats::NamedPoint& point : builder.part.points) names.push_back(point.name);
  for (const formats::SpiderLine& spider : builder.part.spiders) names.push_back(spider.name);
  return names;
}

int node_of_name(MeshBuilder& builder, const std::string& name, const User& user) {
  if (const auto found = builder.point_node.find(name); found != builder.point_node.end()) return found->second;
  if (const auto found = builder.spider_node.find(name); found != builder.spider_node.end()) return found->second;
  const auto point = std::ranges::find(builder.part.points, name, &formats::NamedPoint::name);
  if (point != builder.part.points.end() && point->place) {
    const int node = find_place(builder, *point->place, {fmt::format("point '{}'", name), point->where});
    builder.label[node] = name;
    return builder.point_node[name] = node;
  }
  if (point != builder.part.points.end())
    throw Error(
        fmt::format("{}: no beam ends at point '{}', and no plate, spring or spider has a node there", user.name, name),
        user.where,
        builder.part.mesh.file.empty()
            ? "end a beam there, or use a point that has a node"
            : fmt::format("to take the nearest node of the mesh file, write {{near: {}}}", name));
  std::vector<std::string> known = place_names(builder);
  const std::optional<std::string> guess = nearest(name, known);
  throw Error(fmt::format("{}: point '{}' does not exist", user.name, name), user.where,
              guess ? fmt::format("did you mean '{}'?", *guess) : "known are " + listed(known));
}

}  // namespace

int find_file_node(const MeshBuilder& builder, long number, const User& user) {
  const auto found = builder.node_of_id.find(number);
  if (found != builder.node_of_id.end()) return found->second;
  long low = std::numeric_limits<long>::max(), high = 0;
  for (const auto& [id, node] : builder.node_of_id) low = std::min(low, id), high = std::max(high, id);
  throw Error(fmt::format("{}: {} has no node {}", user.name, builder.part.mesh.file, number), user.where,
              builder.node_of_id.empty() ? "" : fmt::format("its nodes have numbers from {} to {}", low, high));
}

int nearest_file_node(const MeshBuilder& builder, const Eigen::Vector3d& x, std::optional<double> tolerance,
                      const User& user) {
  NearestTwo found;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(found.distance), high = -low;
  for (int n = builder.first_file_node; n < builder.last_file_node; ++n) {
    if (builder.used[n] == 0) continue;
    low = low.cwiseMin(builder.position(n));
    high = high.cwiseMax(builder.position(n));
    found.look_at(n, (builder.position(n) - x).norm());
  }
  if (found.best < 0) throw Error(user.name + ": the mesh file has no nodes with elements", user.where, "");
  const double extent = (high - low).norm(), allowed = tolerance.value_or(1e-3 * extent);
  const auto label = [&](int n) { return builder.label[n]; };
  if (found.distance > allowed)
    throw Error(fmt::format("{}: the node nearest to {} is {} at {}, {:.3g} away; the tolerance is {:.3g}", user.name,
                            text(x), label(found.best), text(builder.position(found.best)), found.distance, allowed),
                user.where, "correct the position, or give a larger tolerance");
  if (found.is_ambiguous(extent))
    throw Error(
        fmt::format("{}: {} and {} are equally near to {}", user.name, label(found.best), label(found.second), text(x)),
        user.where, "move the position to one of them, or give its number");
  return found.best;
}

int find_place(MeshBuilder& builder, const formats::Place& place, const User& user) {
  switch (place.kind) {
    case formats::PlaceKind::name:
      return node_of_name(builder, place.name, user);
    case formats::PlaceKind::node:
      return find_file_node(builder, place.node, user);
    case formats::PlaceKind::near:
      return nearest_file_node(builder, place.position, place.tolerance, user);
    case formats::PlaceKind::position:
      if (const int on_patch = builder.patch_nodes.find(place.position); on_patch >= 0) return on_patch;
      return builder.add_node(place.position, fmt::format("{} at {}", user.name, text(place.position)));
    case formats::PlaceKind::centroid:
      break;
  }
  return builder.add_node(centroid(builder, {place.name}, user), "centroid of " + place.name);
}

}  // namespace tisserand::reducer
