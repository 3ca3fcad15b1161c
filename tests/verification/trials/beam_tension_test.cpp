// SPDX-License-Identifier: GPL-3.0-or-later
// Nonlinear beams under large axial forces against strings, cables, columns and blades: closed forms and orders.
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scenes/trial.hpp"

namespace tisserand::mechanism::beam_tension_test {
namespace {

using std::numbers::pi;
using test_support::Trial;

/// Order of convergence from errors of n and 2n elements.
double order(double coarse, double fine) { return std::log2(std::abs(coarse / fine)); }

/// Frequencies of the string of `elements` elements under T, without the effects of rotary inertia and elongation.
std::vector<double> frequencies(double T, int elements) {
  const Trial trial("fail1_tension",
                    {fmt::format("parameters.T={}", T), fmt::format("bodies.s.elements={}", elements),
                     "bodies.s.section.stiffness.EA=1e9", "bodies.s.section.rotary_inertia=[1e-7, 1e-7]"});
  EXPECT_EQ(trial.report().outcome, RunOutcome::completed);
  for (const std::string& note : trial.report().notes) ADD_FAILURE() << note;
  return trial.frequencies();
}

/// Frequency [Hz] of the n-th pair of modes: (n/2L) sqrt((T + EI (nπ/L)²)/m) with EI = 1 N m², m = 1 kg/m and L = 2 m.
double string_frequency(double T, int n) { return n / 4.0 * std::sqrt(T + std::pow(n * pi / 2.0, 2)); }

// Two elements per half wave: 1.1 % at T = 0 (docs of the element), less under tension. At 12 EI/h² = 12 N the element
// was unstable once.
TEST(BeamTension, AStringOfTwoElementsIsStableAtAnyTension) {
  for (const double T : {0.0, 11.0, 12.0, 13.0, 1e2, 1e3, 1e5}) {
    const std::vector<double> f = frequencies(T, 2);
    for (const int k : {0, 1}) EXPECT_NEAR(f[k] / string_frequency(T, 1), 1.0, 0.0115) << "T = " << T;
  }
}

// T h²/EI of 4 to 62 with four and eight elements: order 4.
TEST(BeamTension, FrequenciesOfAStringConvergeWithOrderFour) {
  for (const double T : {13.0, 1e3}) {
    const double exact = string_frequency(T, 1);
    const double e4 = frequencies(T, 4)[0] / exact - 1.0, e8 = frequencies(T, 8)[0] / exact - 1.0;
    EXPECT_LT(std::abs(e8), 1e-4) << T;
    EXPECT_GT(order(e4, e8), 3.5) << T << ' ' << e4 << ' ' << e8;
  }
}

// Frequencies of a column under P: f = (n/2L) sqrt((EI (nπ/L)² - P)/m), to zero at the Euler load π² EI/L² = 2.4674 N.
TEST(BeamTension, AColumnLosesItsFrequencyAtTheEulerLoad) {
  const double euler = pi * pi / 4.0;
  for (const double share : {0.5, 0.9}) {
    const double exact = 0.25 * std::sqrt(euler * (1.0 - share));
    const Trial trial("fail1_tension", {fmt::format("parameters.T={}", -share * euler), "bodies.s.elements=8"});
    EXPECT_NEAR(trial.frequencies()[0] / exact, 1.0, 2e-4 / (1.0 - share)) << share;
  }
}

struct Cable {
  double sag, pull, weight;
};

Cable cable(int elements, const std::vector<std::string>& more = {}) {
  std::vector<std::string> settings = {fmt::format("parameters.n={}", elements)};
  settings.insert(settings.end(), more.begin(), more.end());
  const Trial trial("catenary", settings);
  EXPECT_EQ(trial.report().outcome, RunOutcome::completed) << trial.report().reason;
  EXPECT_TRUE(trial.report().doubts.empty()) << trial.report().doubts.front();
  return {-trial.last(fmt::format("nodes/position/cable/{}/z", elements / 2)),
          std::abs(trial.last("joints/force/left/x")), std::abs(trial.last("joints/force/left/z"))};
}

// A cable of 10 m between pins 8 m apart, 1 kg/m: sag 2.65438 m and pull 33.178 N, half the weight 49.050 N at each pin
// (catenary, a = 3.38202 m); with EA = 1e6 N 2.65470 m and 33.173 N (elastic catenary, Irvine, Cable Structures, 1981,
// section 2.3). EI = 0.2 N m² takes 1.4e-4 of the sag and 1.2e-4 of the pull: so do 160 elements of three nodes.
TEST(BeamTension, CatenaryOfAnArcAtFirst) {
  const double sag = 2.65470, pull = 33.173;
  const Cable coarse = cable(20), fine = cable(80);
  EXPECT_NEAR(coarse.sag / sag, 1.0, 1e-3);
  EXPECT_NEAR(coarse.pull / pull, 1.0, 1e-3);
  EXPECT_NEAR(coarse.weight, 49.050, 1e-6);
  EXPECT_NEAR(coarse.sag / fine.sag, 1.0, 2e-5);
  EXPECT_NEAR(coarse.pull / fine.pull, 1.0, 2e-5);
  const Cable limp = cable(40, {"parameters.EI=0.002"});
  EXPECT_NEAR(limp.sag / sag, 1.0, 1e-4);
  EXPECT_NEAR(limp.pull / pull, 1.0, 1e-4);
}

}  // namespace
}  // namespace tisserand::mechanism::beam_tension_test
