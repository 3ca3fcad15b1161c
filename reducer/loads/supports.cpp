// SPDX-License-Identifier: GPL-3.0-or-later
// Components of supported nodes.
#include "reducer/loads/supports.hpp"

#include <map>

#include <fmt/format.h>

#include "common/error.hpp"

namespace tisserand::reducer {
namespace {

/// Components that follow a rigid spider, and its row; for turned axes all components of a triple.
struct Follower {
  Components components = 0;
  int spider = 0;
};

std::map<int, Follower> followers(const Mesh& mesh) {
  std::map<int, Follower> result;
  for (int s = 0; s < std::ssize(mesh.spiders); ++s) {
    const Spider& spider = mesh.spiders[s];
    if (spider.kind != SpiderKind::rigid) continue;
    Components components = spider.node_components;
    if (!spider.axes.isIdentity(0.0))
      for (const Components triple : {translations_only, rotations_only})
        if ((components & triple) != 0) components |= triple;
    for (const int node : spider.nodes) result[node] = {components, s};
  }
  return result;
}

}  // namespace

std::vector<OwnedCoordinate> held_coordinates(const Mesh& mesh, const Coordinates& coordinates) {
  const std::map<int, Follower> following = followers(mesh);
  std::map<int, int> held;
  for (int s = 0; s < std::ssize(mesh.supports); ++s) {
    const MeshSupport& support = mesh.supports[s];
    for (const int node : support.nodes) {
      const bool rotates = coordinates.rotates(node);
      if (!rotates && !support.where_present && (support.components & rotations_only) != 0)
        throw Error(fmt::format("support '{}' holds rotations, but {} has none: only solid elements meet there",
                                support.name, mesh.node_label[node]),
                    support.where, "hold translations, or a spider that connects several nodes there");
      const Components components = rotates ? support.components : support.components & translations_only;
      if (const auto leg = following.find(node); leg != following.end() && (leg->second.components & components) != 0)
        throw Error(fmt::format("support '{}' holds {}, which follows the rigid spider '{}'", support.name,
                                mesh.node_label[node], mesh.spiders[leg->second.spider].name),
                    support.where, "hold the spider's own node");
      for (int c = 0; c < (rotates ? 6 : 3); ++c)
        if ((components >> c & 1) != 0) held.try_emplace(coordinates.of(node, c), s);
    }
  }
  std::vector<OwnedCoordinate> result;
  for (const auto& [x, support] : held) result.push_back({x, support});
  return result;
}

}  // namespace tisserand::reducer
