// SPDX-License-Identifier: GPL-3.0-or-later
// Spiders, springs, point masses and boundary nodes of the mesh.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/elements/spring.hpp"
#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/places.hpp"
#include "reducer/sources/selection.hpp"

namespace tisserand::reducer {
namespace {

User user_of(const formats::SpiderLine& spider) { return {fmt::format("spider '{}'", spider.name), spider.where}; }

/// Legs of a spider with their weights.
std::map<int, double> legs_of(const MeshBuilder& builder, const formats::SpiderLine& line) {
  const User user = user_of(line);
  std::map<int, double> legs;
  for (const std::string& name : line.on)
    for (const auto& [node, weight] : node_weights(builder, select(builder, name, -1, user))) legs[node] += weight;
  Selection numbered;
  for (const long number : line.nodes) numbered.nodes.push_back(find_file_node(builder, number, user));
  if (!numbered.nodes.empty())
    for (const auto& [node, weight] : node_weights(builder, numbered)) legs[node] += weight;
  std::erase_if(legs, [&](const auto& leg) { return builder.used[leg.first] == 0; });
  if (legs.empty())
    throw Error(user.name + " connects no nodes: no element has a node there", user.where,
                "name a group of faces or edges that carry elements; `reducer groups` lists them");
  if (line.weights == formats::SpiderWeights::equal)
    for (auto& [node, weight] : legs) weight = 1.0;
  return legs;
}

Eigen::Vector3d mean(const MeshBuilder& builder, const std::map<int, double>& legs) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0.0;
  for (const auto& [node, weight] : legs) sum += weight * builder.position(node), total += weight;
  return sum / total;
}

/// Whether the legs are collinear, so that their translations do not define a rotation about the line: within 1e-5 of
/// their extent, as ties/averaging.cpp judges it.
bool on_one_line(const MeshBuilder& builder, const std::map<int, double>& legs) {
  const Eigen::Vector3d middle = mean(builder, legs);
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
  for (const auto& [node, weight] : legs)
    if (const Eigen::Vector3d arm = builder.position(node) - middle; arm.norm() > along.norm()) along = arm;
  return std::ranges::all_of(legs, [&](const auto& leg) {
    const Eigen::Vector3d arm = builder.position(leg.first) - middle;
    return arm.cross(along).norm() <= 1e-5 * along.squaredNorm();
  });
}

void add_spider(MeshBuilder& builder, const formats::SpiderLine& line) {
  const std::map<int, double> legs = legs_of(builder, line);
  Spider spider;
  spider.kind = line.type == formats::SpiderType::rigid ? SpiderKind::rigid : SpiderKind::averaging;
  spider.name = line.name;
  const bool own_centroid = line.at.kind == formats::PlaceKind::centroid && line.at.name.empty();
  spider.reference =
      own_centroid ? builder.add_node(mean(builder, legs), line.name) : find_place(builder, line.at, user_of(line));
  if (line.at.kind == formats::PlaceKind::position) builder.label.back() = line.name;
  // Mean rotations follow from translations, so those of nodes would count twice; about a line only they define them.
  if (spider.kind == SpiderKind::averaging && !on_one_line(builder, legs)) spider.node_components = translations_only;
  for (const auto& [node, weight] : legs) {
    if (node == spider.reference) continue;
    spider.nodes.push_back(node);
    if (spider.kind == SpiderKind::averaging) spider.weight.push_back(weight);
  }
  if (spider.nodes.empty())
    throw Error(fmt::format("spider '{}' connects no other node than its own", line.name), line.where,
                "name a larger group");
  builder.spider_node[line.name] = spider.reference;
  builder.mesh.spiders.push_back(std::move(spider));
}

void add_springs(MeshBuilder& builder) {
  for (const formats::SpringLine& line : builder.part.springs) {
    const User user{fmt::format("spring '{}'", line.name), line.where};
    Spring spring;
    spring.name = line.name;
    spring.first = find_place(builder, line.from, user);
    spring.second = find_place(builder, line.to, user);
    if (spring.first == spring.second)
      throw Error(user.name + " begins and ends at the same node", line.where, "name two places with different nodes");
    BushingPlace place;  // in the middle between the nodes
    place.first_arm = 0.5 * (builder.position(spring.second) - builder.position(spring.first));
    place.second_arm = -place.first_arm;
    place.R_PB = line.axes;
    spring.stiffness = bushing(line.stiffness, place);
    builder.mesh.springs.push_back(std::move(spring));
  }
}

void add_masses(MeshBuilder& builder) {
  for (const formats::PointMass& line : builder.part.point_masses) {
    const User user{fmt::format("point mass '{}'", line.name), line.where};
    builder.mesh.masses.push_back(
        {find_place(builder, line.at, user), line.mass, line.inertia, line.offset, line.name});
  }
}

void add_boundary(MeshBuilder& builder) {
  const formats::Part& part = builder.part;
  if (!part.boundary.empty()) builder.mesh.boundary.clear();
  if (builder.needs_boundary && part.boundary.empty() && builder.mesh.boundary.empty())
    throw Error("the part has no boundary node", part.file,
                part.mesh.file.empty() ? "name at least one point under `boundary`"
                                       : "name places under `boundary`: tip: {near: [x, y, z]}, or {node: 4711}");
  std::map<int, std::string> used;
  for (const formats::BoundaryNode& b : part.boundary) {
    const User user{fmt::format("boundary node '{}'", b.name), b.where};
    if (!b.translations && !b.rotations)
      throw Error(user.name + " retains neither translations nor rotations", b.where,
                  "retain one of them or remove the node");
    const int n = find_place(builder, b.at, user);
    if (const auto [other, fresh] = used.emplace(n, b.name); !fresh)
      throw Error(fmt::format("{} is at the same point as boundary node '{}'", user.name, other->second), b.where,
                  "keep one of the two");
    builder.mesh.boundary.push_back({b.name, n, b.translations, b.rotations});
  }
}

/// Adds held nodes: boundary nodes by their names, else points and spiders.
void add_held_nodes(MeshBuilder& builder) {
  if (!builder.part.modal_body) return;
  const formats::ModalBodyRequest& body = *builder.part.modal_body;
  for (const formats::ModalBodyRequest::Held& held : body.held) {
    const auto known = std::ranges::find(builder.mesh.boundary, held.place, &MeshBoundary::name);
    const int node = known != builder.mesh.boundary.end()
                         ? known->node
                         : find_place(builder, formats::Place(held.place), {"modal_body", body.where});
    builder.mesh.held.push_back({held.place, node, static_cast<Components>(held.components)});
  }
}

}  // namespace

void add_spider_nodes(MeshBuilder& builder) {
  for (const formats::SpiderLine& line : builder.part.spiders) add_spider(builder, line);
}

void add_attachments(MeshBuilder& builder) {
  add_springs(builder);
  add_masses(builder);
  add_boundary(builder);
  add_held_nodes(builder);
}

}  // namespace tisserand::reducer
