// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates of the nodes and their names.
#include "reducer/mesh/coordinates.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "common/text.hpp"

namespace tisserand::reducer {
namespace {

/// Nodes that have elements, use rotations, or are used at all.
struct Use {
  std::vector<bool> element, rotation, any;
};

void use_element(const Mesh& mesh, int e, Use& use) {
  const auto surfaces = mesh.beams.size() + mesh.shells.size();
  const auto k = static_cast<std::size_t>(e);
  const bool turns = k < surfaces || k >= surfaces + mesh.solids.size();
  for (const int n : element_nodes(mesh, e)) {
    use.element[n] = use.any[n] = true;
    if (turns) use.rotation[n] = true;
  }
}

void use_ties(const Mesh& mesh, Use& use) {
  for (const Spider& spider : mesh.spiders) {
    use.any[spider.reference] = use.rotation[spider.reference] = true;
    for (const int node : spider.nodes) {
      use.any[node] = true;
      const bool turned = spider.kind == SpiderKind::rigid && (spider.node_components & rotations_only) != 0;
      if (turned && !use.element[node]) use.rotation[node] = true;
    }
  }
  for (const TieEquation& equation : mesh.equations)
    for (const TieTerm& term : equation.terms) {
      use.any[term.node] = true;
      if (term.component >= 3) use.rotation[term.node] = true;
    }
}

Use find_use(const Mesh& mesh) {
  const std::vector<bool> none(static_cast<std::size_t>(mesh.nodes()), false);
  Use use{none, none, none};
  for (int e = 0; e < mesh.elements(); ++e) use_element(mesh, e, use);
  for (const NodalMass& mass : mesh.masses) {
    use.any[mass.node] = true;
    if (!mass.inertia.isZero(0.0) || !mass.offset.isZero(0.0)) use.rotation[mass.node] = true;
  }
  use_ties(mesh, use);
  return use;
}

}  // namespace

ElementNodes element_nodes(const Mesh& mesh, int element) {
  const auto copy = [](const auto& nodes) {
    ElementNodes result;
    result.count = static_cast<int>(std::copy(nodes.begin(), nodes.end(), result.node.begin()) - result.node.begin());
    return result;
  };
  auto k = static_cast<std::size_t>(element);
  if (k < mesh.beams.size()) return copy(nodes_of(mesh.beams[k]));
  k -= mesh.beams.size();
  if (k < mesh.shells.size()) return copy(nodes_of(mesh.shells[k]));
  k -= mesh.shells.size();
  if (k < mesh.solids.size()) return copy(nodes_of(mesh.solids[k]));
  return copy(nodes_of(mesh.springs[k - mesh.solids.size()]));
}

Coordinates number_coordinates(const Mesh& mesh) {
  const Use use = find_use(mesh);
  Coordinates c;
  c.first.reserve(static_cast<std::size_t>(mesh.nodes()) + 1);
  c.first.push_back(0);
  for (int n = 0; n < mesh.nodes(); ++n) {
    const int size = use.rotation[n] ? 6 : 3;
    for (int k = 0; k < size; ++k) {
      c.node.push_back(n);
      c.component.push_back(k);
    }
    c.first.push_back(c.first.back() + size);
  }
  return c;
}

void check_used(const Mesh& mesh, const std::string& where) {
  const Use use = find_use(mesh);
  const auto unused = std::count(use.any.begin(), use.any.end(), false);
  if (unused == 0) return;
  std::vector<std::string> names;
  for (std::size_t n = 0; n < use.any.size() && names.size() < 10; ++n)
    if (!use.any[n]) names.push_back(mesh.node_label[n]);
  throw Error(fmt::format("{} nodes are used by no element and no spider: {}", unused,
                          listed(names, ", ", static_cast<std::size_t>(unused))),
              where, "remove them, or connect them by an element or a spider");
}

void check_retained(const Mesh& mesh, const Coordinates& coordinates, const std::string& where) {
  for (const MeshBoundary& b : mesh.boundary)
    if (b.rotations && !coordinates.rotates(b.node))
      throw Error(fmt::format("boundary node '{}' retains rotations, but {} has none: only solid elements meet there",
                              b.name, mesh.node_label[b.node]),
                  where, "retain translations only, or connect a boundary node by a spider to several nodes there");
}

Eigen::MatrixXd rigid_motions(const Mesh& mesh, const Coordinates& coordinates, const Eigen::Vector3d& point) {
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(coordinates.count(), 6);
  for (int a = 0; a < mesh.nodes(); ++a) {
    const int first = coordinates.of(a, 0);
    R.block<3, 3>(first, 0).setIdentity();
    R.block<3, 3>(first, 3) = -skew<double>(mesh.position.col(a) - point);
    if (coordinates.rotates(a)) R.block<3, 3>(first + 3, 3).setIdentity();
  }
  return R;
}

std::vector<int> coordinates_of(const std::vector<OwnedCoordinate>& owned) {
  std::vector<int> x;
  for (const OwnedCoordinate& one : owned) x.push_back(one.x);
  return x;
}

std::string component_text(int component) {
  constexpr std::array<const char*, 6> words{"translation x", "translation y", "translation z",
                                             "rotation x",    "rotation y",    "rotation z"};
  return words[component];
}

}  // namespace tisserand::reducer
