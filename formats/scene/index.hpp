// Names of a scene by look-up, so that checking its references takes time in proportion to their number.
#pragma once

#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "formats/scene/scene.hpp"

namespace tisserand::formats {

/// Refers to a scene that outlives it; of bodies with one name the first counts.
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

}  // namespace tisserand::formats
