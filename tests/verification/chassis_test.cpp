// SPDX-License-Identifier: GPL-3.0-or-later
// The chassis of examples/chassis through the reducer, against [GA00]: counts of section 5.1, frequencies of Table 5.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "formats/superelement/superelement.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::formats::chassis_test {
namespace {

using Eigen::Vector3d;

class Chassis : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(TISSERAND_BINARY_DIR "/bin/reducer")) GTEST_SKIP() << "built without the reducer";
  }

  std::string file(const std::string& name) const { return folder_.file(name + ".superelement.h5"); }

  /// Reduces the example's part; superelement and certificate in the folder of the test. Returns the certificate.
  nlohmann::json reduce(const std::string& name, const std::string& settings) const {
    const std::string command = TISSERAND_BINARY_DIR "/bin/reducer run " TISSERAND_SOURCE_DIR
                                                     "/examples/chassis/chassis.part.yaml -o " +
                                file(name) + settings + " > " + folder_.file("log") + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::ifstream stream(folder_.file(name + ".superelement.certificate.json"));
    return nlohmann::json::parse(stream);
  }

  test_support::TemporaryFolder folder_;
};

// [GA00] section 5.1: 282 nodes, 262 beams, 121 shells, 18 point masses; the origin is the node at the centre of mass.
TEST_F(Chassis, HasThePapersCountsAndItsCentreNodeAtTheCentreOfMass) {
  const nlohmann::json certificate = reduce("held", " --set 'boundary=[center]' --set modes=10");
  const nlohmann::json& model = certificate.at("model");
  EXPECT_EQ(model.at("nodes"), 282);
  EXPECT_EQ(model.at("beams"), 262);
  EXPECT_EQ(model.at("shells"), 121);
  EXPECT_EQ(model.at("masses"), 18);
  const LoadedSuperelement loaded = read_superelement(file("held"));
  const Vector3d offset = loaded.report.rigid.center_of_mass - loaded.superelement.node_position.row(0).transpose();
  EXPECT_LT(offset.norm(), 0.005);        // [m]; the nearest other node is 0.1 m away
  EXPECT_LT(std::abs(offset.y()), 1e-9);  // left and right are alike
}

// The paper gives neither sections nor masses; ours are chosen within 10 % of its frequencies
// (examples/chassis/README.md).
TEST_F(Chassis, FrequenciesWithTheCentreNodeHeldAreThoseOfTable5) {
  const nlohmann::json certificate = reduce("held", " --set 'boundary=[center]' --set modes=10");
  const std::vector<double> held = certificate.at("file").at("fixed_boundary_frequency");
  const std::vector<double> paper = {6.97, 9.41, 10.96, 13.81, 25.26, 32.41, 38.55, 45.95, 50.27, 50.31};
  ASSERT_EQ(held.size(), paper.size());
  for (std::size_t i = 0; i < paper.size(); ++i) EXPECT_NEAR(held[i], paper[i], 0.1 * paper[i]) << "mode " << i + 1;
}

// Craig and Bampton's method is a Ritz method: frequencies from above, their squares λ by no more than the bound of
// Elssel and Voss (2006), λ/(λ_c - λ) with λ_c the first one dropped (boundary held).
TEST_F(Chassis, ReducedToEightAttachmentsItKeepsItsFreeFrequencies) {
  const nlohmann::json certificate = reduce("chassis", "");
  const nlohmann::json& model = certificate.at("model");
  const std::vector<double> reduced = certificate.at("file").at("free_frequency"), full = model.at("free_frequency");
  const double dropped = model.at("first_dropped_frequency");
  std::size_t compared = 0;
  for (std::size_t i = 0; i < std::min(reduced.size(), full.size()); ++i) {
    EXPECT_GT(reduced[i], full[i] * (1.0 - 1e-6)) << "mode " << i + 1;
    if (full[i] > dropped) continue;
    const double lambda = full[i] * full[i], bound = lambda / (dropped * dropped - lambda);
    EXPECT_LT(std::pow(reduced[i] / full[i], 2) - 1.0, bound) << "mode " << i + 1;
    ++compared;
  }
  EXPECT_GE(compared, 10u);
  const LoadedSuperelement loaded = read_superelement(file("chassis"));
  EXPECT_EQ(loaded.superelement.node_name.size(), 8u);
  const double mass = model.at("rigid").at("mass");
  EXPECT_NEAR(loaded.report.rigid.mass, mass, 1e-9 * mass);
}

}  // namespace
}  // namespace tisserand::formats::chassis_test
