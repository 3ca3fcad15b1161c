// `motions`, `initial`, `springs`, `bushings` and `loads` of scene.yaml.
#include "formats/scene/reader.hpp"
#include "formats/scene/time_function_reader.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/geometry.hpp"

namespace tisserand::formats {

namespace {

constexpr Choice<SpringKind> spring_kinds[] = {{"line", SpringKind::line}, {"torsion", SpringKind::torsion}};
constexpr Choice<MarkerAxis> marker_axes[] = {{"x", MarkerAxis::x}, {"y", MarkerAxis::y}, {"z", MarkerAxis::z}};
constexpr Choice<LoadKind> load_kinds[] = {{"force", LoadKind::force}, {"moment", LoadKind::moment}};
constexpr Choice<LoadAxes> load_axes[] = {{"world", LoadAxes::world}, {"body", LoadAxes::body}};

TimeFunctionSpec read_function(const MapReader& map, const YamlNode& node, const std::string& key,
                               const SceneDefinitions& definitions) {
  map.context().reader.note(map.context().entry, key, node);
  return read_time_function(map.context(), node, key, definitions.folder);
}

LawSpec read_law(const MapReader& map, const YamlNode& node, const std::string& key,
                 const SceneDefinitions& definitions) {
  map.context().reader.note(map.context().entry, key, node);
  if (node.kind != YamlKind::map) return read_number(map.context(), node, key);
  return read_curve(map.context(), node, key, definitions.folder);
}

/// What a spring acts along: a coordinate, or the distance or angle of two markers.
void read_ends(const MapReader& map, SpringSpec& spring) {
  if (const YamlNode* coordinate = map.find("coordinate")) {
    spring.coordinate = read_coordinate(map, *coordinate, "coordinate");
    if (map.has("a") || map.has("b"))
      map.fail("both 'coordinate' and the markers 'a', 'b' are given", "give one of them");
    if (const YamlNode* type = map.find("type"))
      map.context().fail(type->key_place, "'type' has no effect with 'coordinate'", "remove it");
  } else {
    spring.a = read_marker(map, "a");
    spring.b = read_marker(map, "b");
  }
  spring.axis = read_optional_vector(map, "axis");
  spring.x_axis = read_optional_vector(map, "x_axis");
  for (const char* key : {"axis", "x_axis"})
    if (const YamlNode* node = map.find(key); node != nullptr && (spring.coordinate || spring.kind == SpringKind::line))
      map.context().fail(node->key_place, fmt::format("'{}' belongs to springs of type torsion", key), "remove it");
}

/// Six numbers: the diagonal; six rows of six: the whole matrix.
Eigen::Matrix<double, 6, 6> read_six_by_six(const MapReader& map, const std::string& key) {
  Eigen::Matrix<double, 6, 6> matrix = Eigen::Matrix<double, 6, 6>::Zero();
  const YamlNode* node = map.find(key);
  if (node == nullptr) return matrix;
  map.context().reader.note(map.context().entry, key, *node);
  const bool rows = node->kind == YamlKind::sequence && node->children.size() == 6 &&
                    node->children.front().kind == YamlKind::sequence;
  const auto check_size = [&](const std::vector<double>& values, const YamlNode& at, const std::string& what) {
    if (values.size() == 6) return true;
    if (at.kind == YamlKind::sequence)
      map.context().fail(at.place, fmt::format("{} has {} numbers instead of 6", what, values.size()),
                         "give six numbers [x, y, z, rx, ry, rz], or six rows of six");
    return false;
  };
  if (!rows) {
    const std::vector<double> diagonal = read_numbers(map.context(), *node, key);
    if (check_size(diagonal, *node, key))
      for (int i = 0; i < 6; ++i) matrix(i, i) = diagonal[i];
    return matrix;
  }
  for (int i = 0; i < 6; ++i) {
    const YamlNode& row = node->children[i];
    const std::string what = fmt::format("{}[{}]", key, i);
    const std::vector<double> values = read_numbers(map.context(), row, what);
    if (check_size(values, row, what))
      for (int j = 0; j < 6; ++j) matrix(i, j) = values[j];
  }
  return matrix;
}

std::optional<Eigen::Matrix<double, 6, 1>> read_six(const MapReader& map, const std::string& key) {
  const YamlNode* node = map.find(key);
  if (node == nullptr) return {};
  map.context().reader.note(map.context().entry, key, *node);
  const std::vector<double> values = read_numbers(map.context(), *node, key);
  Eigen::Matrix<double, 6, 1> vector = Eigen::Matrix<double, 6, 1>::Zero();
  if (values.size() == 6)
    for (int i = 0; i < 6; ++i) vector[i] = values[i];
  else if (node->kind == YamlKind::sequence)
    map.context().fail(node->place, fmt::format("{} has {} numbers instead of 6", key, values.size()),
                       "give six numbers [x, y, z, rx, ry, rz]");
  return vector;
}

LoadSpec read_load(const Context& context, const YamlNode& node, const SceneDefinitions& definitions) {
  const MapReader map(context, node, "load");
  LoadSpec load;
  load.name = node.key;
  load.where = context.entry;
  read_fields(map, load);
  load.at = read_marker(map, "at");
  const YamlNode* value = map.require("value");
  if (value == nullptr) return load;
  if (value->kind != YamlKind::sequence || value->children.size() != 3) {
    context.fail(value->place, fmt::format("value must have three components, not {}", describe(*value)),
                 "write it as [0, 0, \"sin(t)\"]");
    return load;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string what = fmt::format("value[{}]", i);
    context.reader.note(context.entry, what, value->children[i]);
    load.components[i] = read_time_function(context, value->children[i], what, definitions.folder);
  }
  return load;
}

PartLoadSpec read_part_load(const Context& context, const YamlNode& node, const SceneDefinitions& definitions) {
  const MapReader map(context, node, "part_load");
  PartLoadSpec load;
  load.name = node.key;
  load.where = context.entry;
  read_fields(map, load);
  if (const YamlNode* value = map.require("value")) load.value = read_function(map, *value, "value", definitions);
  return load;
}

}  // namespace

std::vector<MotionSpec> read_motions(const MapReader& map, const SceneDefinitions& definitions) {
  std::vector<MotionSpec> motions;
  for (const YamlNode* node : map.entries("motions", "motion")) {
    const Context context = entry_context(map.context().reader, "motion", *node);
    const MapReader inner(context, *node, "motion");
    MotionSpec motion;
    motion.name = node->key;
    motion.where = context.entry;
    if (const YamlNode* coordinate = inner.require("coordinate"))
      motion.coordinate = read_coordinate(inner, *coordinate, "coordinate");
    if (const YamlNode* value = inner.require("value")) {
      context.reader.note(context.entry, "value", *value);
      motion.value = read_motion_function(context, *value, "value", definitions.folder);
    }
    motions.push_back(std::move(motion));
  }
  return motions;
}

std::vector<InitialSpec> read_initial(const MapReader& map) {
  std::vector<InitialSpec> entries;
  for (const YamlNode* node : map.entries("initial", "initial value")) {
    const Context context = entry_context(map.context().reader, "initial", *node);
    InitialSpec entry;
    entry.coordinate = {node->key, context.entry};
    entry.where = context.entry;
    read_fields(MapReader(context, *node, "initial"), entry);
    entries.push_back(std::move(entry));
  }
  return entries;
}

namespace {

/// An entry without any of these keys is a slip. Where they are given as zero, as a sweep does, it rests.
void require_one_of(const MapReader& map, std::initializer_list<const char*> keys, const char* remedy) {
  if (std::ranges::none_of(keys, [&](const char* key) { return map.find(key) != nullptr; }))
    map.fail("does nothing", remedy);
}

}  // namespace

std::vector<SpringSpec> read_springs(const MapReader& map, const SceneDefinitions& definitions) {
  std::vector<SpringSpec> springs;
  for (const YamlNode* node : map.entries("springs", "spring")) {
    const Context context = entry_context(map.context().reader, "spring", *node);
    const MapReader inner(context, *node, "spring");
    SpringSpec spring;
    spring.name = node->key;
    spring.where = context.entry;
    read_fields(inner, spring);
    read_ends(inner, spring);
    require_one_of(inner, {"stiffness", "damping", "lower", "upper", "force"}, "give stiffness, damping, stops or force");
    if (const YamlNode* law = inner.find("stiffness"))
      spring.stiffness = read_law(inner, *law, "stiffness", definitions);
    if (const YamlNode* law = inner.find("damping")) spring.damping = read_law(inner, *law, "damping", definitions);
    if (spring.lower || spring.upper) spring.stop_stiffness = inner.number("stop_stiffness");
    if (const YamlNode* force = inner.find("force")) spring.force = read_function(inner, *force, "force", definitions);
    springs.push_back(std::move(spring));
  }
  return springs;
}

std::vector<BushingSpec> read_bushings(const MapReader& map) {
  std::vector<BushingSpec> bushings;
  for (const YamlNode* node : map.entries("bushings", "bushing")) {
    const Context context = entry_context(map.context().reader, "bushing", *node);
    const MapReader inner(context, *node, "bushing");
    BushingSpec bushing;
    bushing.name = node->key;
    bushing.where = context.entry;
    read_fields(inner, bushing);
    read_marker_pair(inner, bushing);
    require_one_of(inner, {"stiffness", "damping", "preload"}, "give stiffness, damping or preload");
    bushing.stiffness = read_six_by_six(inner, "stiffness");
    bushing.damping = read_six_by_six(inner, "damping");
    bushing.free = read_six(inner, "free");
    bushing.preload = read_six(inner, "preload").value_or(bushing.preload);
    bushings.push_back(std::move(bushing));
  }
  return bushings;
}

void read_loads(const MapReader& map, const SceneDefinitions& definitions, Scene& scene) {
  for (const YamlNode* node : map.entries("loads", "load")) {
    const Context context = entry_context(map.context().reader, "load", *node);
    const YamlNode* type = find_child(*node, "type");
    const std::optional<std::size_t> word =
        type == nullptr ? 0 : read_word(context, *type, "type", {"force", "moment", "part_load"});
    if (word == 2)
      scene.part_loads.push_back(read_part_load(context, *node, definitions));
    else if (word)
      scene.loads.push_back(read_load(context, *node, definitions));
  }
}

std::vector<KeySet> force_key_sets() {
  return {
      {"motion",
       {{"coordinate", "text", "joint coordinate; a position [length] or an angle [rad]", "required"},
        {"value", "motion_value",
         "number, expression in t and inputs, or table as for loads, with `interpolation: smooth` (as if not given), "
         "`natural` or `linear` beside it (see below)",
         "required"}}},
      {"initial",
       {plain<&InitialSpec::value>("value", "number", "where the coordinate stands [length or rad]", "as written"),
        plain<&InitialSpec::rate>("rate", "number", "how fast it moves [length/time or rad/time]", "free"),
        plain<&InitialSpec::velocity>(
            "velocity", "vector",
            "of a body, named instead of a coordinate: of the origin of its part frame, world "
            "axes [length/time]",
            "free"),
        plain<&InitialSpec::angular_velocity>("angular_velocity", "vector", "of a body, world axes [rad/time]",
                                              "free")}},
      {"spring",
       {{"coordinate", "text", "joint coordinate", "one of both"},
        {"a", "place", "markers"},
        {"b", "place", ditto},
        choice<&SpringSpec::kind, spring_kinds>(
            "type",
            "between two markers: `line`, along the line between them, its coordinate q is their distance; `torsion`, "
            "about their z axes, q is the angle of b against a [rad], right-handed and unwrapped: "
            "atan2(y_A·x_B − x_A·y_B, x_A·x_B + y_A·y_B)"),
        {"axis", "vector", "`torsion`: z and x axes of the markers at the start as for joints", "-"},
        {"x_axis", "vector", ditto},
        {"stiffness", "number | curve",
         "k [force/length or moment/rad], or a curve of the force f over the deflection q − free", "0"},
        {"damping", "not_negative | curve",
         "c, not negative, or a curve of the force d over the rate q̇, with the sign of the rate", "0"},
        plain<&SpringSpec::free>("free", "number", "value of the coordinate without force", "that at the start"),
        plain<&SpringSpec::lower>("lower", "number", "stops", "none"),
        plain<&SpringSpec::upper>("upper", "number", ditto),
        {"stop_stiffness", "not_negative", "a stop passed by g pushes back with k_s g (1 + d ġ), never pulling",
         "required with a stop; 0"},
        plain<&SpringSpec::stop_damping>("stop_damping", "not_negative", ditto),
        {"force", "function", "number, expression in t or table as for loads, positive along the positive coordinate",
         "0"}}},
      {"bushing",
       {{"a", "place", "markers on two different nodes", "required"},
        {"b", "place", ditto},
        {"position", "vector", "places them as those of joints; axes of the world without `axis` and orientations",
         "as in joints"},
        {"axis", "vector", ditto},
        {"x_axis", "vector", ditto},
        {"stiffness", "six_by_six",
         "K: six numbers of its diagonal `[x, y, z, rx, ry, rz]`, or a field: six rows of six [force/length, "
         "force/rad; moment/length, moment/rad]",
         "0"},
        {"damping", "six_by_six", "D in the same forms; its symmetric part must not be negative", "0"},
        {"free", "six", "deflection without force, six numbers", "that at the start"},
        {"preload", "six", "what acts on b at the deflection `free` besides, six numbers [force, moment]", "0"},
        choice<&BushingSpec::turns, marker_axes>(
            "turns", "axis of the markers about which it turns far: whole turns are counted",
            "the only one about which it acts, or the only one about which it does not; else none")}},
      {"load",
       {choice<&LoadSpec::kind, load_kinds>("type", "`force` [mass length/time²] or `moment` [mass length²/time²]",
                                            "required"),
        {"at", "place", "node or marker, not `ground`", "required"},
        choice<&LoadSpec::axes, load_axes>("axes", "`world`, or `body`: follows the node"),
        {"value", "[function]3", "three components, each a function of time", "required"}}},
      {"part_load",
       {{"type", "'part_load'", "", "required"},
        plain<&PartLoadSpec::body>("body", "text", "a superelement, also one with `use: rigid`", "required"),
        plain<&PartLoadSpec::load_case>("case", "text", "name of a load case of its companion file", "required"),
        {"value", "function", "factor of the load case, a function of time", "required"}}}};
}

}  // namespace tisserand::formats
