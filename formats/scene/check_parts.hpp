// Parts of checking a scene: markers and coordinates that many entries use, and the force elements.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "formats/scene/scene.hpp"
#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// Names of a scene by look-up, so that checking its references takes time in proportion to their number. It refers
/// to a scene that outlives it; of bodies with one name the first counts.
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

/// The body and node exist; position and orientation are valid.
void check_marker(const SceneIndex& scene, const MarkerSpec& marker, const std::string& key, const Subject& subject);

/// Both markers, on different nodes, and the position and axes that place them.
void check_marker_pair(const SceneIndex& scene, const MarkerPairSpec& pair, const Subject& subject);

/// The joint of the coordinate exists.
void check_coordinate(const CoordinateRef& coordinate, const SceneIndex& scene, const std::string& key,
                      const Subject& subject);

/// Sizes of a solid, ending of a file.
void check_shape(const ShapeSpec& shape, const Subject& subject);

/// Channels and inputs; their names share one list.
void check_channels(const SceneIndex& scene, Faults& faults);

/// Of a joint that has one.
void check_friction(const JointSpec& joint, const Subject& subject);
void check_initial(const SceneIndex& scene, const InitialSpec& initial, Faults& faults);
void check_spring(const SceneIndex& scene, const SpringSpec& spring, const Subject& subject);
void check_bushing(const SceneIndex& scene, const BushingSpec& bushing, const Subject& subject);
void check_road(const RoadSpec& road, const Subject& subject);
void check_tyre(const SceneIndex& scene, const TyreSpec& tyre, const Subject& subject);
void check_load(const SceneIndex& scene, const LoadSpec& load, const Subject& subject);
void check_part_load(const SceneIndex& scene, const PartLoadSpec& load, const Subject& subject);

/// Ranges of integrator, statics, output and initial_tolerance; the times of the integrator only in dynamics.
void check_settings(const Scene& scene, Faults& faults);

}  // namespace tisserand::formats
