// SPDX-License-Identifier: GPL-3.0-or-later
// Readers of the parts of scene.yaml, one per key (`bodies`, `joints`, ..., `analyses`).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

inline constexpr Choice<AnalysisKind> analysis_kinds[] = {{"dynamics", AnalysisKind::dynamics},
                                                          {"statics", AnalysisKind::statics},
                                                          {"assembly", AnalysisKind::assembly},
                                                          {"kinematics", AnalysisKind::kinematics},
                                                          {"inverse_dynamics", AnalysisKind::inverse_dynamics},
                                                          {"modes", AnalysisKind::modes}};

/// Units of the scene, and the materials and sections that its bodies may use.
struct SceneDefinitions {
  Units units;
  std::vector<Material> materials;
  std::vector<Section> sections;
};

/// Reads a marker: "ground", "body", "body/node", or {node: .., position: .., orientation: ..}.
MarkerSpec read_marker(const MapReader& map, const std::string& key);
/// Reads a pose {position: .., orientation: ..}. `prefix`: text before its keys in findings of the check.
Pose read_pose(const Context& context, const YamlNode& node, const std::string& prefix);
CoordinateRef read_coordinate(const MapReader& map, const YamlNode& node, const std::string& key);

// Readers of keys that are members (formats/yaml/fields.hpp).
void read_value(const MapReader& map, const Field& field, Pose& value);
void read_value(const MapReader& map, const Field& field, MarkerSpec& value);
void read_value(const MapReader& map, const Field& field, CoordinateRef& value);
void read_value(const MapReader& map, const Field& field, std::optional<CoordinateRef>& value);
void read_value(const MapReader& map, const Field& field, std::vector<NodeWeight>& value);
void read_value(const MapReader& map, const Field& field, TimeFunctionSpec& value);
void read_value(const MapReader& map, const Field& field, std::optional<TimeFunctionSpec>& value);
void read_value(const MapReader& map, const Field& field, LawSpec& value);
void read_value(const MapReader& map, const Field& field, Eigen::Matrix<double, 6, 6>& value);
void read_value(const MapReader& map, const Field& field, Eigen::Matrix<double, 6, 1>& value);
void read_value(const MapReader& map, const Field& field, std::optional<Eigen::Matrix<double, 6, 1>>& value);

/// Reads `shape` of a body.
std::vector<ShapeSpec> read_shapes(const MapReader& body, const SceneDefinitions& definitions);
/// Reads `effects` of the scene.
void read_effects(const MapReader& map, Scene& scene);
std::vector<BodySpec> read_bodies(const MapReader& map, const SceneDefinitions& definitions);
/// Reads `joints`: joints, and gears and racks between their coordinates.
void read_joints(const MapReader& map, Scene& scene);
/// Reads `inputs` and `channels`.
void read_channels(const MapReader& map, Scene& scene);
std::vector<InitialSpec> read_initial(const MapReader& map);
void read_springs(const MapReader& map, std::vector<SpringSpec>& springs);
void read_bushings(const MapReader& map, std::vector<BushingSpec>& bushings);
/// Reads the heights of a road of kind grid or crg, from `file` or from axes and `z`, in lengths of the scene. Returns
/// null after an error.
std::shared_ptr<const RoadHeights> read_road_heights(const MapReader& map, const SceneDefinitions& definitions,
                                                     RoadKind kind);
void read_roads(const MapReader& map, const SceneDefinitions& definitions, std::vector<RoadSpec>& roads);
void read_tyres(const MapReader& map, const SceneDefinitions& definitions, std::vector<TyreSpec>& tyres);
/// Reads `loads`: loads on markers, and part loads (`type: part_load`).
void read_loads(const MapReader& map, Scene& scene);
/// Reads `analysis` with its groups of settings (`integrator`, `output`, ...), or `analyses`.
void read_analyses(const MapReader& map, Scene& scene);
/// Reads the groups of settings (`integrator`, `output`, ...) below `map`, which is the scene or one analysis. Requires
/// that `analysis` has its kind. `start`: start time of the integrator if `map` gives none.
void read_groups(const MapReader& map, std::optional<double> start, Analysis& analysis);

// Lists of fields, each defined with the functions that read them.
std::vector<Field> scene_fields();
std::vector<KeySet> effect_key_sets();
std::vector<KeySet> body_key_sets();
std::vector<KeySet> shape_of_body_key_sets();
NamedType shape_of_body_type();
Field shape_field();
std::vector<KeySet> joint_key_sets();
std::vector<KeySet> force_key_sets();
std::vector<KeySet> tyre_key_sets();
std::vector<KeySet> channel_key_sets();
std::vector<KeySet> analysis_key_sets();
std::vector<KeySet> settings_key_sets();

}  // namespace tisserand::formats
