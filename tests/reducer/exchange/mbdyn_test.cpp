// SPDX-License-Identifier: GPL-3.0-or-later
// MBDyn's FEM data file: record groups as in its input manual, and modes that hold all of the superelement.
#include "reducer/exchange/mbdyn.hpp"

#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/QR>

#include "tests/reducer/exchange/exchange_files.hpp"

namespace tisserand::reducer::exchange::mbdyn_test {
namespace {

using testing::error_of;
using ::testing::HasSubstr;

/// A reader after the appendix "FEM File Format" of the MBDyn input manual: words of each record group without
/// comments.
std::map<int, std::vector<std::string>> record_groups(const std::string& text) {
  std::map<int, std::vector<std::string>> groups;
  std::istringstream lines(text);
  int group = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("** END OF FILE", 0) == 0) break;
    if (line.rfind("** RECORD GROUP ", 0) == 0) group = std::stoi(line.substr(16));
    if (line.rfind("**", 0) == 0) continue;
    std::istringstream words(line);
    for (std::string word; words >> word;) groups[group].push_back(word);
  }
  return groups;
}

Eigen::VectorXd values(const std::vector<std::string>& words) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(words.size()));
  for (std::size_t i = 0; i < words.size(); ++i) v[i] = std::stod(words[i]);
  return v;
}

TEST(Mbdyn, RecordGroupsHaveTheSizesOfTheHeader) {
  const formats::Superelement beam = testing::reduced_beam();
  const std::string text = mbdyn_text(beam, "beam");
  auto groups = record_groups(text);
  constexpr Eigen::Index modes = 10;  // 12 + 4 coordinates less 6 rigid motions
  EXPECT_EQ(groups[1], (std::vector<std::string>{"REV0", "2", "10", "0", "0", "0"}));
  EXPECT_EQ(groups[2], (std::vector<std::string>{"base", "tip"}));
  EXPECT_EQ(values(groups[3]), Eigen::VectorXd::Zero(modes));
  EXPECT_EQ(values(groups[4]), Eigen::VectorXd::Zero(modes));
  EXPECT_EQ(values(groups[5]), Eigen::Vector2d(0, 2));
  EXPECT_EQ(values(groups[6]), Eigen::Vector2d(0, 0));
  EXPECT_EQ(values(groups[7]), Eigen::Vector2d(0, 0));
  EXPECT_EQ(groups[8].size(), 12u * modes);
  EXPECT_EQ(values(groups[9]).reshaped(modes, modes), Eigen::MatrixXd::Identity(modes, modes));
  EXPECT_EQ(groups[10].size(), static_cast<std::size_t>(modes * modes));
  EXPECT_EQ(groups.count(11), 0u);
  const Eigen::VectorXd inertia = values(groups[12]);
  ASSERT_EQ(inertia.size(), 13);
  EXPECT_NEAR(inertia[0], 6.24, 1e-12);                               // ρ A L
  EXPECT_NEAR(inertia[1], 1.0, 1e-12);                                // L/2
  EXPECT_NEAR(inertia[8], 6.24 * 4 / 12 + 7800 * 1.5e-8 * 2, 1e-12);  // about y: ρ A L³/12 + ρ Iy L
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LT(line.size(), 1000u);
}

/// The manual's own example ("Dynamic Model"): the reader of this test understands it.
TEST(Mbdyn, TheReaderOfThisTestUnderstandsTheManual) {
  auto groups = record_groups(
      "** MBDyn MODAL DATA FILE\n** NODE SET \"ALL\"\n\n** RECORD GROUP 1, HEADER\n"
      "**   REVISION,  NODE,  NORMAL, ATTACHMENT, CONSTRAINT, REJECTED MODES.\n"
      "      REV0         3         2         0         0         0\n**\n"
      "** RECORD GROUP 2, FINITE ELEMENT NODE LIST\n     1001 1002 1003\n\n**\n"
      "** RECORD GROUP 8, MODE SHAPES\n**    NORMAL MODE SHAPE #  1\n0 0 1 0 0 0\n0 0 0 0 0 0\n0 0 1 0 0 0\n"
      "**    NORMAL MODE SHAPE #  2\n1 0 0 0 0 0\n0 0 0 0 0 0\n1 0 0 0 0 0\n");
  EXPECT_EQ(groups[1].size(), 6u);
  EXPECT_EQ(groups[2].size(), 3u);
  EXPECT_EQ(values(groups[8]).size(), 2 * 3 * 6);
}

TEST(Mbdyn, ModesAreFreeElasticModesAndHoldAllOfTheSuperelement) {
  const formats::Superelement beam = testing::reduced_beam();
  const ElasticModes modes = elastic_modes(beam, "beam");
  const Eigen::MatrixXd R = formats::rigid_motions(beam, formats::rigid_properties(beam).center_of_mass);
  const Eigen::MatrixXd& Y = modes.shape;
  const Eigen::MatrixXd momentum = R.transpose() * beam.mass * Y;
  EXPECT_LT(momentum.cwiseAbs().maxCoeff(), 1e-11 * std::sqrt(beam.mass.cwiseAbs().maxCoeff()));
  EXPECT_LT((Y.transpose() * beam.mass * Y - Eigen::MatrixXd(modes.mass.asDiagonal())).cwiseAbs().maxCoeff(), 1e-10);
  const Eigen::MatrixXd K = Y.transpose() * beam.stiffness * Y;
  EXPECT_LT(testing::distance(Eigen::MatrixXd(modes.stiffness.asDiagonal()), K), 1e-9);
  for (Eigen::Index k = 1; k < modes.stiffness.size(); ++k) EXPECT_LE(modes.stiffness[k - 1], modes.stiffness[k]);
  // Flexibility of the free part between balanced loads f (Rᵀ f = 0): the same from the modes as from S itself.
  Eigen::VectorXd f = Eigen::VectorXd::Zero(beam.size());
  f[5] = 3.0, f[11] = -3.0, f[0] = 2.0, f[6] = -2.0;
  const Eigen::VectorXd y = beam.stiffness.completeOrthogonalDecomposition().solve(f);
  const Eigen::VectorXd q = (Y.transpose() * f).cwiseQuotient(modes.stiffness);
  EXPECT_NEAR(f.dot(Y * q), f.dot(y), 1e-9 * f.dot(y));
}

/// First free bending frequency of a uniform beam, (4.7300407/L)² √(EI/ρA): Blevins, Formulas for Natural Frequency and
/// Mode Shape, 1979, table 8-1. Four internal coordinates reach it within half a per cent, from above.
TEST(Mbdyn, FirstFrequencyOfTheFreeBeam) {
  test_support::BeamData data;
  data.rotary_inertia = false;
  const formats::Superelement beam = test_support::craig_bampton_beam(data, 8);
  const double expected = std::pow(4.7300407 / 2.0, 2) * std::sqrt(2.1e11 * 1.5e-8 / (7800 * 4e-4));
  const double found = std::sqrt(elastic_modes(beam, "beam").stiffness[0]);
  EXPECT_GT(found, expected * (1 - 1e-9));
  EXPECT_LT(found, expected * 1.005);
}

TEST(Mbdyn, NodesWithoutRotationsAreRefused) {
  formats::Superelement beam = testing::reduced_beam();
  std::vector<int> rows;
  for (int i = 0; i < 16; ++i)
    if (i < 9 || i > 11) rows.push_back(i);
  beam = test_support::permute_rows(beam, rows);
  EXPECT_THAT(error_of([&] { static_cast<void>(mbdyn_text(beam, "b.h5")); }), HasSubstr("node 'tip'"));
}

/// A beam without inertia about its axis: the missing momentum is no reason to lose a mode.
TEST(Mbdyn, MotionsWithoutInertiaAreNoModes) {
  formats::Superelement beam = test_support::beam_superelement({});
  for (const int i : {3, 9}) {
    beam.mass.row(i).setZero();
    beam.mass.col(i).setZero();
  }
  const ElasticModes modes = elastic_modes(beam, "beam");
  EXPECT_EQ((modes.mass.array() == 0.0).count(), 1);  // twist moves no mass
  EXPECT_EQ(modes.mass.size(), 6);
  const Eigen::MatrixXd K = modes.shape.transpose() * beam.stiffness * modes.shape;
  EXPECT_LT(testing::distance(Eigen::MatrixXd(modes.stiffness.asDiagonal()), K), 1e-9);
}

}  // namespace
}  // namespace tisserand::reducer::exchange::mbdyn_test
