// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of parts that cannot be meant are named: the trials stiff_spring and unlikely_values.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "formats/part/part.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::testing::stiff_spring_test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// A bar of 20 beams of EA/L = 8.4e8 N/m with a spring at its tip.
formats::Part bar(const std::string& stiffness, const std::string& poisson) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.file("bar.part.yaml")) << R"(part: bar
materials: {steel: {E: 2.1e11, nu: )" + poisson + R"(, density: 7800}}
sections: {rod: {shape: rectangle, width: 0.02, height: 0.02}}
points: {base: [0, 0, 0], tip: [2, 0, 0]}
beams: {axis: {from: base, to: tip, section: rod, material: steel, elements: 20}}
springs: {s: {from: tip, to: [2, 0, 0.001], stiffness: [)" +
                                                     stiffness + ", " + stiffness + ", " + stiffness + ", " +
                                                     stiffness + ", " + stiffness + ", " + stiffness +
                                                     R"(]}}
boundary: [base, tip]
modes: 4
)";
  return formats::read_part(folder.file("bar.part.yaml"), {});
}

TEST(UnlikelyNumbers, StiffSpringIsNamedWhereThePartIsLost) {
  EXPECT_THAT(test_support::error_of([] { reduce(bar("1e20", "0.3")); }),
              AllOf(HasSubstr("spring 's' has a stiffness of 1e+20"), HasSubstr("rigid spider")));
  EXPECT_THAT(reduce(bar("1e12", "0.3")).model.warnings, Not(Contains(HasSubstr("spring 's'"))));
}

TEST(UnlikelyNumbers, NegativePoissonsRatio) {
  EXPECT_THAT(reduce(bar("1e9", "-0.9")).model.warnings,
              Contains(HasSubstr("material 'steel': a Poisson's ratio of -0.9 is unusual")));
  EXPECT_THAT(reduce(bar("1e9", "0")).model.warnings, Not(Contains(HasSubstr("Poisson"))));
}

}  // namespace
}  // namespace tisserand::testing::stiff_spring_test
