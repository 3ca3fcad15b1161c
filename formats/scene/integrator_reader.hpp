// `integrator` of scene.yaml to the struct IntegratorSpec.
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

/// Times may be missing where the analysis needs none.
IntegratorSpec read_integrator(const MapReader& map, AnalysisKind analysis);
std::vector<KeySet> integrator_key_sets();

}  // namespace tisserand::formats
