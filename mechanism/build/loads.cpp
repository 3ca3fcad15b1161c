// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of loads, and the functions of time of their components.
#include "mechanism/build/loads.hpp"

#include "common/error.hpp"
#include "mechanism/build/joints.hpp"

namespace tisserand::mechanism {
namespace {

void check_load_node(const formats::LoadSpec& spec, const Load& load, const Construction& c) {
  const Node& node = c.model.nodes[load.at.node];
  if (spec.kind == formats::LoadKind::moment && !has_rotation(c.model, load.at.node))
    throw Error(fmt::format("moment '{}' acts on node '{}', which has no rotations", spec.name, node.name), spec.where,
                "use forces, or keep the rotations of that node in the superelement");
  if (spec.kind == formats::LoadKind::force && !has_translation(c.model, load.at.node))
    throw Error(fmt::format("force '{}' acts on node '{}', which has no translations", spec.name, node.name),
                spec.where, "use moments, or keep the translations of that node in the superelement");
  if (!has_rotation(c.model, load.at.node) &&
      (spec.axes == formats::LoadAxes::body || load.at.p.norm() > 1e-12 * c.model.length))
    throw Error(fmt::format("force '{}' {} node '{}', which has no rotations", spec.name,
                            spec.axes == formats::LoadAxes::body ? "follows" : "acts away from", node.name),
                spec.where,
                "apply it at the node in world axes, or keep the rotations of that node in the superelement");
}

}  // namespace

void add_load(const formats::LoadSpec& spec, Construction& c) {
  Load load;
  load.name = spec.name;
  load.kind = spec.kind;
  load.axes = spec.axes;
  load.at = c.markers.find(spec.at);
  load.components = spec.components;
  load.where = spec.where;
  if (load.at.node < 0 && load.at.follower < 0)
    throw Error(fmt::format("load '{}' acts on ground", spec.name), spec.where, "name a node of a body");
  if (load.at.node >= 0) check_load_node(spec, load, c);
  const int index = count_of(c.model.loads);
  for (int k = 0; k < 3; ++k)
    note_function(spec.components[k], {ChannelUse::Owner::load, index, k, 0, 0}, c.model, c.breakpoints);
  c.model.loads.push_back(std::move(load));
}

}  // namespace tisserand::mechanism
