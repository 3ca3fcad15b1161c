// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the checks of a scene: markers and coordinates that many entries use, and force elements.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "formats/scene/scene.hpp"
#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// Index of the bodies and joints of a scene by name, so that the time of checks is proportional to the number of
/// references. Requires that the scene outlives the index. Of several bodies with one name it holds the first.
struct SceneIndex {
  explicit SceneIndex(const Scene& of) : scene(of) {
    for (const BodySpec& body : scene.bodies)
      std::visit([&](const auto& spec) { bodies.try_emplace(spec.name, &body); }, body);
    for (const JointSpec& joint : scene.joints) joints.insert(joint.name);
  }

  const Scene& scene;
  std::unordered_map<std::string_view, const BodySpec*> bodies;
  std::unordered_set<std::string_view> joints;
};

/// Checks that body and node of the marker exist, and that its position and orientation are valid.
void check_marker(const SceneIndex& scene, const MarkerSpec& marker, const std::string& key, const Subject& subject);

/// Checks the two markers of a pair, that they are on different nodes, and the start position and axes that place them.
void check_marker_pair(const SceneIndex& scene, const MarkerPairSpec& pair, const Subject& subject);

/// Checks that the joint of the coordinate exists.
void check_coordinate(const CoordinateRef& coordinate, const SceneIndex& scene, const std::string& key,
                      const Subject& subject);

/// Checks the sizes of a solid, or the file name's ending of a mesh.
void check_shape(const ShapeSpec& shape, const Subject& subject);

/// Checks channels and inputs, whose names must differ from each other.
void check_channels(const SceneIndex& scene, Faults& faults);

/// Checks the friction of a joint; does nothing for a joint without friction.
void check_friction(const JointSpec& joint, const Subject& subject);
void check_initial(const SceneIndex& scene, const InitialSpec& initial, Faults& faults);
void check_spring(const SceneIndex& scene, const SpringSpec& spring, const Subject& subject);
void check_bushing(const SceneIndex& scene, const BushingSpec& bushing, const Subject& subject);
void check_road(const RoadSpec& road, const Subject& subject);
void check_tyre(const SceneIndex& scene, const TyreSpec& tyre, const Subject& subject);
void check_load(const SceneIndex& scene, const LoadSpec& load, const Subject& subject);
void check_part_load(const SceneIndex& scene, const PartLoadSpec& load, const Subject& subject);

/// Checks the ranges of the settings `integrator`, `statics`, `output` and `initial_tolerance`. Times of the integrator
/// are checked in dynamics only.
void check_settings(const Scene& scene, Faults& faults);

}  // namespace tisserand::formats
