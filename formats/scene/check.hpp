// What is wrong with a scene that can be read.
#pragma once

#include "formats/scene/scene.hpp"
#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// All findings; check(scene) throws them.
Faults find_faults(const Scene& scene);

/// Findings of definitions that bodies may or may not use.
void check_definitions(const std::vector<Material>& materials, const std::vector<Section>& sections, Faults& faults);

}  // namespace tisserand::formats
