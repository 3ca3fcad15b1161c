// scene.yaml to the struct Scene.
#include "formats/scene/scene.hpp"

#include <filesystem>

#include "formats/scene/check.hpp"
#include "formats/scene/expand/tree.hpp"
#include "formats/scene/integrator_reader.hpp"
#include "formats/scene/keys.hpp"
#include "formats/scene/reader.hpp"
#include "formats/sections/reader.hpp"
#include "formats/yaml/geometry.hpp"
#include "formats/yaml/units_reader.hpp"

namespace tisserand::formats {

namespace {

RotationSpec read_rotation(const MapReader& map, const YamlNode& node) {
  const Context context{map.context().reader, map.context().subject + ": rotation", map.context().entry};
  const MapReader inner(context, node, "steady_rotation", "statics.rotation.");
  RotationSpec spec;
  if (inner.require("angular_velocity") != nullptr)
    spec.angular_velocity = read_vector(inner, "angular_velocity", spec.angular_velocity);
  spec.about = read_vector(inner, "about", spec.about);
  return spec;
}

StaticsSpec read_statics(const MapReader& map) {
  StaticsSpec spec;
  if (const YamlNode* rotation = map.find("rotation")) spec.rotation = read_rotation(map, *rotation);
  spec.load_steps = map.integer("load_steps", spec.load_steps);
  spec.tolerance = map.number("tolerance", spec.tolerance);
  spec.max_iterations = map.integer("max_iterations", spec.max_iterations);
  return spec;
}

ModesSpec read_modes(const MapReader& map) {
  ModesSpec spec;
  spec.count = map.integer("count", spec.count);
  if (map.has("rotation")) spec.rotation = read_vector(map, "rotation", Eigen::Vector3d::Zero());
  return spec;
}

CheckpointSpec read_checkpoint(const MapReader& map) {
  CheckpointSpec spec;
  if (map.has("every") && map.has("interval")) map.fail("both 'every' and 'interval' are given", "give one of them");
  if (map.has("every")) spec.every = map.integer("every", 1);
  if (map.has("interval")) spec.interval = map.number("interval");
  return spec;
}

/// `start` is that of the integrator: all is stored unless the file says otherwise.
OutputSpec read_output(const MapReader& map, double start) {
  OutputSpec spec;
  if (map.has("every") && map.has("interval")) map.fail("both 'every' and 'interval' are given", "give one of them");
  spec.every = map.integer("every", spec.every);
  if (map.has("interval")) spec.interval = map.number("interval");
  spec.from = map.number("from", start);
  const YamlNode* channels = map.find("channels");
  if (channels == nullptr) return spec;
  if (channels->kind != YamlKind::sequence) {
    map.context().fail(channels->place, fmt::format("channels must be a list, not {}", describe(*channels)),
                       "write it as [nodes, energy]");
    return spec;
  }
  for (const YamlNode& channel : channels->children)
    spec.channels.push_back(read_text(map.context(), channel, "a channel"));
  return spec;
}

Scene read_tree(YamlReader& reader, const std::string& path, Faults& faults) {
  const MapReader map(Context{reader, "", path}, reader.root(), "scene");
  Scene scene;
  scene.file = path;
  scene.name = map.text("scene");
  scene.units = read_units(map);
  scene.gravity = read_vector(map, "gravity", scene.gravity);
  const SceneDefinitions definitions{std::filesystem::path(path).parent_path().string(), scene.units,
                                     read_materials(map), read_sections(map, scene.units)};
  check_definitions(definitions.materials, definitions.sections, faults);
  scene.bodies = read_bodies(map, definitions);
  read_joints(map, scene);
  scene.inputs = read_inputs(map, definitions);
  scene.channels = read_channels(map);
  scene.motions = read_motions(map, definitions);
  scene.springs = read_springs(map, definitions);
  scene.bushings = read_bushings(map);
  scene.loads = read_loads(map, definitions);
  scene.virtual_bodies = map.choice(
      "virtual_bodies", {Choice<VirtualBodies>{"keep", VirtualBodies::keep}, {"eliminate", VirtualBodies::eliminate}},
      scene.virtual_bodies);
  read_analyses(map, scene);
  scene.initial_tolerance = map.number("initial_tolerance", scene.initial_tolerance);
  return scene;
}

}  // namespace

void read_groups(const MapReader& map, const Context& entry, std::optional<double> start, Analysis& analysis) {
  const std::string before = entry.subject.empty() ? "" : entry.subject + ": ";
  const auto group = [&](std::string_view key, const YamlNode& node) {
    return MapReader(Context{entry.reader, fmt::format("{}{}", before, key), entry.entry}, node, key,
                     fmt::format("{}.", key));
  };
  const YamlNode* integrator = takes_steps(analysis.kind) ? map.require("integrator") : map.find("integrator");
  if (start) analysis.integrator.start = *start;
  if (integrator != nullptr) {
    const MapReader inner = group("integrator", *integrator);
    analysis.integrator = read_integrator(inner, analysis.kind);
    if (start && !inner.has("start")) analysis.integrator.start = *start;
  }
  if (const YamlNode* node = map.find("statics")) analysis.statics = read_statics(group("statics", *node));
  if (const YamlNode* node = map.find("modes")) analysis.modes = read_modes(group("modes", *node));
  if (const YamlNode* node = map.find("checkpoint")) analysis.checkpoint = read_checkpoint(group("checkpoint", *node));
  analysis.output.from = analysis.integrator.start;
  if (const YamlNode* node = map.find("output"))
    analysis.output = read_output(group("output", *node), analysis.integrator.start);
}

Scene read_scene(const std::string& path, const std::vector<Override>& overrides) {
  const YamlDocument document = load_scene_tree(path, overrides, scene_key_sets());
  YamlReader reader(document, scene_key_sets());
  require_kind(reader, "scene", "part", "make a superelement of it with `reducer run`");
  Faults faults;
  Scene scene = read_tree(reader, path, faults);
  for (Fault& fault : find_faults(scene).list) faults.list.push_back(std::move(fault));
  reader.raise(faults);
  return scene;
}

}  // namespace tisserand::formats
