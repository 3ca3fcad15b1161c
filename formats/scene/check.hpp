// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a scene that has been read.
#pragma once

#include "formats/scene/scene.hpp"
#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// All faults of a scene. check(scene) throws them as one Error.
Faults find_faults(const Scene& scene);

/// Adds the faults of all materials and sections, also of unused ones, to `faults`.
void check_definitions(const std::vector<Material>& materials, const std::vector<Section>& sections, Faults& faults);

}  // namespace tisserand::formats
