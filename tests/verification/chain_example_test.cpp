// SPDX-License-Identifier: GPL-3.0-or-later
// The chain of examples/ with few links: what holds the links together changes nothing, and stiff superelements fall
// like rigid links.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "formats/yaml/override.hpp"
#include "mechanism/histories/series.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::chain_example_test {
namespace {

constexpr int kLinks = 12;

class ChainExample : public ::testing::Test {
 protected:
  /// Links of steel, 1 m long, of radius 1 cm, without modes: written here, so that the test needs no other program.
  void SetUp() override {
    test_support::BeamData beam;
    beam.length = 1.0;
    beam.young = 2.1e11;
    beam.shear_modulus = 2.1e11 / 2.6;
    beam.density = 7800.0;
    beam.area = M_PI * 1e-4;
    beam.Iy = beam.Iz = M_PI * 1e-8 / 4.0;
    beam.J = M_PI * 1e-8 / 2.0;
    formats::Superelement link = test_support::beam_superelement(beam);
    formats::write_superelement(file(), link);
  }

  std::string file() const { return folder_.file("link.superelement.h5"); }

  RunReport run(const std::string& kind, const std::string& result, std::vector<std::string> settings = {}) const {
    settings.insert(settings.end(), {"parameters.links=" + std::to_string(kLinks), "integrator.end=0.4",
                                     "output={every: 10, channels: [nodes/position, energy]}"});
    if (kind != "rigid") settings.push_back("parameters.file=" + file());
    std::vector<formats::Override> overrides;
    for (const std::string& setting : settings) overrides.push_back(formats::parse_override(setting));
    const std::string path = TISSERAND_SOURCE_DIR "/examples/chain/" + kind + ".scene.yaml";
    return simulate(formats::read_scene(path, overrides), folder_.file(result), RunControl{});
  }

  /// Height over time of the free end, `node` of the last link.
  std::vector<double> end(const std::string& result, const std::string& node) const {
    const std::string channel = "nodes/position/link[" + std::to_string(kLinks - 1) + "]/" + node + "/z";
    return read_series({{folder_.file(result)}, {}, {channel}, {}}).front().y;
  }

  test_support::TemporaryFolder folder_;
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

TEST_F(ChainExample, VirtualBodiesChangeNothing) {
  const RunReport direct = run("superelement", "direct");
  const RunReport eliminated = run("virtual", "eliminated");
  const RunReport kept = run("virtual", "kept", {"virtual_bodies=keep"});
  EXPECT_EQ(direct.outcome, RunOutcome::completed);
  EXPECT_EQ(eliminated.unknowns, direct.unknowns);
  EXPECT_EQ(kept.unknowns, direct.unknowns + 12 * kLinks);
  // Newton's tolerance on the position of the joints, 1e-10 of 12 m, at each of twelve joints.
  EXPECT_LT(largest_difference(end("direct", "bar/tip"), end("eliminated", "bar/tip")), 1.5e-8);
  EXPECT_LT(largest_difference(end("direct", "bar/tip"), end("kept", "bar/tip")), 1.5e-8);
}

TEST_F(ChainExample, StiffLinksFallLikeRigidOnes) {
  const RunReport rigid = run("rigid", "rigid");
  EXPECT_EQ(rigid.mobility.degrees_of_freedom, 3 * kLinks);
  EXPECT_LT(rigid.largest_balance,
            1e-3 * rigid.energy_reference);  // generalised-alpha damps what the step cannot follow
  EXPECT_EQ(run("superelement", "superelement").outcome, RunOutcome::completed);
  const std::vector<double> height = end("rigid", "bar/tip");
  EXPECT_LT(height.back(), -0.5);  // free fall: -g t²/2 = -0.78
  // The bars bend by 5 w l⁴/(384 E I) = 0.19 mm under their own weight, each; twelve of them.
  EXPECT_LT(largest_difference(height, end("superelement", "bar/tip")), 12 * 0.19e-3);
}

}  // namespace
}  // namespace tisserand::mechanism::chain_example_test
