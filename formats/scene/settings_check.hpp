// What is wrong with the settings of a run.
#pragma once

#include "formats/scene/scene.hpp"
#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// Ranges of integrator, statics, output and initial_tolerance; the times of the integrator only in dynamics.
void check_settings(const Scene& scene, Faults& faults);

}  // namespace tisserand::formats
