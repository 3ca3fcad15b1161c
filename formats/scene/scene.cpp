// SPDX-License-Identifier: GPL-3.0-or-later
// Reads scene.yaml into the struct Scene.
#include "formats/scene/scene.hpp"

#include <filesystem>

#include "formats/scene/check.hpp"
#include "formats/scene/check_parts.hpp"
#include "formats/scene/expand/tree.hpp"
#include "formats/scene/fields.hpp"
#include "formats/scene/integrator_reader.hpp"
#include "formats/scene/reader.hpp"
#include "formats/sections/reader.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/name_check.hpp"
#include "formats/yaml/units_reader.hpp"

namespace tisserand::formats {
namespace {

constexpr Choice<VirtualBodies> virtual_body_ways[] = {{"keep", VirtualBodies::keep},
                                                       {"eliminate", VirtualBodies::eliminate}};

/// Reads the frequency at which something is written.
template <class Spec>
void read_rhythm(const MapReader& map, Spec& spec) {
  if (map.has("every") && map.has("interval")) map.fail("both 'every' and 'interval' are given", "give one of them");
  read_fields(map, spec);
}

/// Reads `output`. By default everything is stored, from the start of the integrator on.
void read_output(const MapReader& map, double start, OutputSpec& spec) {
  spec.from = start;
  read_rhythm(map, spec);
  const YamlNode* channels = map.find("channels");
  if (channels == nullptr) return;
  if (channels->kind != YamlKind::sequence)
    map.context().fail(channels->place, fmt::format("channels must be a list, not {}", describe(*channels)),
                       "write it as [nodes, energy]");
  for (const YamlNode& channel : channels->children)
    if (channels->kind == YamlKind::sequence) spec.channels.push_back(read_text(map.context(), channel, "a channel"));
}

Scene read_tree(YamlReader& reader, const std::string& path, Faults& faults) {
  const MapReader map(Context{reader, "", path}, reader.root(), "scene");
  Scene scene;
  scene.file = path;
  read_fields(map, scene);
  scene.units = read_units(map);
  const SceneDefinitions definitions{scene.units, read_materials(map), read_sections(map, scene.units)};
  check_definitions(definitions.materials, definitions.sections, faults);
  read_effects(map, scene);
  scene.bodies = read_bodies(map, definitions);
  read_joints(map, scene);
  read_channels(map, scene);
  read_entries(map, "motions", "motion", scene.motions);
  scene.initial = read_initial(map);
  read_springs(map, scene.springs);
  read_bushings(map, scene.bushings);
  read_roads(map, definitions, scene.roads);
  read_tyres(map, definitions, scene.tyres);
  read_loads(map, scene);
  read_analyses(map, scene);
  return scene;
}

/// Adds the values of all keys `file` below `node`.
void add_named_files(const YamlNode& node, const std::filesystem::path& folder, std::vector<std::string>& files) {
  if (node.key == "file" && node.kind == YamlKind::scalar && !node.text.empty())
    files.push_back((folder / node.text).lexically_normal().string());
  for (const YamlNode& child : node.children) add_named_files(child, folder, files);
}

}  // namespace

void read_groups(const MapReader& map, std::optional<double> start, Analysis& analysis) {
  const YamlNode* integrator = takes_steps(analysis.kind) ? map.require("integrator") : map.find("integrator");
  if (start) analysis.integrator.start = *start;
  if (integrator != nullptr) {
    const MapReader inner = map.inside(*integrator, "integrator");
    analysis.integrator = read_integrator(inner, analysis.kind);
    if (start && !inner.has("start")) analysis.integrator.start = *start;
  }
  if (const YamlNode* node = map.find("checkpoint")) read_rhythm(map.inside(*node, "checkpoint"), analysis.checkpoint);
  analysis.output.from = analysis.integrator.start;
  if (const YamlNode* node = map.find("output"))
    read_output(map.inside(*node, "output"), analysis.integrator.start, analysis.output);
}

std::vector<KeySet> settings_key_sets() {
  return {
      {"statics",
       {plain<&StaticsSpec::load_steps>("load_steps", "count",
                                        "number of equal steps in which loads and gravity grow to their full size"),
        plain<&StaticsSpec::tolerance>("tolerance", "positive", "tolerance of Newton's iteration"),
        plain<&StaticsSpec::max_iterations>("max_iterations", "count",
                                            "largest number of Newton iterations per load step"),
        choice<&StaticsSpec::stable, yes_or_no>("stable",
                                                "`yes`: if the equilibrium is unstable, continue to one of lower "
                                                "potential energy that is stable; up to 1000 coordinates"),
        nested<&StaticsSpec::rotation>(
            "rotation", "steady_rotation",
            "`{angular_velocity: [x, y, z], about: [x, y, z]}`: [steady rotation](#steady-rotation) about the axis "
            "through the point `about` (default: the origin), world axes; up to 4000 coordinates",
            "equilibrium at rest")}},
      {"steady_rotation",
       {plain<&RotationSpec::angular_velocity>("angular_velocity", "vector", "", "required"),
        plain<&RotationSpec::about>("about", "vector", "")}},
      {"modes",
       {plain<&ModesSpec::count>(
            "count", "count",
            "number of modes that are stored and printed, lowest first; growing modes are always included"),
        plain<&ModesSpec::rotation>(
            "rotation", "vector",
            "angular velocity of the axes in which the state does not change, world axes [rad/time]",
            "that of `statics.rotation` of the analysis in `from`, else 0")}},
      {"checkpoint",
       {plain<&CheckpointSpec::every>("every", "count", "number of accepted steps between two checkpoints", "never"),
        plain<&CheckpointSpec::interval>("interval", "positive",
                                         "instead of `every`: a checkpoint after each first step that reaches `start` "
                                         "+ k `interval` [time], k = 1, 2, ...",
                                         "never")}},
      {"output",
       {plain<&OutputSpec::every>("every", "count", "store every n-th step and the end"),
        plain<&OutputSpec::interval>(
            "interval", "positive",
            "instead of `every`: store at `start` + k `interval` and at the end [time]. Steps of given size do not end "
            "at these instants: the first step that reaches the instant is stored",
            "-"),
        plain<&OutputSpec::from>("from", "number", "store from this time on, not later than `end` [time]",
                                 "`integrator.start`"),
        {"channels", "[text+]",
         "groups or datasets of the [results file](RESULTS.md) (`nodes`, `nodes/position`, `joints`, `energy`, ...), "
         "patterns of them, and single nodes in datasets of nodes (`nodes/position/arm/tip`, `nodes/*/rod/end`)",
         "all"}}}};
}

std::vector<Field> scene_fields() {
  return {plain<&Scene::name>("scene", "text+", "name of the scene, stored in the results", "required"),
          {"units", "'consistent' | units",
           "`{length, mass, time}` or `consistent` (unnamed), as in [PART.md](PART.md). Superelement files are "
           "converted to these units. Files with unnamed units need `consistent` here",
           "SI"},
          plain<&Scene::gravity>("gravity", "vector", "acceleration of gravity, world axes [length/time²]"),
          {"effects", "{text: 'on' | 'off' | 'auto' | number>0 | body_effects}",
           "physical effects that are switched `off`, `on` or `auto`: see [effects](#effects)", "on"},
          {"materials", "{name: material}", "for beams of the scene, as in [PART.md](PART.md)", "none"},
          {"sections", "{name: section}", ditto},
          {"bodies", "{name: body}+", "name -> body; the name `ground` is reserved",
           "required, unless instances contain bodies"},
          {"joints", "{name: joint | gear | rack_and_pinion}", "name -> joint, gear, or rack and pinion", "none"},
          {"inputs", "{name: input}", "name -> time history from a file, for expressions", "none"},
          {"channels", "{name: channel}", "name -> measured quantity of the mechanism, for expressions and results",
           "none"},
          {"motions", "{name: motion}", "name -> drive: a joint coordinate that follows a function of time", "none"},
          {"initial", "{name: initial}",
           "joint coordinate -> its value and rate at the start; body -> its velocities at the start", "none"},
          {"springs", "{name: spring}",
           "name -> spring, damper and stops along a joint coordinate, between two points or about an axis", "none"},
          {"bushings", "{name: bushing}",
           "name -> elastic mount: stiffness and damping between two markers in all six directions", "none"},
          {"roads", "{name: road}", "name -> ground on which tyres roll", "none"},
          {"tyres", "{name: tyre}", "name -> tyre of a wheel on a road", "none"},
          {"loads", "{name: load | part_load}", "name -> force, moment, or load case of a part", "none"},
          choice<&Scene::virtual_bodies, virtual_body_ways>(
              "virtual_bodies",
              "treatment of bodies without mass: `eliminate` or `keep`, see [virtual bodies](#type-virtual)"),
          choice<&Analysis::kind, analysis_kinds>("analysis",
                                                  "kind of analysis if there is only one: `dynamics`, `statics`, "
                                                  "`assembly`, `kinematics`, `inverse_dynamics` or `modes`",
                                                  "`dynamics`"),
          {"analyses", "{name: analysis}+",
           "instead of `analysis`: several analyses by name, see [analyses](#analyses)", "none"},
          {"integrator", "integrator", "time integration, see [integrator](#integrator)", "required in dynamics"},
          nested<&Analysis::statics>("statics", "statics",
                                     "settings of analyses and output, see the section of each key", "defaults"),
          nested<&Analysis::modes>("modes", "modes", ditto),
          {"output", "output", ditto},
          {"checkpoint", "checkpoint", ditto},
          {"include", "text | [text]", "for large scenes, see [Scenes at scale](#scenes-at-scale)", "none"},
          {"parameters", "{parameter_name: any}", ditto},
          {"assemblies", "{name: text | assembly}", ditto},
          {"instances", "{name: instance}", ditto},
          plain<&Scene::initial_tolerance>(
              "initial_tolerance", "positive",
              "largest correction of the given poses and velocities so that they satisfy the joints; a larger one is "
              "an error. It is relative to the characteristic length (poses) and to the largest velocity")};
}

DrawnScene read_drawn_scene(const std::string& text, const std::string& file) {
  const YamlDocument document = parse_yaml(text, file);
  YamlReader reader(document, scene_key_sets());
  const MapReader map(Context{reader, "", file}, reader.root(), "scene");
  const Units units = read_units(map);
  const SceneDefinitions definitions{units, read_materials(map), read_sections(map, units)};
  DrawnScene drawn{read_bodies(map, definitions), {}, {}};
  read_roads(map, definitions, drawn.roads);
  read_tyres(map, definitions, drawn.tyres);
  Faults faults;
  for (const RoadSpec& road : drawn.roads) check_road(road, subject_of("road", road, faults));
  reader.raise(faults);
  return drawn;
}

Scene read_scene(const std::string& path, const std::vector<Override>& overrides) {
  YamlDocument document = load_scene_tree(path, overrides, scene_key_sets());
  YamlReader reader(document, scene_key_sets());
  require_kind(reader, "scene", "part", "make a superelement of it with `reducer run`");
  Faults faults;
  Scene scene = read_tree(reader, path, faults);
  for (Fault& fault : find_faults(scene).list) faults.list.push_back(std::move(fault));
  reader.raise(faults);
  for (const YamlSource& source : document.sources)
    if (source.kind == YamlSourceKind::file) scene.files.push_back(source.name);
  add_named_files(document.root, std::filesystem::path(path).parent_path(), scene.files);
  scene.tree = std::make_shared<const YamlNode>(std::move(document.root));
  return scene;
}

bool BushingSpec::takes_turns(int k) const {
  const auto any = [k](const Eigen::Matrix<double, 6, 6>& m) {
    return !m.row(3 + k).isZero(0.0) || !m.col(3 + k).isZero(0.0);
  };
  return any(stiffness) || any(damping) || preload[3 + k] != 0.0;
}

std::optional<int> BushingSpec::turning_axis() const {
  if (turns) return static_cast<int>(*turns);
  std::vector<int> with, without;
  for (int k = 0; k < 3; ++k) (takes_turns(k) ? with : without).push_back(k);
  if (with.size() == 1) return with.front();
  if (without.size() == 1) return without.front();
  return std::nullopt;
}

}  // namespace tisserand::formats
