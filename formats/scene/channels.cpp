// `channels` and `inputs` of scene.yaml: reading and findings.
#include <algorithm>
#include <filesystem>

#include "formats/scene/check_parts.hpp"
#include "formats/scene/expand/expression.hpp"
#include "formats/scene/reader.hpp"
#include "formats/scene/time_function_reader.hpp"
#include "formats/tables/input_table.hpp"
#include "formats/yaml/geometry.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {

namespace {

constexpr Choice<ChannelKind> channel_kinds[] = {{"coordinate", ChannelKind::coordinate},
                                                 {"rate", ChannelKind::rate},
                                                 {"position", ChannelKind::position},
                                                 {"velocity", ChannelKind::velocity},
                                                 {"distance", ChannelKind::distance}};

bool is_point(ChannelKind kind) { return kind == ChannelKind::position || kind == ChannelKind::velocity; }

void refuse(const MapReader& map, const char* key, const char* types) {
  if (const YamlNode* node = map.find(key))
    map.context().fail(node->key_place, fmt::format("'{}' belongs to channels of type {}", key, types), "remove it");
}

/// `x`, `y`, `z`, or a direction.
Eigen::Vector3d read_axis(const Context& context, const YamlNode& node) {
  if (node.kind != YamlKind::sequence)
    return Eigen::Vector3d::Unit(
        static_cast<Eigen::Index>(read_word(context, node, "axis", {"x", "y", "z"}).value_or(0)));
  const Eigen::Vector3d direction = read_vector(context, node, "axis");
  if (direction.stableNorm() > 0.0) return direction.stableNormalized();
  context.fail(node.place, "axis has zero length", "write x, y, z, or a direction such as [1, 1, 0]");
  return Eigen::Vector3d::UnitX();
}

ChannelSpec read_channel(const Context& context, const YamlNode& node) {
  const MapReader map(context, node, "channel");
  ChannelSpec channel;
  channel.name = node.key;
  channel.where = context.entry;
  map.require("type");
  channel.kind = map.choice("type", channel_kinds, channel.kind);
  if (channel.kind == ChannelKind::distance) {
    channel.a = read_marker(map, "a");
    channel.b = read_marker(map, "b");
    refuse(map, "of", "coordinate, rate, position and velocity");
  } else {
    if (is_point(channel.kind))
      channel.a = read_marker(map, "of");
    else if (const YamlNode* of = map.require("of"))
      channel.coordinate = read_coordinate(map, *of, "of");
    refuse(map, "a", "distance");
    refuse(map, "b", "distance");
  }
  if (is_point(channel.kind)) {
    if (const YamlNode* axis = map.require("axis")) channel.axis = read_axis(context, *axis);
  } else {
    refuse(map, "axis", "position and velocity");
  }
  if (channel.kind == ChannelKind::position)
    channel.origin = read_vector(map, "origin", channel.origin);
  else
    refuse(map, "origin", "position");
  return channel;
}

InputSpec read_input(const Context& context, const YamlNode& node, const SceneDefinitions& definitions) {
  const MapReader map(context, node, "input");
  InputSpec input;
  input.name = node.key;
  input.where = context.entry;
  input.interpolation = map.choice(
      "interpolation", {Choice<Interpolation>{"linear", Interpolation::linear}, {"cubic", Interpolation::cubic}},
      input.interpolation);
  const std::string time = map.has("time") ? map.text("time") : "1", value = map.has("value") ? map.text("value") : "2";
  const YamlNode* file = map.require("file");
  const std::string name = file == nullptr ? "" : read_text(context, *file, "file");
  if (name.empty()) return input;
  context.reader.note(context.entry, "file", *file);
  try {
    input.table = read_input_table({(std::filesystem::path(definitions.folder) / name).string(), time, value});
  } catch (const Error& error) {
    context.fail(file->place, error.what(), "");
  }
  return input;
}

/// Names that can stand in expressions, there with '.' for '/'.
void check_expression_name(const std::string& noun, const std::string& name, const std::string& where,
                           std::unordered_set<std::string>& names, Faults& faults) {
  check_path_name(noun, name, where, names, faults);
  if (name.find('-') != std::string::npos)
    faults.add(where, "", fmt::format("{} '{}': expressions would read the name as a difference", noun, name),
               "use _ instead of -");
  const std::string last = name.substr(name.rfind('/') + 1);
  if (last == "t" || last == "pi")
    faults.add(where, "", fmt::format("{} '{}': the name has a meaning in expressions", noun, name), "rename it");
}

}  // namespace

std::vector<ChannelSpec> read_channels(const MapReader& map) {
  std::vector<ChannelSpec> channels;
  for (const YamlNode* node : map.entries("channels", "channel"))
    channels.push_back(read_channel(entry_context(map.context().reader, "channel", *node), *node));
  return channels;
}

std::vector<InputSpec> read_inputs(const MapReader& map, const SceneDefinitions& definitions) {
  std::vector<InputSpec> inputs;
  for (const YamlNode* node : map.entries("inputs", "input"))
    inputs.push_back(read_input(entry_context(map.context().reader, "input", *node), *node, definitions));
  return inputs;
}

void check_channels(const SceneIndex& index, Faults& faults) {
  const Scene& scene = index.scene;
  std::unordered_set<std::string> names;
  for (const InputSpec& input : scene.inputs) {
    const std::string subject = fmt::format("input '{}'", input.name);
    check_expression_name("input", input.name, input.where, names, faults);
    if (input.table.time.size() < 2)
      faults.add(input.where, "file", fmt::format("{}: has {} points", subject, input.table.time.size()),
                 "give at least two");
    else
      check_time_function(input.table, subject, input.where, "file", faults);
  }
  for (const ChannelSpec& channel : scene.channels) {
    const std::string subject = fmt::format("channel '{}'", channel.name);
    check_expression_name("channel", channel.name, channel.where, names, faults);
    switch (channel.kind) {
      case ChannelKind::coordinate:
      case ChannelKind::rate:
        check_coordinate(channel.coordinate, index, subject, channel.where, "of", faults);
        break;
      case ChannelKind::position:
      case ChannelKind::velocity:
        check_marker(index, channel.a, subject, channel.where, "of", faults);
        break;
      case ChannelKind::distance:
        check_marker(index, channel.a, subject, channel.where, "a", faults);
        check_marker(index, channel.b, subject, channel.where, "b", faults);
        break;
    }
  }
}

}  // namespace tisserand::formats
