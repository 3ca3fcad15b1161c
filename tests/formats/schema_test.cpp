// Tests that the JSON Schemas of part.yaml and scene.yaml say the same as the readers: equal keys, and every example of
// the project (also those in PART.md and SCENE.md) is accepted by both.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "formats/part.hpp"
#include "formats/part_keys.hpp"
#include "formats/scene.hpp"
#include "formats/scene_keys.hpp"
#include "text_input.hpp"

namespace tisserand::formats {
namespace {

using nlohmann::json;

std::string content(const std::string& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

json schema_of(const std::string& kind) {
  return json::parse(content(std::string(TISSERAND_SOURCE_DIR) + "/formats/schema/" + kind + ".schema.json"));
}

json to_json(const YamlNode& node) {
  json value;
  switch (node.kind) {
    case YamlKind::null:
      return value;
    case YamlKind::sequence:
      value = json::array();
      for (const YamlNode& child : node.children) value.push_back(to_json(child));
      return value;
    case YamlKind::map:
      value = json::object();
      for (const YamlNode& child : node.children) value[child.key] = to_json(child);
      return value;
    case YamlKind::scalar:
      break;
  }
  if (!node.quoted && (node.text == "true" || node.text == "false")) return node.text == "true";
  if (!looks_like_number(node)) return node.text;
  const double number = std::stod(node.text);
  return number == std::floor(number) && std::abs(number) < 1e15 ? json(static_cast<long>(number)) : json(number);
}

bool has_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "null") return value.is_null();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  throw std::logic_error("unknown type " + type);
}

/// The part of JSON Schema 2020-12 that the two schemas use; any other keyword is an error of the test.
class Validator {
 public:
  explicit Validator(const json& schema) : root_(schema) {}

  bool accepts(const json& value) const { return accepts(root_, value); }

 private:
  bool accepts(const json& schema, const json& value) const {
    for (const auto& [word, rule] : schema.items())
      if (!obeys(schema, word, rule, value)) return false;
    return true;
  }

  bool obeys(const json& schema, const std::string& word, const json& rule, const json& value) const {
    if (word == "$schema" || word == "title" || word == "description" || word == "$defs") return true;
    if (word == "$ref") return accepts(root_.at(json::json_pointer(rule.get<std::string>().substr(1))), value);
    if (word == "const") return value == rule;
    if (word == "enum") return std::ranges::find(rule, value) != rule.end();
    if (word == "oneOf") return std::ranges::count_if(rule, [&](const json& one) { return accepts(one, value); }) == 1;
    if (word == "type") {
      if (rule.is_string()) return has_type(value, rule);
      return std::ranges::any_of(rule, [&](const json& type) { return has_type(value, type); });
    }
    if (value.is_number()) return obeys_number(word, rule, value.get<double>());
    if (word == "pattern" || word == "minLength")
      return !value.is_string() || obeys_text(word, rule, value.get<std::string>());
    if (word == "items" || word == "minItems" || word == "maxItems")
      return !value.is_array() || obeys_list(word, rule, value);
    return !value.is_object() || obeys_object(schema, word, rule, value);
  }

  static bool obeys_number(const std::string& word, const json& rule, double value) {
    if (word == "minimum") return value >= rule.get<double>();
    if (word == "maximum") return value <= rule.get<double>();
    if (word == "exclusiveMinimum") return value > rule.get<double>();
    if (word == "exclusiveMaximum") return value < rule.get<double>();
    return true;
  }
  static bool obeys_text(const std::string& word, const json& rule, const std::string& value) {
    if (word == "minLength") return value.size() >= rule.get<std::size_t>();
    return std::regex_search(value, std::regex(rule.get<std::string>()));
  }
  bool obeys_list(const std::string& word, const json& rule, const json& value) const {
    if (word == "minItems") return value.size() >= rule.get<std::size_t>();
    if (word == "maxItems") return value.size() <= rule.get<std::size_t>();
    return std::ranges::all_of(value, [&](const json& item) { return accepts(rule, item); });
  }
  bool obeys_object(const json& schema, const std::string& word, const json& rule, const json& value) const {
    if (word == "minProperties") return value.size() >= rule.get<std::size_t>();
    if (word == "maxProperties") return value.size() <= rule.get<std::size_t>();
    if (word == "required")
      return std::ranges::all_of(rule, [&](const json& key) { return value.contains(key.get<std::string>()); });
    for (const auto& [key, item] : value.items()) {
      const bool listed = schema.contains("properties") && schema.at("properties").contains(key);
      if (word == "properties" && listed && !accepts(rule.at(key), item)) return false;
      if (word == "propertyNames" && !accepts(rule, key)) return false;
      if (word == "additionalProperties" && !listed && (rule == false || !accepts(rule, item))) return false;
    }
    if (word == "properties" || word == "propertyNames" || word == "additionalProperties") return true;
    throw std::logic_error("unknown keyword " + word);
  }

  const json& root_;
};

void expect_equal_keys(const json& schema, const std::vector<KeySet>& sets) {
  for (const KeySet& set : sets) {
    SCOPED_TRACE(set.noun);
    ASSERT_TRUE(schema.at("$defs").contains(std::string(set.noun)));
    std::set<std::string> in_schema;
    const json& definition = schema.at("$defs").at(std::string(set.noun));
    for (const auto& [key, rule] : definition.at("properties").items()) in_schema.insert(key);
    EXPECT_EQ(in_schema, std::set<std::string>(set.keys.begin(), set.keys.end()));
    EXPECT_EQ(definition.at("additionalProperties"), false);
  }
  std::set<std::string> nouns;
  for (const KeySet& set : sets) nouns.emplace(set.noun);
  for (const auto& [noun, definition] : schema.at("$defs").items())
    EXPECT_TRUE(!definition.contains("properties") || nouns.contains(noun)) << noun << " is unknown to the reader";
}

TEST(Schema, KeysEqualThoseOfTheReaders) {
  expect_equal_keys(schema_of("part"), part_key_sets());
  expect_equal_keys(schema_of("scene"), scene_key_sets());
}

/// A part or scene by its text and where it comes from.
struct Example {
  std::string from;
  std::string text;
};

/// Blocks of PART.md and SCENE.md that begin with part: or scene:, and the yaml files below examples/.
std::vector<Example> examples(const std::string& kind) {
  const std::string source = TISSERAND_SOURCE_DIR;
  std::vector<Example> list;
  const std::string page = source + "/formats/" + (kind == "part" ? "PART.md" : "SCENE.md");
  const std::string text = content(page), fence = "```yaml\n" + kind + ":";
  for (std::size_t at = text.find(fence); at != std::string::npos; at = text.find(fence, at + 1)) {
    const std::size_t begin = at + 8;
    list.push_back({page, text.substr(begin, text.find("```", begin) - begin)});
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source + "/examples")) {
    if (entry.path().extension() != ".yaml") continue;
    const YamlDocument document = load_yaml(entry.path().string());
    if (find_child(document.root, kind) != nullptr)
      list.push_back({entry.path().string(), content(entry.path().string())});
  }
  return list;
}

TEST(Schema, AcceptsEveryExample) {
  for (const std::string kind : {"part", "scene"}) {
    const json schema = schema_of(kind);
    const std::vector<Example> list = examples(kind);
    EXPECT_FALSE(list.empty());
    for (const Example& example : list)
      EXPECT_TRUE(Validator(schema).accepts(to_json(parse_yaml(example.text, example.from).root))) << example.from;
  }
}

TEST(Schema, ReadersAcceptEveryExample) {
  const Folder folder;
  for (const Example& example : examples("part"))
    EXPECT_EQ(error_of(folder, [&] { read_part(folder.file("part.yaml", example.text), {}); }), "") << example.from;
  for (const Example& example : examples("scene")) {
    const bool page = example.from.ends_with(".md");
    const std::string path = page ? folder.file("scene.yaml", example.text) : example.from;
    EXPECT_EQ(error_of(folder, [&] { read_scene(path, {}); }), "") << example.from;
  }
}

TEST(Schema, RejectsWhatTheReadersReject) {
  const std::string part = examples("part").front().text, scene = examples("scene").front().text;
  const json part_schema = schema_of("part"), scene_schema = schema_of("scene");
  const auto part_accepted = [&](const std::string& from, const std::string& to) {
    return Validator(part_schema).accepts(to_json(parse_yaml(replaced(part, from, to), "part").root));
  };
  const auto scene_accepted = [&](const std::string& from, const std::string& to) {
    return Validator(scene_schema).accepts(to_json(parse_yaml(replaced(scene, from, to), "scene").root));
  };
  EXPECT_TRUE(part_accepted("modes: 4", "modes: 5"));
  EXPECT_FALSE(part_accepted("modes: 4", "mods: 5"));
  EXPECT_FALSE(part_accepted("modes: 4", "modes: 4.5"));
  EXPECT_FALSE(part_accepted("nu: 0.3", "nu: 0.5"));
  EXPECT_FALSE(part_accepted("shape: hollow_circle", "shape: circle"));
  EXPECT_FALSE(part_accepted("base: [0, 0, 0]", "base: [0, 0]"));
  EXPECT_FALSE(part_accepted("base: [0, 0, 0]", "9base: [0, 0, 0]"));
  EXPECT_TRUE(scene_accepted("frame: {node: base}", "frame: \"node: base\""));
  EXPECT_FALSE(scene_accepted("frame: {node: base}", "frame: kracher"));
  EXPECT_FALSE(scene_accepted("type: superelement", "type: rigid"));
  EXPECT_FALSE(scene_accepted("angle_deg: 30", "angle: 30"));
  EXPECT_FALSE(scene_accepted("every: 10", "every: 0"));
  EXPECT_FALSE(scene_accepted("type: revolute", "type: hinge"));
}

}  // namespace
}  // namespace tisserand::formats
