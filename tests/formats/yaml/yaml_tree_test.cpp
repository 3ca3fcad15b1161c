// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of load_yaml and parse_yaml: what is no YAML, what would be too much, and where values stand.
#include "formats/yaml/tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::yaml_tree_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string error(const std::string& text) {
  const Folder folder;
  return error_of(folder, [&] { parse_yaml(text, "a.yaml"); });
}

TEST(YamlTree, KeepsKindsAndPlaces) {
  const YamlDocument document = parse_yaml("# comment\nä: \"3\"\nlist: [1,\n  {x: y}]\nempty:\n", "a.yaml");
  ASSERT_EQ(document.root.children.size(), 3u);
  const YamlNode& first = document.root.children[0];
  EXPECT_EQ(first.key, "ä");
  EXPECT_TRUE(first.quoted);
  EXPECT_EQ(document.where(first.key_place), "a.yaml:2:1");
  const YamlNode& list = document.root.children[1];
  EXPECT_EQ(list.kind, YamlKind::sequence);
  EXPECT_EQ(document.where(list.place), "a.yaml:3:7");
  EXPECT_EQ(document.where(list.children[1].children[0].place), "a.yaml:4:7");
  EXPECT_EQ(document.root.children[2].kind, YamlKind::null);
}

TEST(YamlTree, ResolvesAliasesByCopy) {
  const YamlDocument document = parse_yaml("a: &one {x: 1}\nb: *one\n", "a.yaml");
  EXPECT_EQ(document.root.children[1].key, "b");
  EXPECT_EQ(document.root.children[1].children.at(0).text, "1");
}

TEST(YamlTree, RejectsWhatIsNoDocument) {
  EXPECT_EQ(error(""), "a.yaml: the file is empty");
  EXPECT_EQ(error("# only a comment\n"), "a.yaml: the file is empty");
  EXPECT_EQ(error("a: 1\n---\nb: 2\n"),
            "a.yaml:3:1: a second YAML document begins after '---'; keep one document per file");
  EXPECT_THAT(error("a: [1\nb: 2\n"), StartsWith("a.yaml:2:2: not valid YAML: "));
  EXPECT_EQ(error("b: 1\na: \"open \\\" \n"),
            "a.yaml:2:4: not valid YAML: the quote that opens here is not closed; close it");
  EXPECT_EQ(error("a: 'it''s open\nb: 3\n"),
            "a.yaml:1:4: not valid YAML: the quote that opens here is not closed; close it");
  EXPECT_EQ(error("a: 'it''s'\nb: \"\\\"\"\nc: |\n  it's\n"), "");
  EXPECT_THAT(error("a: 1\n\tb: 2\n"), HasSubstr("not valid YAML"));
  EXPECT_THAT(error("a: node: b\n"), HasSubstr("not valid YAML"));
  EXPECT_THAT(error("a: *nobody\n"), HasSubstr("not valid YAML"));
  EXPECT_EQ(error("a: !!int 3\n"), "a.yaml:1:4: YAML tag 'tag:yaml.org,2002:int' is not supported; remove it");
  EXPECT_EQ(error("<<: {a: 1}\n"), "a.yaml:1:1: YAML merge keys '<<' are not supported; copy the keys to this place");
  EXPECT_EQ(error("[1, 2]: 3\n"), "a.yaml:1:1: a key must be text, not a list of 2");
}

TEST(YamlTree, RejectsOtherKindsOfFiles) {
  EXPECT_EQ(error(std::string("\x89HDF\r\n\x1a\n", 8)),
            "a.yaml:1:1: byte 0x89 is not text in UTF-8; check that this is a text file, and save it as UTF-8");
  EXPECT_EQ(error(std::string("a: 1\nb: \0", 9)),
            "a.yaml:2:4: byte 0x00 is not text in UTF-8; check that this is a text file, and save it as UTF-8");
  const Folder folder;
  EXPECT_EQ(error_of(folder, [&] { load_yaml(folder.path() + "/none.yaml"); }),
            "none.yaml: cannot open the file: No such file or directory; check path and permission");
  EXPECT_THAT(error_of(folder, [&] { load_yaml(folder.path()); }), HasSubstr("is a folder, not a file; give a file"));
  EXPECT_THAT(error_of(folder, [&] { load_yaml("/dev/zero"); }), HasSubstr("is not a regular file"));
}

TEST(YamlTree, BoundsDepth) {
  const std::string expected = "values are nested more than 100 levels deep; look for brackets that are not closed";
  EXPECT_THAT(error(std::string(200'000, '[')), HasSubstr(expected));
  std::string lists, maps;
  for (int i = 0; i < 100'000; ++i) lists += "- ", maps += "{a: ";
  EXPECT_THAT(error(lists), HasSubstr(expected));
  EXPECT_THAT(error(maps), HasSubstr(expected));
  EXPECT_EQ(error(std::string(90, '[') + std::string(90, ']')), "");
}

TEST(YamlTree, BoundsAliases) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string last = fmt::format("*a{}", i - 1);
    bomb += fmt::format("a{}: &a{} [{}", i, i, last);
    for (int k = 0; k < 8; ++k) bomb += ", " + last;
    bomb += "]\n";
  }
  EXPECT_THAT(error(bomb), HasSubstr("the file has more than 1000000 values, counting the values of its aliases"));
  EXPECT_THAT(error("a: &a [*a]\n"),
              HasSubstr("the alias refers to a value that contains this alias; write the value instead of the alias"));
  EXPECT_THAT(error(std::string((16u << 20) + 1, '#')), HasSubstr("the file has more than 16777216 bytes"));
}

}  // namespace
}  // namespace tisserand::formats::yaml_tree_test
