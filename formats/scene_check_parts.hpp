// Parts of checking a scene: markers and coordinates that many entries use, and the force elements.
#pragma once

#include <string>

#include "formats/fault.hpp"
#include "formats/scene.hpp"

namespace tisserand::formats {

/// The body and node exist; position and orientation are valid.
void check_marker(const Scene& scene, const MarkerSpec& marker, const std::string& subject, const std::string& where,
                  const std::string& key, Faults& faults);

/// Both markers, on different nodes, and the position and axes that place them.
void check_marker_pair(const Scene& scene, const MarkerPairSpec& pair, const std::string& subject,
                       const std::string& where, Faults& faults);

/// The joint of the coordinate exists.
void check_coordinate(const CoordinateRef& coordinate, const Scene& scene, const std::string& subject,
                      const std::string& where, const std::string& key, Faults& faults);

/// Channels and inputs; their names share one list.
void check_channels(const Scene& scene, Faults& faults);

/// Of a joint that has one.
void check_friction(const JointSpec& joint, const std::string& subject, Faults& faults);
void check_spring(const Scene& scene, const SpringSpec& spring, Faults& faults);
void check_bushing(const Scene& scene, const BushingSpec& bushing, Faults& faults);
void check_load(const Scene& scene, const LoadSpec& load, Faults& faults);

}  // namespace tisserand::formats
