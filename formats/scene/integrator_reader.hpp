// SPDX-License-Identifier: GPL-3.0-or-later
// Reads `integrator` of scene.yaml into the struct IntegratorSpec.
#pragma once

#include <vector>

#include "formats/scene/scene.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

inline constexpr Choice<ErrorNorm> error_norms[] = {{"max", ErrorNorm::max},
                                                    {"rms", ErrorNorm::rms},
                                                    {"final", ErrorNorm::final},
                                                    {"peak", ErrorNorm::peak},
                                                    {"peak_time", ErrorNorm::peak_time}};

/// Reads the settings of the integrator. Times may be absent if `analysis` needs none.
IntegratorSpec read_integrator(const MapReader& map, AnalysisKind analysis);
std::vector<KeySet> integrator_key_sets();

}  // namespace tisserand::formats
