// scene.yaml to the struct Scene.
#include "formats/scene.hpp"

#include <filesystem>

#include "formats/geometry_reader.hpp"
#include "formats/integrator_reader.hpp"
#include "formats/scene_check.hpp"
#include "formats/scene_keys.hpp"
#include "formats/scene_reader.hpp"
#include "formats/scene_tree.hpp"
#include "formats/section_reader.hpp"
#include "formats/units_reader.hpp"

namespace tisserand::formats {

namespace {

StaticsSpec read_statics(const MapReader& map) {
  StaticsSpec spec;
  spec.load_steps = map.integer("load_steps", spec.load_steps);
  spec.tolerance = map.number("tolerance", spec.tolerance);
  spec.max_iterations = map.integer("max_iterations", spec.max_iterations);
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

/// The settings below `integrator`, `statics` and `output`.
void read_settings(const MapReader& map, Scene& scene) {
  YamlReader& reader = map.context().reader;
  const auto context = [&](const std::string& subject) { return Context{reader, subject, scene.file}; };
  scene.analysis = map.choice(
      "analysis", {Choice<AnalysisKind>{"dynamics", AnalysisKind::dynamics}, {"statics", AnalysisKind::statics}},
      AnalysisKind::dynamics);
  const YamlNode* integrator =
      scene.analysis == AnalysisKind::dynamics ? map.require("integrator") : map.find("integrator");
  if (integrator != nullptr)
    scene.integrator =
        read_integrator(MapReader(context("integrator"), *integrator, "integrator", "integrator."), scene.analysis);
  if (const YamlNode* statics = map.find("statics"))
    scene.statics = read_statics(MapReader(context("statics"), *statics, "statics", "statics."));
  scene.output.from = scene.integrator.start;
  if (const YamlNode* output = map.find("output"))
    scene.output = read_output(MapReader(context("output"), *output, "output", "output."), scene.integrator.start);
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
  read_settings(map, scene);
  scene.initial_tolerance = map.number("initial_tolerance", scene.initial_tolerance);
  return scene;
}

}  // namespace

Scene read_scene(const std::string& path, const std::vector<Override>& overrides) {
  const YamlDocument document = load_scene_tree(path, overrides);
  YamlReader reader(document, scene_key_sets());
  require_kind(reader, "scene", "part", "make a superelement of it with `reducer run`");
  Faults faults;
  Scene scene = read_tree(reader, path, faults);
  for (Fault& fault : find_faults(scene).list) faults.list.push_back(std::move(fault));
  reader.raise(faults);
  return scene;
}

}  // namespace tisserand::formats
