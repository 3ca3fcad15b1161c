// Component mode synthesis of a space truss in two components, against NASTRAN and an independent program.
#include <gtest/gtest.h>

#include <fstream>

#include <nlohmann/json.hpp>

#include "tests/reducer/parts.hpp"
#include "tests/reducer/truss.hpp"
#include "tests/support/reference_table.hpp"

namespace tisserand::testing {
namespace {

using nlohmann::json;
using test_support::reference_rows;

TEST(Truss, FullModelAgreesWithAnIndependentProgram) {
  const Eigen::VectorXd f = full_frequencies();
  const auto expected = reference_rows("truss/full_consistent_frequencies.csv");
  // Printed with eight decimals; 1e-6 leaves room for the rounding of the slow modes only.
  for (std::size_t k = 6; k < 26; ++k)
    EXPECT_NEAR(f[static_cast<Eigen::Index>(k)] / expected[k][1], 1.0, 1e-6) << "mode " << k + 1;
}

TEST(Truss, FixedBoundaryFrequenciesAreThoseOfNastran) {
  const json expected = json::parse(std::ifstream(TISSERAND_REFERENCES "/truss/frequencies.json"));
  for (const auto& [component, modes] : {std::pair{"inboard", 3}, std::pair{"outboard", 16}}) {
    const auto f = reduce(truss({component}, modes)).file.fixed_frequency;
    const json& nastran = expected.at(std::string(component) + "_fixed_interface_below_50_Hz");
    ASSERT_EQ(nastran.size(), f.size());
    // NASTRAN leaves the torsional inertia out: up to 1.2e-4 in the system's modes.
    for (std::size_t k = 0; k < f.size(); ++k)
      EXPECT_NEAR(f[k] / nastran[k].get<double>(), 1.0, 2e-4) << component << k;
  }
}

TEST(Truss, ErrorsOfTheReductionAreTheExpectedOnes) {
  const Eigen::VectorXd full = full_frequencies();
  int compared = 0;
  for (const std::vector<double>& row : reference_rows("truss/craig_bampton_errors.csv")) {
    const Eigen::VectorXd f = assembled_frequencies(static_cast<int>(row[1]), static_cast<int>(row[2]));
    for (std::size_t k = 6; k < 26; ++k) {
      const double expected = row[k - 3];
      const auto mode = static_cast<Eigen::Index>(k);
      if (mode >= f.size() || !(expected > 1e-6)) continue;
      ++compared;
      EXPECT_NEAR((f[mode] / full[mode] - 1.0) / expected, 1.0, 0.05) << "cut-off " << row[0] << " Hz, mode " << k + 1;
    }
  }
  EXPECT_GT(compared, 60);
}

}  // namespace
}  // namespace tisserand::testing
