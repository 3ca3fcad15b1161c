// Fixed joints and common nodes.
#include "mechanism/switching/welds.hpp"

#include <algorithm>

#include "mechanism/doubts/held_body.hpp"
#include "mechanism/switching/deformation.hpp"

namespace tisserand::mechanism {

std::vector<int> welded_parts(const Model& model) {
  std::vector<int> part = welded_beams(model), owner(model.nodes.size(), -1);
  for (std::size_t i = 0; i < model.superelements.size(); ++i)
    for (const int node : model.superelements[i].nodes) owner[node] = static_cast<int>(i);
  for (std::size_t i = part.size(); i < deforming_bodies(model); ++i) part.push_back(static_cast<int>(i));
  const auto before = static_cast<int>(model.superelements.size());
  for (const ModalNode& node : model.modal_nodes) owner[node.node] = before + node.body;
  for (const Joint& joint : model.joints) {
    const int a = joint.a.node < 0 ? -1 : owner[joint.a.node], b = joint.b.node < 0 ? -1 : owner[joint.b.node];
    if (joint.kind != JointKind::fixed || a < 0 || b < 0) continue;
    const int from = part[a], to = part[b];
    std::ranges::replace(part, from, to);
  }
  return part;
}

}  // namespace tisserand::mechanism
