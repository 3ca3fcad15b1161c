// SPDX-License-Identifier: GPL-3.0-or-later
// study.yaml: axes in the place of their names, and findings.
#include "formats/study/study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/yaml/emit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::formats::study_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* example = R"yaml(study: example
axes: {integrator.step: [0.1, 0.05]}
set: {integrator.end: 2, parameters.n: 1}
series:
  a:
    scene: a.scene.yaml
    axes: {pieces: [1, 2], frame: [karcher, {node: base}]}
    set: {parameters.n: $pieces, parameters.length: "${6 / pieces}", bodies.arm.frame: $frame, parameters.name: "p_$pieces"}
    channels: {tip: "nodes/position/piece[${pieces - 1}]/tip/x"}
  b: {scene: sub/b.scene.yaml}
quantities:
  tip: {channel: nodes/position/tip/x, norm: rms}
)yaml";

class StudyFile : public ::testing::Test {
 protected:
  Study read(const std::string& text) {
    write_text_file(folder.file("a.study.yaml"), text);
    return read_study(folder.file("a.study.yaml"));
  }
  std::string error_of(const std::string& text) {
    try {
      (void)read(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  static std::string replaced(std::string text, const std::string& from, const std::string& to) {
    EXPECT_NE(text.find(from), std::string::npos) << from;
    return text.replace(text.find(from), from.size(), to);
  }
  test_support::TemporaryFolder folder;
};

std::vector<std::string> words(const std::vector<Override>& settings) {
  std::vector<std::string> list;
  for (const Override& one : settings) list.push_back(one.path + "=" + one.value);
  return list;
}

TEST_F(StudyFile, OwnAxesComeFirstAndOwnSettingsLast) {
  const Study study = read(example);
  ASSERT_EQ(study.series.size(), 2u);
  const StudySeries& a = study.series[0];
  ASSERT_EQ(a.axes.size(), 3u);
  EXPECT_EQ(a.axes[0].name, "pieces");
  EXPECT_EQ(a.axes[2].name, "integrator.step");
  EXPECT_EQ(study.series[1].axes.size(), 1u);
  EXPECT_EQ(study.series[1].scene, folder.file("sub/b.scene.yaml"));
  const StudyPoint point{
      {"pieces", a.axes[0].values[1]}, {"frame", a.axes[1].values[1]}, {"integrator.step", a.axes[2].values[0]}};
  EXPECT_THAT(words(settings_at(study, a, point)),
              ElementsAre("integrator.end=2", "parameters.n=2", "parameters.length=3", "bodies.arm.frame={node: base}",
                          "parameters.name=\"p_2\"", "integrator.step=0.1"));
  EXPECT_EQ(channel_at(study, a, study.quantities[0], point), "nodes/position/piece[1]/tip/x");
  EXPECT_EQ(channel_at(study, study.series[1], study.quantities[0], {}), "nodes/position/tip/x");
}

TEST_F(StudyFile, SaysWhatIsWrong) {
  EXPECT_THAT(error_of(replaced(example, "$frame", "karcher")), HasSubstr("axis 'frame' sets nothing in series 'a'"));
  EXPECT_THAT(error_of(replaced(example, "[1, 2]", "[1, 1]")), HasSubstr("axis 'pieces' has the value 1 twice"));
  EXPECT_THAT(error_of(replaced(example, "[1, 2]", "3")), HasSubstr("needs a list of values"));
  EXPECT_THAT(error_of(replaced(example, "{tip: \"nodes", "{top: \"nodes")), HasSubstr("'top'"));
  EXPECT_THAT(error_of(replaced(example, "norm: rms", "norm: rsm")), HasSubstr("rms"));
  EXPECT_THAT(error_of(replaced(example, "norm: rms", "scale: -1")), HasSubstr("scale is -1"));
  EXPECT_THAT(error_of(std::string(example) + "along: piece\n"), HasSubstr("did you mean"));
  EXPECT_THAT(error_of(std::string(example) + "reference: {file: a.csv}\n"), HasSubstr("has no 'source'"));
  EXPECT_THAT(error_of(std::string(example) + "reference: {file: a.csv, source: b, runs: [{}]}\n"),
              HasSubstr("either 'file' or 'runs'"));
  EXPECT_THAT(error_of(std::string(example) + "reference: {runs: [{at: {piece: 2}}]}\n"), HasSubstr("pieces"));
}

TEST(EmittedYaml, ReadsBackAsTheSameTree) {
  const std::string text =
      "a: {b: [1, \"2\", \"x: y\", true], \"c d\": null, 'e': \"it's, [so]\"}\nf: \"line\\nend\"\ng: plain text\n";
  const auto emitted = [](const std::string& given) { return block_text(parse_yaml(given, "a").root); };
  EXPECT_EQ(emitted(emitted(text)), emitted(text));
  const YamlDocument again = parse_yaml(emitted(text), "again");
  const YamlNode& list = again.root.children[0].children[0];
  EXPECT_FALSE(list.children[0].quoted);
  EXPECT_TRUE(list.children[1].quoted);
  EXPECT_EQ(list.children[2].text, "x: y");
  EXPECT_EQ(again.root.children[1].text, "line\nend");
  const YamlDocument one_line = parse_yaml("v: " + flow_text(again.root.children[0]), "line");
  EXPECT_EQ(flow_text(one_line.root.children[0]), flow_text(again.root.children[0]));
}

}  // namespace
}  // namespace tisserand::formats::study_test
