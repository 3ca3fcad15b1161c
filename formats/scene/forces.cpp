// SPDX-License-Identifier: GPL-3.0-or-later
// Reads `motions`, `initial`, `springs`, `bushings` and `loads` of scene.yaml.
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

/// Reads the line of action of a spring: a coordinate, or the distance or angle of two markers.
void read_ends(const MapReader& map, SpringSpec& spring) {
  if (spring.coordinate) {
    if (map.has("a") || map.has("b"))
      map.fail("both 'coordinate' and the markers 'a', 'b' are given", "give one of them");
    map.refuse({"type"}, "has no effect with 'coordinate'", "remove it");
  } else {
    spring.a = read_marker(map, "a");
    spring.b = read_marker(map, "b");
  }
  read_fields<MarkerPairSpec>(map, spring);
  if (spring.coordinate || spring.kind == SpringKind::line)
    map.refuse({"axis", "x_axis"}, "belongs to springs of type torsion", "remove it");
}

LoadSpec read_load(const MapReader& map) {
  auto load = read_entry<LoadSpec>(map);
  const YamlNode* value = map.require("value");
  if (value == nullptr) return load;
  if (!map.context().require_list(*value, "value must have three components", "write it as [0, 0, \"sin(t)\"]", 3))
    return load;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string what = fmt::format("value[{}]", i);
    map.context().reader.note(load.where, what, value->children[i]);
    load.components[i] = read_time_function(map.context(), value->children[i], what);
  }
  return load;
}

/// Requires one of these keys, since an entry without them is a mistake. Zero values, as in a sweep, are accepted.
void require_one_of(const MapReader& map, std::initializer_list<const char*> keys, const char* remedy) {
  if (std::ranges::none_of(keys, [&](const char* key) { return map.find(key) != nullptr; }))
    map.fail("has no effect", remedy);
}

}  // namespace

void read_value(const MapReader& map, const Field& field, TimeFunctionSpec& value) {
  const YamlNode* node = find_or_require(map, field);
  if (node == nullptr) return;
  const auto read = field.type == "motion_value" ? read_motion_function : read_time_function;
  value = read(map.context(), *node, std::string(field.key));
}

void read_value(const MapReader& map, const Field& field, std::optional<TimeFunctionSpec>& value) {
  if (map.has(field.key)) read_value(map, field, value.emplace());
}

void read_value(const MapReader& map, const Field& field, LawSpec& value) {
  const YamlNode* node = map.find(field.key);
  if (node == nullptr) return;
  if (node->kind == YamlKind::map)
    value = read_curve(map.context(), *node, std::string(field.key));
  else
    value = read_number(map.context(), *node, std::string(field.key));
}

/// Reads six numbers (the diagonal) or six rows of six (the whole matrix).
void read_value(const MapReader& map, const Field& field, Eigen::Matrix<double, 6, 6>& value) {
  const YamlNode* node = map.find(field.key);
  if (node == nullptr) return;
  const bool rows = node->kind == YamlKind::sequence && node->children.size() == 6 &&
                    node->children.front().kind == YamlKind::sequence;
  const auto read_row = [&](const YamlNode& row, const std::string& what, Eigen::Ref<Eigen::RowVectorXd> numbers) {
    const std::vector<double> values = read_numbers(map.context(), row, what);
    if (values.size() == 6)
      numbers = Eigen::Map<const Eigen::RowVectorXd>(values.data(), 6);
    else if (row.kind == YamlKind::sequence)
      map.context().fail(row.place, fmt::format("{} has {} numbers instead of 6", what, values.size()),
                         "give six numbers [x, y, z, rx, ry, rz], or six rows of six");
  };
  Eigen::Matrix<double, 6, 6, Eigen::RowMajor> matrix = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(6);
  if (!rows) read_row(*node, std::string(field.key), row);
  for (int i = 0; i < 6; ++i)
    if (rows)
      read_row(node->children[i], fmt::format("{}[{}]", field.key, i), matrix.row(i));
    else
      matrix(i, i) = row[i];
  value = matrix;
}

void read_value(const MapReader& map, const Field& field, Eigen::Matrix<double, 6, 1>& value) {
  const YamlNode* node = map.find(field.key);
  if (node == nullptr) return;
  const std::vector<double> values = read_numbers(map.context(), *node, std::string(field.key));
  value.setZero();
  if (values.size() == 6)
    value = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(values.data());
  else if (node->kind == YamlKind::sequence)
    map.context().fail(node->place, fmt::format("{} has {} numbers instead of 6", field.key, values.size()),
                       "give six numbers [x, y, z, rx, ry, rz]");
}

void read_value(const MapReader& map, const Field& field, std::optional<Eigen::Matrix<double, 6, 1>>& value) {
  if (map.has(field.key)) read_value(map, field, value.emplace());
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

void read_springs(const MapReader& map, std::vector<SpringSpec>& springs) {
  read_entries(map, "springs", "spring", springs, [](const MapReader& inner, SpringSpec& spring) {
    read_ends(inner, spring);
    require_one_of(inner, {"stiffness", "damping", "lower", "upper", "force"},
                   "give stiffness, damping, stops or force");
    if (spring.lower || spring.upper) spring.stop_stiffness = inner.number("stop_stiffness");
  });
}

void read_bushings(const MapReader& map, std::vector<BushingSpec>& bushings) {
  read_entries(map, "bushings", "bushing", bushings, [](const MapReader& inner, BushingSpec& bushing) {
    read_fields<MarkerPairSpec>(inner, bushing);
    require_one_of(inner, {"stiffness", "damping", "preload"}, "give stiffness, damping or preload");
  });
}

void read_loads(const MapReader& map, Scene& scene) {
  for (const YamlNode* node : map.entries("loads", "load")) {
    const Context context = entry_context(map.context().reader, "load", *node);
    const YamlNode* type = find_child(*node, "type");
    const std::optional<std::size_t> word =
        type == nullptr ? 0 : read_word(context, *type, "type", {"force", "moment", "part_load"});
    if (word == 2)
      scene.part_loads.push_back(read_entry<PartLoadSpec>(MapReader(context, *node, "part_load")));
    else if (word)
      scene.loads.push_back(read_load(MapReader(context, *node, "load")));
  }
}

std::vector<KeySet> force_key_sets() {
  return {
      {"motion",
       {plain<&MotionSpec::coordinate>(
            "coordinate", "text", "joint coordinate that is driven, a position [length] or an angle [rad]", "required"),
        plain<&MotionSpec::value>("value", "motion_value",
                                  "[function of time](#functions-of-time) in `t` and inputs. The map of a table or "
                                  "file may have `interpolation`: `smooth` (default), `natural` or `linear`",
                                  "required")}},
      {"initial",
       {plain<&InitialSpec::value>("value", "number", "value of the coordinate at the start [length or rad]",
                                   "that of the poses"),
        plain<&InitialSpec::rate>("rate", "number", "rate of the coordinate at the start [length/time or rad/time]",
                                  "free"),
        plain<&InitialSpec::velocity>(
            "velocity", "vector",
            "if the entry names a body: velocity of the origin of its part frame, world axes [length/time]", "free"),
        plain<&InitialSpec::angular_velocity>("angular_velocity", "vector",
                                              "if the entry names a body: its angular velocity, world axes [rad/time]",
                                              "free")}},
      {"spring",
       {plain<&SpringSpec::coordinate>("coordinate", "text", "joint coordinate q along which the spring acts",
                                       "either this, or `a` and `b`"),
        {"a", "place", "two markers between which the spring acts"},
        {"b", "place", ditto},
        choice<&SpringSpec::kind, spring_kinds>(
            "type",
            "between markers. `line`: q is their distance. `torsion`: q is the angle of b relative to a about their z "
            "axes [rad], right-handed, whole turns counted: atan2(y_A·x_B − x_A·y_B, x_A·x_B + y_A·y_B)"),
        plain<&MarkerPairSpec::axis>("axis", "vector",
                                     "`torsion`: z and x axes of the markers at the start, as for joints", "-"),
        plain<&MarkerPairSpec::x_axis>("x_axis", "vector", ditto),
        plain<&SpringSpec::stiffness>("stiffness", "number | curve",
                                      "stiffness k [force/length or moment/rad], or a [curve](#curves) of the force f "
                                      "over the deflection q − `free`",
                                      "0"),
        plain<&SpringSpec::damping>("damping", "not_negative | curve",
                                    "damping c, not negative [force time/length or moment time/rad], or a "
                                    "[curve](#curves) of the force d over the rate q̇, with its sign",
                                    "0"),
        plain<&SpringSpec::free>("free", "number", "value of q at which the spring exerts no force",
                                 "value at the start"),
        plain<&SpringSpec::lower>("lower", "number", "values of q at which stops begin to act", "none"),
        plain<&SpringSpec::upper>("upper", "number", ditto),
        {"stop_stiffness", "not_negative",
         "k_s and d [time/length or time/rad]: if q exceeds a stop by g, the stop pushes back with k_s g (1 + d ġ). It "
         "never pulls",
         "required with a stop; 0"},
        plain<&SpringSpec::stop_damping>("stop_damping", "not_negative", ditto),
        plain<&SpringSpec::force>(
            "force", "function",
            "additional force, a [function of time](#functions-of-time); positive in the direction in which q grows",
            "0")}},
      {"bushing",
       {plain<&MarkerPairSpec::a>("a", "place", "two markers on different nodes", "required"),
        plain<&MarkerPairSpec::b>("b", "place", ditto),
        plain<&MarkerPairSpec::position>(
            "position", "vector", "place and axes of the markers; without `axis` and orientations axes of the world",
            "as for joints"),
        plain<&MarkerPairSpec::axis>("axis", "vector", ditto),
        plain<&MarkerPairSpec::x_axis>("x_axis", "vector", ditto),
        plain<&BushingSpec::stiffness>(
            "stiffness", "six_by_six",
            "stiffness matrix K: the six numbers of its diagonal `[x, y, z, rx, ry, rz]`, or six rows of six numbers "
            "[force/length, force/rad; moment/length, moment/rad]",
            "0"),
        plain<&BushingSpec::damping>(
            "damping", "six_by_six",
            "damping matrix D in the same forms; its symmetric part must have no negative eigenvalue", "0"),
        plain<&BushingSpec::free>("free", "six", "deflection at which there is no force, six numbers [length, rad]",
                                  "value at the start"),
        plain<&BushingSpec::preload>(
            "preload", "six", "force and moment that act on b at the deflection `free`, six numbers [force, moment]",
            "0"),
        choice<&BushingSpec::turns, marker_axes>(
            "turns", "axis `x`, `y` or `z` of the markers about which whole turns are counted",
            "if the bushing acts about one axis only: this axis. If it acts about all axes but one: that one. Else "
            "none")}},
      {"load",
       {choice<&LoadSpec::kind, load_kinds>("type", "`force` [mass length/time²] or `moment` [mass length²/time²]",
                                            "required"),
        plain<&LoadSpec::at>("at", "place", "node or marker on which it acts, not `ground`", "required"),
        choice<&LoadSpec::axes, load_axes>("axes",
                                           "axes of the components: `world`, or `body`: the load follows the node"),
        {"value", "[function]3", "three components, each a [function of time](#functions-of-time)", "required"}}},
      {"part_load",
       {{"type", "'part_load'", "", "required"},
        plain<&PartLoadSpec::body>("body", "text", "name of a superelement; `use: rigid` is allowed", "required"),
        plain<&PartLoadSpec::load_case>("case", "text", "name of a load case of its companion file", "required"),
        plain<&PartLoadSpec::value>("value", "function",
                                    "factor of the load case, a [function of time](#functions-of-time)", "required")}}};
}

}  // namespace tisserand::formats
