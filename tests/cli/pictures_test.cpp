// SPDX-License-Identifier: GPL-3.0-or-later
// What pages and pictures hold of trials that failed once: rigid arms, cars that leave their place, modes without
// vibration.
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "common/child.hpp"
#include "tests/cli/scenes.hpp"

namespace tisserand::cli::pictures_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Pictures : public Folder {
 protected:
  void take(const std::string& name) {
    std::filesystem::copy_file(std::string(TISSERAND_SOURCE_DIR "/tests/verification/references/trials/") + name,
                               file(name));
  }
  Outcome reducer(std::vector<std::string> words) const {
    words.insert(words.begin(), program("reducer"));
    return call(words, where);
  }
  /// The only run of a page.
  json run_of(const std::string& page) const {
    const std::string text = read_text(file(page)), begin = "id=\"tisserand-header\">";
    const std::size_t at = text.find(begin) + begin.size();
    return json::parse(text.substr(at, text.find("</script>", at) - at))["runs"][0];
  }
  static std::vector<std::string> drawn(std::vector<std::string> words) {
    words.insert(words.begin(), "picture");
    if (::geteuid() == 0) words.push_back("--no-sandbox");
    return words;
  }
};

// A weight sits 45 mm above the node that holds it, at (0, 0, 0.045) of the node: the arm is no deformation.
TEST_F(Pictures, RigidArmsAreNoDeformation) {
  take("bracket.part.yaml");
  take("arm_exaggerated.scene.yaml");
  ASSERT_EQ(reducer({"run", "bracket.part.yaml"}).code, 0);
  ASSERT_EQ(mechanism({"run", "arm_exaggerated.scene.yaml"}).code, 0);
  ASSERT_EQ(mechanism({"view", "arm_exaggerated.results.h5", "--stress", "-o", "arm.html"}).code, 0);
  const json run = run_of("arm.html");
  bool is_found = false;
  for (const json& joint : run["joints"]) {
    if (joint["name"] != "pin") continue;
    is_found = true;
    const auto arm = joint["place"]["arm"].get<std::vector<double>>();
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(arm[i], i == 2 ? 0.045 : 0.0, 1e-12);
    for (const json& node : run["nodes"])
      if (node["name"] == "bracket/pin") {
        EXPECT_EQ(joint["place"]["rest"], node["place"]["rest"]) << "without the arm";
      }
  }
  EXPECT_TRUE(is_found);
  EXPECT_EQ(run["pascal"], 1.0);
  EXPECT_TRUE(run["moving"]["follow"].is_null()) << "nothing leaves its place";
  // What `reducer recover` finds, 3.94967e8 Pa at 0.0755 s, is the middle of a shell; the page has means at nodes.
  const json largest = run["shapes"][0]["stress"]["largest"];
  EXPECT_NEAR(largest["time"].get<double>(), 0.0755, 1e-9);
  EXPECT_GT(largest["value"].get<double>(), 0.9 * 3.94967e8);
  EXPECT_LT(largest["value"].get<double>(), 3.94967e8);
  EXPECT_TRUE(run["shapes"][1]["stress"].is_null()) << "the weight has no stress";
}

TEST_F(Pictures, EmptyOnesAreErrors) {
  if (!is_program("chromium")) GTEST_SKIP() << "not tested: there is no chromium here (apt-get install chromium)";
  take("bracket.part.yaml");
  take("arm_exaggerated.scene.yaml");
  ASSERT_EQ(reducer({"run", "bracket.part.yaml"}).code, 0);
  ASSERT_EQ(mechanism({"run", "arm_exaggerated.scene.yaml", "--set", "integrator.end=0.01"}).code, 0);
  const std::string results = "arm_exaggerated.results.h5";
  const Outcome full = mechanism(drawn({results, "--time", "0.005", "--exaggerate", "100", "-o", "full.png"}));
  EXPECT_EQ(full.code, 0) << full.error;
  // Seen from the front there is air between plate (z = 0) and ball (z above 0.042).
  expect_error(mechanism(drawn({results, "--view", "front", "--zoom", "20", "--hide", "joints", "-o", "air.png"})),
               {"air.png", "the picture would be empty", "--zoom"});
  EXPECT_FALSE(std::filesystem::exists(file("air.png")));
  expect_error(mechanism(drawn({results, "--follow", "brackt", "-o", "x.png"})), {"no body 'brackt'", "bracket"});
  if (::geteuid() == 0)
    expect_error(mechanism({"picture", results, "-o", "x.png"}),
                 {"root", "--no-sandbox", "if you trust the results file"});
}

// A block slides away for 40 times its size; the road under a car does not count, and is not followed.
TEST_F(Pictures, ACameraFollowsWhatLeavesItsPlace) {
  write_text(file("free.scene.yaml"), R"(scene: free
bodies:
  light: {type: rigid, mass: 1, inertia: [0.01, 0.01, 0.01], pose: {position: [0, 1, 0]}, velocity: [20, 0, 0]}
  heavy: {type: rigid, mass: 5, inertia: [0.01, 0.01, 0.01], velocity: [20, 0, 0]}
integrator: {step: 0.1, end: 2}
)");
  ASSERT_EQ(mechanism({"run", "free.scene.yaml"}).code, 0);
  ASSERT_EQ(mechanism({"view", "free.results.h5"}).code, 0);
  json run = run_of("free.html");
  ASSERT_FALSE(run["moving"]["follow"].is_null());
  EXPECT_EQ(run["bodies"][run["moving"]["follow"].get<std::size_t>()]["name"], "heavy");
  EXPECT_LT(run["moving"]["size"].get<double>(), 5.0);
  // The same, held by a hinge on the ground, which is shown with it.
  ASSERT_EQ(mechanism({"run", "free.scene.yaml", "-o", "held.results.h5", "--set",
                       "joints={slide: {type: prismatic, a: ground, b: heavy, axis: [1, 0, 0]}}"})
                .code,
            0);
  ASSERT_EQ(mechanism({"view", "held.results.h5"}).code, 0);
  run = run_of("held.html");
  EXPECT_TRUE(run["moving"]["follow"].is_null());
}

// m s² + c s + k with m = 2 kg, c = 100 N s/m, k = 100 N/m: s = -25 ± sqrt(575) = -1.0208 and -48.9792 1/s.
TEST_F(Pictures, OverdampedModesHavePoles) {
  take("negative_spring.scene.yaml");
  const Outcome outcome = mechanism(
      {"run", "negative_spring.scene.yaml", "--set", "springs.s.stiffness=100", "--set", "springs.s.damping=100"});
  ASSERT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("pole 1/s"), HasSubstr("-1.021"), HasSubstr("-48.98")));
  EXPECT_THAT(mechanism({"run", "negative_spring.scene.yaml", "--set", "springs.s.stiffness=100"}).out,
              AllOf(HasSubstr("Hz"), Not(HasSubstr("pole"))))
      << "an undamped spring vibrates";
}

TEST_F(Pictures, PagesOfAPartAndOfItsRecoveryFileLieBesideOneAnother) {
  take("bracket.part.yaml");
  ASSERT_EQ(reducer({"run", "bracket.part.yaml"}).code, 0);
  EXPECT_THAT(reducer({"view", "bracket.part.yaml"}).out, HasSubstr("bracket.part.html"));
  EXPECT_THAT(reducer({"view", "bracket.recovery.h5"}).out, HasSubstr("bracket.recovery.html"));
  // 8 x 4 quadrilaterals of two triangles: the page knows which belong together.
  EXPECT_EQ(run_of("bracket.part.html")["shapes"][0]["elements"]["shape"], (json{64, 1}));
}

TEST_F(Pictures, SuperelementsWithoutRecoveryFilesAreNamed) {
  ASSERT_EQ(mechanism({"run", "arm.scene.yaml", "-o", "arm.results.h5"}).code, 0);
  EXPECT_THAT(mechanism({"view", "arm.results.h5"}).out, AllOf(HasSubstr("'se'"), HasSubstr("recovery: yes")));
}

}  // namespace
}  // namespace tisserand::cli::pictures_test
