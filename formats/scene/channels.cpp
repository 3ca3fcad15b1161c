// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and checks `channels` and `inputs` of scene.yaml.

#include "formats/scene/check_parts.hpp"
#include "formats/scene/expand/expression.hpp"
#include "formats/scene/reader.hpp"
#include "formats/scene/time_function_reader.hpp"
#include "formats/tables/input_table.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/geometry.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

constexpr Choice<ChannelKind> channel_kinds[] = {
    {"coordinate", ChannelKind::coordinate}, {"rate", ChannelKind::rate},         {"position", ChannelKind::position},
    {"velocity", ChannelKind::velocity},     {"distance", ChannelKind::distance}, {"tyre", ChannelKind::tyre}};
constexpr Choice<TyreQuantity> tyre_quantities[] = {{"load", TyreQuantity::load},
                                                    {"force_x", TyreQuantity::force_x},
                                                    {"force_y", TyreQuantity::force_y},
                                                    {"moment_x", TyreQuantity::moment_x},
                                                    {"moment_y", TyreQuantity::moment_y},
                                                    {"moment_z", TyreQuantity::moment_z},
                                                    {"slip", TyreQuantity::slip},
                                                    {"slip_angle", TyreQuantity::slip_angle},
                                                    {"camber", TyreQuantity::camber},
                                                    {"penetration", TyreQuantity::penetration},
                                                    {"rolling_radius", TyreQuantity::rolling_radius}};

bool is_point(ChannelKind kind) { return kind == ChannelKind::position || kind == ChannelKind::velocity; }

void refuse(const MapReader& map, const char* key, const char* types) {
  map.refuse({key}, fmt::format("belongs to channels of type {}", types), "remove it");
}

/// Reads an axis: `x`, `y`, `z`, or a direction.
Eigen::Vector3d read_axis(const Context& context, const YamlNode& node) {
  if (node.kind != YamlKind::sequence)
    return Eigen::Vector3d::Unit(
        static_cast<Eigen::Index>(read_word(context, node, "axis", {"x", "y", "z"}).value_or(0)));
  const Eigen::Vector3d direction = read_vector(context, node, "axis");
  if (direction.stableNorm() > 0.0) return direction.stableNormalized();
  context.fail(node.place, "axis has zero length", "write x, y, z, or a direction such as [1, 1, 0]");
  return Eigen::Vector3d::UnitX();
}

void read_channel(const MapReader& map, ChannelSpec& channel) {
  if (channel.kind == ChannelKind::distance) {
    channel.a = read_marker(map, "a");
    channel.b = read_marker(map, "b");
    refuse(map, "of", "coordinate, rate, position, velocity and tyre");
  } else if (channel.kind == ChannelKind::tyre) {
    if (map.require("tyre") != nullptr) channel.tyre = map.text("tyre");
    if (map.require("of") != nullptr) channel.quantity = map.choice("of", tyre_quantities, channel.quantity);
    refuse(map, "a", "distance");
    refuse(map, "b", "distance");
  } else {
    if (is_point(channel.kind))
      channel.a = read_marker(map, "of");
    else if (const YamlNode* of = map.require("of"))
      channel.coordinate = read_coordinate(map, *of, "of");
    refuse(map, "a", "distance");
    refuse(map, "b", "distance");
  }
  if (is_point(channel.kind)) {
    if (const YamlNode* axis = map.require("axis")) channel.axis = read_axis(map.context(), *axis);
  } else {
    refuse(map, "axis", "position and velocity");
  }
  if (channel.kind != ChannelKind::position) refuse(map, "origin", "position");
  if (channel.kind != ChannelKind::tyre) refuse(map, "tyre", "tyre");
}

void read_input(const MapReader& map, InputSpec& input) {
  const Context& context = map.context();
  const std::string time = map.has("time") ? map.text("time") : "1", value = map.has("value") ? map.text("value") : "2";
  const YamlNode* file = map.require("file");
  const std::string name = file == nullptr ? "" : read_text(context, *file, "file");
  if (name.empty()) return;
  try {
    input.table = read_input_table({(context.reader.folder() / name).string(), time, value});
  } catch (const Error& error) {
    context.fail(file->place, error.what(), "");
  }
}

/// Checks a name that expressions may use, where '.' stands for '/'.
Subject check_expression_name(const std::string& noun, const auto& entry, std::unordered_set<std::string>& names,
                              Faults& faults) {
  const Subject subject = check_path_name(noun, entry, names, faults);
  const std::string& name = entry.name;
  if (name.find('-') != std::string::npos)
    subject.add("", "expressions would read the name as a difference", "use _ instead of -");
  const std::string last = name.substr(name.rfind('/') + 1);
  if (last == "t" || last == "pi") subject.add("", "the name is reserved in expressions", "rename it");
  return subject;
}

}  // namespace

void read_channels(const MapReader& map, Scene& scene) {
  read_entries(map, "inputs", "input", scene.inputs, read_input);
  read_entries(map, "channels", "channel", scene.channels, read_channel);
}

std::vector<KeySet> channel_key_sets() {
  return {
      {"input",
       {{"file", "text", "text table or HDF5 file, recognised by its first bytes; at most ten million points",
         "required"},
        {"time", "text | integer",
         "columns, by name in the first line or by number from 1. Cells are separated by commas if the first line has "
         "one, else by semicolons, else by tabs, else by blanks. `#` begins a comment line. HDF5: paths of "
         "one-dimensional datasets of 64-bit floats",
         "1, 2"},
        {"value", "text | integer", ditto},
        choice<&InputSpec::interpolation, interpolations>(
            "interpolation",
            "`linear`: steps of the integrator end at the points; `cubic`: monotone, as for [curves](#curves), steps "
            "do not end at the points")}},
      {"channel",
       {choice<&ChannelSpec::kind, channel_kinds>(
            "type",
            "`coordinate` or `rate` of a joint coordinate; `position` or `velocity` of a marker; `distance` between "
            "two markers; `tyre`: a quantity of a tyre",
            "required"),
        {"of", "place",
         "joint coordinate, or marker; for `tyre` one of `load`, `force_x`, `force_y`, `moment_x`, `moment_y`, "
         "`moment_z`, `slip`, `slip_angle`, `camber`, `penetration`, `rolling_radius`",
         "required, except for `distance`"},
        {"tyre", "text", "`tyre`: name from `tyres`", "required for `tyre`"},
        {"axis", "'x' | 'y' | 'z' | vector",
         "`position`, `velocity`: the component that is measured: `x`, `y` or `z` of the world, or along a direction "
         "`[x, y, z]`",
         "required for this kind"},
        plain<&ChannelSpec::origin>("origin", "vector", "`position`: point from which it is measured, world frame"),
        {"a", "place", "`distance`: two markers on different nodes", "required for this kind"},
        {"b", "place", ditto}}}};
}

void check_channels(const SceneIndex& index, Faults& faults) {
  const Scene& scene = index.scene;
  std::unordered_set<std::string> names;
  for (const InputSpec& input : scene.inputs) {
    const Subject subject = check_expression_name("input", input, names, faults);
    if (input.table.time.size() < 2)
      subject.add("file", fmt::format("has {} points", input.table.time.size()), "give at least two");
    else
      check_time_function(input.table, "file", subject);
  }
  for (const ChannelSpec& channel : scene.channels) {
    const Subject subject = check_expression_name("channel", channel, names, faults);
    switch (channel.kind) {
      case ChannelKind::coordinate:
      case ChannelKind::rate:
        check_coordinate(channel.coordinate, index, "of", subject);
        break;
      case ChannelKind::position:
      case ChannelKind::velocity:
        check_marker(index, channel.a, "of", subject);
        break;
      case ChannelKind::distance:
        check_marker(index, channel.a, "a", subject);
        check_marker(index, channel.b, "b", subject);
        break;
      case ChannelKind::tyre:
        check_reference(subject, "tyre", "tyre", channel.tyre, texts_of(scene.tyres, &TyreSpec::name));
        break;
    }
  }
}

}  // namespace tisserand::formats
