// SPDX-License-Identifier: GPL-3.0-or-later
// Tests that the JSON Schemas of part.yaml and scene.yaml and the tables of PART.md and SCENE.md are those of the lists
// of fields, and that every example of the project (also those in the pages) is accepted by schemas and readers.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "formats/part/part.hpp"
#include "formats/scene/scene.hpp"
#include "formats/specification/specification.hpp"
#include "formats/study/study.hpp"
#include "formats/yaml/fields.hpp"
#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::schema_test {
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
    if (word == "anyOf") return std::ranges::any_of(rule, [&](const json& one) { return accepts(one, value); });
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

TEST(Specification, SchemasAndPagesAgreeWithTheFields) {
  const std::string source = std::string(TISSERAND_SOURCE_DIR) + "/";
  for (const FileKind& kind : file_kinds()) {
    EXPECT_TRUE(content(source + kind.schema_file()) == schema_text(kind))
        << kind.schema_file() << " is out of date: run scripts/specification";
    const std::string page = content(source + kind.page_file());
    EXPECT_TRUE(page == with_field_tables(page, kind.page_file(), kind.sets))
        << kind.page_file() << " is out of date: run scripts/specification";
  }
}

TEST(Specification, EveryTableOfFieldsStandsInAPage) {
  std::string pages;
  for (const FileKind& kind : file_kinds())
    pages += content(std::string(TISSERAND_SOURCE_DIR) + "/" + kind.page_file());
  for (const FileKind& kind : file_kinds())
    for (const KeySet& set : kind.sets)
      for (const Field& field : set.fields)
        EXPECT_TRUE(field.meaning.empty() || names_kind(field) ||
                    pages.find(fmt::format("<!-- fields: {} -->", field.table)) != std::string::npos)
            << field.key << " of " << set.noun << ": no page has the mark <!-- fields: " << field.table << " -->";
}

TEST(Specification, EveryMapHasAListOfItsOwnWithDistinctKeys) {
  for (const FileKind& kind : file_kinds()) {
    std::set<std::string_view> nouns;
    for (const KeySet& set : kind.sets) {
      EXPECT_TRUE(nouns.insert(set.noun).second) << set.noun;
      std::set<std::string_view> keys;
      for (const Field& field : set.fields) EXPECT_TRUE(keys.insert(field.key).second) << set.noun << ' ' << field.key;
    }
  }
}

TEST(Specification, TablesJoinRowsAndKeepSharedFieldsApart) {
  const std::vector<KeySet> sets{{"box",
                                  {{"low", "number", "sides", "required"},
                                   {"high", "number", ditto},
                                   {"hidden", "text", ""},
                                   {"x", "any", "else"}},
                                  shared_fields("common", {{"colour", "text", "paint", "`red`"}})}};
  const std::string head = "| key | meaning | default |\n| --- | --- | --- |\n";
  EXPECT_EQ(field_table(sets, "box"), head + "| `low`, `high` | sides | required |\n| `x` | else | |\n");
  EXPECT_EQ(field_table(sets, "common"), head + "| `colour` | paint | `red` |\n");
  EXPECT_TRUE(sets[0].fields[1].required());
  const std::string page = "a\n<!-- fields: common -->\nold\n<!-- end -->\nb\n";
  EXPECT_EQ(with_field_tables(page, "page", sets),
            "a\n<!-- fields: common -->\n" + head + "| `colour` | paint | `red` |\n<!-- end -->\nb\n");
  EXPECT_THROW(with_field_tables("<!-- fields: bax -->\n<!-- end -->\n", "page", sets), Error);
  EXPECT_THROW(with_field_tables("<!-- fields: box -->\n", "page", sets), Error);
}

TEST(Specification, KindsAreRowsOfOneTable) {
  const std::vector<KeySet> sets{{"box", {{"shape", "'box'", "with corners", "required"}, {"x", "any", ""}}},
                                 {"ball", {{"shape", "'ball'", "without"}}},
                                 {"either", {{"shape", "'box' | 'ball'", "no kind"}}}};
  const std::string table = "| `shape` | meaning |\n| --- | --- |\n| `box` | with corners |\n| `ball` | without |\n";
  EXPECT_EQ(kind_table(sets, "shape"), table);
  EXPECT_EQ(with_field_tables("<!-- kinds: shape -->\n<!-- end -->\n", "page", sets),
            "<!-- kinds: shape -->\n" + table + "<!-- end -->\n");
}

struct Paint {
  double gloss = 2.5e-4;
  int coats = 2;
  Eigen::Vector3d light = Eigen::Vector3d::UnitZ();
  bool matt = true;
  std::optional<double> area;
};
constexpr Choice<bool> surfaces[] = {{"bright", false}, {"matt", true}};

TEST(Specification, DefaultsAreThoseOfTheMembers) {
  const std::vector<KeySet> sets{
      {"paint",
       {plain<&Paint::gloss>("gloss", "number", "a"), plain<&Paint::coats>("coats", "count", "b"),
        plain<&Paint::light>("light", "vector", "c"), choice<&Paint::matt, surfaces>("surface", "d"),
        plain<&Paint::area>("area", "positive", "e")}}};
  EXPECT_EQ(field_table(sets, "paint"),
            "| key | meaning | default |\n| --- | --- | --- |\n| `gloss` | a | 0.00025 |\n| `coats` | b | 2 |\n"
            "| `light` | c | `[0, 0, 1]` |\n| `surface` | d | `matt` |\n| `area` | e | |\n");
}

TEST(Specification, PlainFieldsAreRead) {
  const std::vector<KeySet> sets{
      {"paint",
       {plain<&Paint::gloss>("gloss", "number", "", "required"), plain<&Paint::coats>("coats", "count", ""),
        plain<&Paint::light>("light", "vector", ""), choice<&Paint::matt, surfaces>("surface", ""),
        plain<&Paint::area>("area", "positive", "")}}};
  const auto read = [&](const std::string& text) {
    const YamlDocument document = parse_yaml(text, "paint.yaml");
    YamlReader reader(document, sets);
    Paint paint;
    read_fields(MapReader(Context{reader, "paint", "here"}, reader.root(), "paint"), paint);
    reader.raise({});
    return paint;
  };
  const Paint all = read("{gloss: 3, coats: 1, light: [1, 2, 3], surface: bright, area: 4}");
  EXPECT_EQ(all.gloss, 3.0);
  EXPECT_EQ(all.coats, 1);
  EXPECT_EQ(all.light, Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(all.matt);
  EXPECT_EQ(all.area, 4.0);
  const Paint least = read("gloss: 3");
  EXPECT_EQ(least.coats, 2);
  EXPECT_TRUE(least.matt);
  EXPECT_FALSE(least.area.has_value());
  const Folder folder;
  EXPECT_EQ(error_of(folder, [&] { read("coats: 1"); }), "paint.yaml:1:1: paint: missing key 'gloss'");
  EXPECT_EQ(error_of(folder, [&] { read("{gloss: 3, surface: mat}"); }),
            "paint.yaml:1:21: paint: unknown surface 'mat'; did you mean 'matt'?");
}

TEST(Specification, NotationOfTypes) {
  const auto definition = [](std::string_view type, bool parameters) {
    const FileKind kind{"box", {{"box", {{"low", type, ""}}}}, {{"count", "integer>=1"}}, parameters};
    return json::parse(schema_text(kind)).at("$defs").at("box").at("properties").at("low");
  };
  EXPECT_EQ(definition("number>-1<=0.5", false),
            json::parse(R"({"type": "number", "exclusiveMinimum": -1, "maximum": 0.5})"));
  EXPECT_EQ(definition("'on' | 2 | true", false), json::parse(R"({"enum": ["on", 2, true]})"));
  EXPECT_EQ(definition("'box'", true), json::parse(R"({"const": "box"})"));
  EXPECT_EQ(definition("[count]2..", true), json::parse(R"({"anyOf": [{"type": "array",
            "items": {"$ref": "#/$defs/count"}, "minItems": 2}, {"$ref": "#/$defs/parameter"}]})"));
  EXPECT_EQ(definition("[any]3..4", false),
            json::parse(R"({"type": "array", "items": {}, "minItems": 3, "maxItems": 4})"));
  EXPECT_EQ(definition("{/^a|b$/: text+}", false), json::parse(R"({"type": ["object", "null"], "propertyNames":
            {"type": "string", "pattern": "^a|b$"}, "additionalProperties": {"type": "string", "minLength": 1}})"));
  EXPECT_EQ(definition("{text: any}+", true), json::parse(R"({"type": "object"})"));
}

/// A part or scene by its text and where it comes from.
struct Example {
  std::string from;
  std::string text;
};

/// Blocks of PART.md, SCENE.md and STUDY.md that begin with part:, scene: or study:, and the yaml files below
/// examples/.
std::vector<Example> examples(const std::string& kind) {
  const std::string source = TISSERAND_SOURCE_DIR;
  std::vector<Example> list;
  const std::string page = source + "/formats/" +
                           (kind == "part"    ? "PART.md"
                            : kind == "scene" ? "SCENE.md"
                                              : "STUDY.md");
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
  for (const std::string kind : {"part", "scene", "study"}) {
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
  for (const Example& example : examples("study"))
    EXPECT_EQ(error_of(folder, [&] { read_study(folder.file("study.yaml", example.text)); }), "") << example.from;
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

/// Every key of scenes that takes a whole number, and choices and lists of all kinds.
const std::string whole_numbers = R"yaml(
scene: numbers
virtual_bodies: keep
bodies:
  arm: {type: superelement, file: arm.h5, modes: 4, inertia: M, mirror: xz, damping: {ratios: [0.1, 0.2]}}
  side: {type: superelement, file: arm.h5, mirror: [xz, yz], weights: {positions: {base: 1}}}
  rod: {type: modal, file: rod.h5, modes: 3}
  beam: {type: beam, from: [0, 0, 0], to: [1, 0, 0], elements: 4, nodes_per_element: 3, section: bar, material: steel}
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}
sections: {bar: {shape: circle, radius: 0.01}}
joints:
  a: {type: generic, hold: [x, y, rz], a: ground, b: arm/tip}
  b: {type: revolute, a: ground, b: side/tip, axis: [0, 0, 1], friction: {coefficient: 0.1, velocity: 1, radius: 0.2}}
inputs: {wind: {file: wind.csv, time: 1, value: 2}}
springs: {s: {coordinate: b, stiffness: {table: [[-1, -2], [1, 2]]}, damping: 1, lower: -1, stop_stiffness: 5}}
bushings: {c: {a: ground, b: arm/base, stiffness: [1, 1, 1, 1, 1, 1], preload: [0, 0, 1, 0, 0, 0]}}
loads: {f: {type: force, at: arm/tip, axes: body, value: [0, 1, 2]}}
integrator: {step: 0.01, end: 1, max_iterations: 9, max_halvings: 3, linear_solver: klu}
statics: {load_steps: 2, max_iterations: 7}
modes: {count: 5, rotation: [0, 0, 1]}
checkpoint: {every: 10}
output: {every: 2, channels: [nodes]}
)yaml";

/// Numbers, texts and lists below `value`, but for what chooses the schema of an entry, and for names of inputs.
void collect_values(const json& value, const json::json_pointer& at, std::vector<json::json_pointer>& list) {
  if (!at.empty() && (at.back() == "type" || at.back() == "shape" || at.back() == "scene")) return;
  if (!value.is_object() && !value.is_null()) list.push_back(at);
  if (!value.is_structured()) return;
  for (const auto& [key, child] : value.items())
    if (key != "parameters" && key != "assemblies" && key != "instances" && key != "inputs" && key != "include")
      collect_values(child, value.is_array() ? at / std::stoul(key) : at / key, list);
}

TEST(Schema, ParametersMayStandForAnyNumberTextOrListAsInTheReader) {
  const Folder folder;
  (void)folder.file("wind.csv", "0 1\n1 2\n");
  const json schema = schema_of("scene");
  std::vector<Example> list{{"whole numbers", whole_numbers}};
  for (const Example& example : examples("scene"))
    if (example.from.ends_with(".md")) list.push_back(example);
  for (const Example& example : list) {
    const json scene = to_json(parse_yaml(example.text, example.from).root);
    ASSERT_TRUE(Validator(schema).accepts(scene)) << example.from;
    std::vector<json::json_pointer> values;
    collect_values(scene, json::json_pointer(), values);
    const bool read = example.from == "whole numbers";
    for (const json::json_pointer& at : values) {
      json changed = scene;
      changed[at] = "$p";
      EXPECT_TRUE(Validator(schema).accepts(changed)) << example.from << ": " << at;
      if (!read) continue;
      changed["parameters"]["p"] = scene[at];
      const std::string path = folder.file("scene.yaml", changed.dump());
      EXPECT_EQ(error_of(folder, [&] { read_scene(path, {}); }), "") << at;
    }
  }
}

TEST(Schema, WholeNumbersAreNoOthers) {
  const json schema = schema_of("scene"), scene = to_json(parse_yaml(whole_numbers, "scene").root);
  const Folder folder;
  (void)folder.file("wind.csv", "0 1\n1 2\n");
  for (const char* at :
       {"/bodies/arm/modes", "/bodies/rod/modes", "/bodies/beam/elements", "/bodies/beam/nodes_per_element",
        "/integrator/max_iterations", "/integrator/max_halvings", "/statics/load_steps", "/statics/max_iterations",
        "/modes/count", "/checkpoint/every", "/output/every"})
    for (const json& wrong : {json(2.5), json(-1), json(json::array({1}))}) {
      json changed = scene;
      changed[json::json_pointer(at)] = wrong;
      EXPECT_FALSE(Validator(schema).accepts(changed)) << at << ' ' << wrong;
      const std::string path = folder.file("scene.yaml", changed.dump());
      EXPECT_NE(error_of(folder, [&] { read_scene(path, {}); }), "") << at << ' ' << wrong;
    }
}

}  // namespace
}  // namespace tisserand::formats::schema_test
