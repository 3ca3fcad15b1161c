// SPDX-License-Identifier: GPL-3.0-or-later
// The table of joint kinds against the enum, the reader, the JSON Schema and the page.
#include "formats/joints/joint_kinds.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <source_location>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/text.hpp"
#include "formats/scene/fields.hpp"
#include "formats/scene/scene.hpp"
#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::joint_kinds_test {
namespace {

using ::testing::HasSubstr;

std::string content(const std::string& path) {
  std::ifstream stream(std::string(TISSERAND_SOURCE_DIR) + path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Name of the enumerator as the compiler spells it in the name of this function, or nothing if there is none.
template <JointKind kind>
std::string enumerator() {
  std::string text = std::source_location::current().function_name();
  text.erase(0, text.find("kind = ") + 7);
  text.erase(text.find_first_of(";]"));
  const bool is_cast = text.starts_with("(");
  return is_cast ? "" : text.substr(text.rfind(':') + 1);
}

template <int... k>
std::vector<std::string> enumerators(std::integer_sequence<int, k...>) {
  std::vector<std::string> names{enumerator<static_cast<JointKind>(k)>()...};
  std::erase(names, "");
  return names;
}

TEST(JointKinds, EveryKindOfTheEnumHasOneRowWithAWordOfItsOwn) {
  std::vector<std::string> words;
  for (const JointKindRow& row : joint_kinds()) {
    words.emplace_back(row.word);
    EXPECT_EQ(&joint_kind(row.kind), &row);
    EXPECT_EQ(find_joint_kind(row.word), &row);
    EXPECT_EQ(joint_word(row.kind), row.word);
  }
  EXPECT_EQ(words, enumerators(std::make_integer_sequence<int, 64>()));
  EXPECT_EQ(std::set<std::string>(words.begin(), words.end()).size(), words.size());
  EXPECT_EQ(find_joint_kind("gear"), nullptr);
}

/// Cells of the row that begins with the word, of the table of the page with that header.
std::vector<std::string> cells(const std::string& header, std::string_view word) {
  static const std::string page = content("/formats/SCENE.md");
  const std::size_t table = page.find(header), begin = page.find(fmt::format("\n| `{}` | ", word), table);
  if (table == std::string::npos || begin == std::string::npos) return {};
  std::string line = page.substr(begin + 1, page.find('\n', begin + 1) - begin - 1);
  std::vector<std::string> list;
  for (std::size_t bar = line.find(" | "); bar != std::string::npos; bar = line.find(" | ")) {
    list.push_back(line.substr(2, bar - 2));
    line.erase(0, bar + 1);
  }
  list.push_back(line.substr(2, line.size() - 4));
  return list;
}

TEST(JointKinds, ThePageSaysWhatTheTableSays) {
  for (const JointKindRow& row : joint_kinds()) {
    const std::vector<std::string> reported = cells("| `type` | what it holds | equations | coordinates |", row.word);
    ASSERT_EQ(reported.size(), 4u) << row.word;
    EXPECT_EQ(reported[1], row.holds);
    EXPECT_EQ(reported[2], row.key == JointKey::hold ? "1-6" : std::to_string(row.equations)) << row.word;
    std::vector<std::string> names;
    for (const std::string_view name : row.coordinates) names.push_back(fmt::format("`{}`", name));
    if (row.key == JointKey::hold)
      for (const std::string& name : names) EXPECT_THAT(reported[3], HasSubstr(name));
    else
      EXPECT_EQ(reported[3], names.empty() ? "-" : join(names, ", ")) << row.word;
  }
}

/// The words of the kinds with friction of which `lacks` is true, as on the page.
template <class Lacks>
std::string not_for(Lacks lacks) {
  std::vector<std::string> words;
  for (const JointKindRow& row : joint_kinds())
    if (row.friction.has_friction && lacks(row.friction)) words.push_back(fmt::format("`{}`", row.word));
  return fmt::format("[length]; not for {} |", join(words, ", "));
}

TEST(JointKinds, ThePageReportsWhatFrictionNeeds) {
  const std::string page = content("/formats/SCENE.md");
  EXPECT_THAT(page, HasSubstr("| `radius` | r of the contact surface " +
                              not_for([](const FrictionKeys& keys) { return !keys.radius; })));
  EXPECT_THAT(page, HasSubstr("| `arm` | distance of two supports that take the reaction moment " +
                              not_for([](const FrictionKeys& keys) { return !keys.arm; })));
  const std::size_t begin = page.find("| kind | s | f | m |"), end = page.find("The other kinds have no contact");
  ASSERT_LT(begin, end);
  const std::string table = page.substr(begin, end - begin);
  for (const JointKindRow& row : joint_kinds())
    EXPECT_EQ(table.find(fmt::format("`{}`", row.word)) != std::string::npos, row.friction.has_friction) << row.word;
}

TEST(JointKinds, TheSchemaHasTheSameWords) {
  const nlohmann::json definitions = nlohmann::json::parse(content("/formats/schema/scene.schema.json")).at("$defs");
  std::vector<std::string> words;
  for (const JointKindRow& row : joint_kinds()) words.emplace_back(row.word);
  EXPECT_EQ(definitions.at("joint").at("properties").at("type").at("anyOf").at(0).at("enum"), words);
  const std::vector<KeySet> sets = scene_key_sets();
  for (const GearKindRow& gear : gear_kinds) {
    const nlohmann::json& definition = definitions.at(std::string(gear.word));
    EXPECT_EQ(definition.at("properties").at("type").at("const"), gear.word);
    EXPECT_TRUE(definition.at("properties").contains(std::string(gear.key)));
    const auto set = std::ranges::find(sets, gear.word, &KeySet::noun);
    ASSERT_NE(set, sets.end()) << gear.word;
    EXPECT_TRUE(std::ranges::find(set->fields, gear.key, &Field::key) != set->fields.end());
  }
}

const std::map<JointKey, std::string> own_keys{
    {JointKey::hold, ", hold: [x, rz]"}, {JointKey::pitch, ", pitch: 0.1"}, {JointKey::length, ", length: 2"}};

/// A joint of that kind with the keys given.
std::string scene_with(std::string_view word, const std::string& keys) {
  return fmt::format(
      "scene: one\nbodies:\n  a: {{type: rigid, mass: 1, inertia: [1, 1, 1]}}\njoints:\n  j: {{type: {}, a: ground, b: "
      "a{}}}\nintegrator: {{step: 0.01, end: 1}}\n",
      word, keys);
}

TEST(JointKinds, EachIsReadWithItsOwnKeysAndThoseOfOthersAreRefused) {
  const Folder folder;
  for (const JointKindRow& row : joint_kinds()) {
    SCOPED_TRACE(row.word);
    const std::string axis = row.axes == JointAxes::required ? ", axis: [0, 0, 1]" : "";
    const std::string keys = axis + (row.key == JointKey::none ? "" : own_keys.at(row.key));
    const Scene scene = read_scene(folder.file("scene.yaml", scene_with(row.word, keys)), {});
    ASSERT_EQ(scene.joints.size(), 1u);
    EXPECT_EQ(scene.joints[0].kind, row.kind);
    EXPECT_EQ(scene.joints[0].hold[5], row.key == JointKey::hold);
    EXPECT_EQ(scene.joints[0].pitch, row.key == JointKey::pitch ? 0.1 : 0.0);
    EXPECT_EQ(scene.joints[0].length.has_value(), row.key == JointKey::length);
    const auto error = [&](const std::string& text) {
      const std::string path = folder.file("scene.yaml", scene_with(row.word, text));
      return error_of(folder, [&] { read_scene(path, {}); });
    };
    for (const auto& [key, text] : own_keys)
      if (key != row.key) {
        EXPECT_THAT(error(keys + text), HasSubstr(fmt::format("'{}' belongs to joints of type", joint_key_word(key))));
      }
    if (!axis.empty()) {
      EXPECT_THAT(error(keys.substr(axis.size())), HasSubstr(fmt::format("a {} joint needs an axis", row.word)));
    }
  }
}

// F_i for displacements along axis i, −F_i for angles about it: none of those that motions and springs of a mirrored
// assembly refer to may change its sign.
TEST(JointKinds, MirroredAxesKeepTheSignsOfCoordinates) {
  for (const JointKindRow& row : joint_kinds()) {
    SCOPED_TRACE(row.word);
    const std::array<double, 3>& F = row.mirrored_axes;
    EXPECT_EQ(F[0] * F[1] * F[2], -1.0);
    const std::map<std::string_view, double> sign{{"x", F[0]},      {"y", F[1]},        {"z", F[2]},
                                                  {"angle", -F[2]}, {"angle_x", -F[0]}, {"angle_y", -F[1]}};
    const bool has_angle = std::ranges::find(row.coordinates, "angle") != row.coordinates.end();
    const bool has_x = std::ranges::find(row.coordinates, "x") != row.coordinates.end();
    for (const std::string_view name : row.coordinates) {
      ASSERT_TRUE(sign.contains(name)) << name;
      if (name != "z" || (!has_angle && !has_x)) {
        EXPECT_EQ(sign.at(name), 1.0) << name;
      }
    }
  }
}

}  // namespace
}  // namespace tisserand::formats::joint_kinds_test
