// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a scene that has been read.
#pragma once

#include "formats/scene/scene.hpp"
#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// All faults of a scene. check(scene) throws them.
Faults find_faults(const Scene& scene);

/// Checks definitions, used or unused.
void check_definitions(const std::vector<Material>& materials, const std::vector<Section>& sections, Faults& faults);

}  // namespace tisserand::formats
