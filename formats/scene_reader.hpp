// Parts of reading scene.yaml: what stands below `bodies`, `joints`, `motions`, `springs`,
// `bushings` and `loads`.
#pragma once

#include <string>
#include <vector>

#include "formats/scene.hpp"
#include "formats/yaml_reader.hpp"

namespace tisserand::formats {

/// What bodies may refer to.
struct SceneDefinitions {
  std::string folder;  ///< of the scene file: paths are relative to it
  Units units;
  std::vector<Material> materials;
  std::vector<Section> sections;
};

/// "ground", "body", "body/node", or {node: .., position: .., orientation: ..}.
MarkerSpec read_marker(const MapReader& map, const std::string& key);
/// a, b, position, axis, x_axis.
void read_marker_pair(const MapReader& map, MarkerPairSpec& pair);
CoordinateRef read_coordinate(const MapReader& map, const YamlNode& node, const std::string& key);

std::vector<BodySpec> read_bodies(const MapReader& map, const SceneDefinitions& definitions);
/// `joints`: joints, and gears and racks between their coordinates.
void read_joints(const MapReader& map, Scene& scene);
std::vector<InputSpec> read_inputs(const MapReader& map, const SceneDefinitions& definitions);
std::vector<ChannelSpec> read_channels(const MapReader& map);
std::vector<MotionSpec> read_motions(const MapReader& map, const SceneDefinitions& definitions);
std::vector<SpringSpec> read_springs(const MapReader& map, const SceneDefinitions& definitions);
std::vector<BushingSpec> read_bushings(const MapReader& map);
std::vector<LoadSpec> read_loads(const MapReader& map, const SceneDefinitions& definitions);

}  // namespace tisserand::formats
