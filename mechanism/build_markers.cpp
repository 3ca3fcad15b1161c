// Finding places by name.
#include "mechanism/build_markers.hpp"

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

/// The place that a marker names (without the marker's own offset).
Marker find_place(const std::map<std::string, Marker>& places, const formats::MarkerSpec& spec) {
  if (spec.node == "ground") return {};
  const auto found = places.find(spec.node);
  if (found != places.end()) return found->second;
  std::vector<std::string> names{"ground"};
  for (const auto& [name, marker] : places) names.push_back(name);
  const auto suggestion = nearest(spec.node, names);
  if (names.size() > 12) names = {names.begin(), names.begin() + 12};
  throw Error(fmt::format("there is no node '{}'", spec.node), spec.where,
              suggestion ? fmt::format("did you mean '{}'?", *suggestion)
                         : "the scene has " + join(names, ", ") + (places.size() > 11 ? ", ..." : ""));
}

Marker with_offset(Marker marker, const formats::MarkerSpec& spec) {
  if (spec.position) marker.p += marker.R * *spec.position;
  if (spec.orientation) marker.R *= spec.orientation->normalized().toRotationMatrix();
  return marker;
}

}  // namespace

Marker MarkerTable::find(const formats::MarkerSpec& spec) const { return with_offset(find_place(places, spec), spec); }

void check_marker(const Model& model, const std::string& subject, MarkerUse use, const formats::MarkerSpec& place,
                  const Marker& marker) {
  if (marker.node < 0) return;
  const Node& node = model.nodes[static_cast<std::size_t>(marker.node)];
  if (node.translation < 0)
    throw Error(fmt::format("{} holds the position of node '{}', which has no translations", subject, place.node),
                place.where, "keep the translations of that node in the superelement");
  if (node.rotation >= 0) return;
  if (use == MarkerUse::position_and_axes)
    throw Error(fmt::format("{} holds the rotation of node '{}', which has none", subject, place.node), place.where,
                "use a spherical joint, or keep the rotations of that node in the superelement");
  if (marker.p.norm() > 1e-12 * model.length)
    throw Error(fmt::format("{} is {:.3g} away from node '{}', which has no rotations to carry the offset", subject,
                            marker.p.norm(), place.node),
                place.where, "put it at the node, or keep the rotations of that node in the superelement");
}

}  // namespace tisserand::mechanism
