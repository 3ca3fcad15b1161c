// SPDX-License-Identifier: GPL-3.0-or-later
// The Magic Formula against a second implementation, written from the published equations by someone who had not read
// this one (tests/verification/references/magic_formula), and at its limits.
#include "mechanism/tyres/magic_formula.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "formats/tyres/tyre_property_file.hpp"
#include "mechanism/tyres/tyre.hpp"
#include "tests/support/reference_table.hpp"

namespace tisserand::mechanism::magic_formula_test {
namespace {

using formats::MagicFormulaVersion;

const std::string folder = std::string(TISSERAND_SOURCE_DIR) + "/tests/verification/references/magic_formula/";

MagicFormulaLaw law_of(const std::string& file) {
  return {formats::read_tyre_property_file(folder + file, Units::si()).coefficients};
}

/// The file's own ranges are not those of the rows.
MagicFormulaLaw without_ranges(MagicFormulaLaw law) {
  formats::MagicFormula& p = law.p;
  p.KPUMIN = p.KPUMAX = p.ALPMIN = p.ALPMAX = p.CAMMIN = p.CAMMAX = p.FZMIN = p.FZMAX = 0.0;
  return law;
}

PatchSlip<double> slipping(double load, double kappa, double alpha, double gamma, double speed = 16.7) {
  PatchSlip<double> slip{-kappa, std::tan(alpha), std::sin(gamma), load, 0.1, 0.3, 1.0};
  slip.speed = speed;
  return slip;
}

/// F_x, F_y, M_x, M_y, M_z.
std::array<double, 5> outputs(const PatchForce<double>& force) {
  return {force.x, force.y, force.overturning, force.resistance, force.moment};
}

// Columns of the rows: load, κ, α, γ, (6.1: pressure), V_x, five results; 6.1 has those of the book before those of
// MF-Tyre, which are meant. The reference adds 1e-6 to denominators: 1e-7 of the largest result.
void compare(const std::string& name) {
  const MagicFormulaLaw file = without_ranges(law_of(name + ".tir"));
  const auto rows = test_support::reference_rows("magic_formula/reference_" + name + ".csv");
  ASSERT_GE(rows.size(), 100u);
  const bool pressures = file.is_6_1();
  const std::size_t first = pressures ? 11 : 5;
  std::array<double, 5> largest{};
  for (const std::vector<double>& row : rows)
    for (std::size_t k = 0; k < 5; ++k) largest[k] = std::max(largest[k], std::abs(row.at(first + k)));
  for (const std::vector<double>& row : rows) {
    MagicFormulaLaw law = file;
    if (pressures) law.pressure = row[4] / law.p.NOMPRES - 1.0;
    const auto force = outputs(patch_force(law, slipping(row[0], row[1], row[2], row[3], row.at(pressures ? 5 : 4))));
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_NEAR(force[k], row[first + k], 2e-7 * largest[k])
          << name << ", result " << k << " at load " << row[0] << ", slip " << row[1] << ", angle " << row[2]
          << ", camber " << row[3];
  }
}

// The parameters of the 205/60R15 of the book (table A3.1), and all of its coefficients and scaling factors effective.
TEST(MagicFormula, Is61OfASecondImplementation) {
  compare("book_205_60R15");
  compare("synthetic_mf61_all");
}

TEST(MagicFormula, Is52OfASecondImplementation) {
  compare("hmmwv_pac2002");
  compare("synthetic_pac2002_all");
}

class Files : public ::testing::TestWithParam<const char*> {
 protected:
  MagicFormulaLaw law_ = law_of(std::string(GetParam()) + ".tir");
};

// Slopes of the forces: K_xκ, K_yα and D C B are below 60 times the load; trail and arm below 1 m, rolling resistance
// alike. Shifts and ranges may bend, not jump: windows of 2e-6 about zero, the shifts' zeros and the ends of the ranges
// would show a jump of 1e-4 of the load.
TEST_P(Files, HasNoJumpAnywhere) {
  const double load = law_.p.FNOMIN;
  const auto look_between = [&](auto at, double from, double to, int steps) {
    const double width = (to - from) / steps;
    std::array<double, 5> last{};
    for (int i = 0; i <= steps; ++i) {
      const auto force = outputs(at(from + i * width));
      for (std::size_t k = 0; k < 5; ++k) {
        ASSERT_TRUE(std::isfinite(force[k]));
        ASSERT_TRUE(i == 0 || std::abs(force[k] - last[k]) < 60.0 * load * width) << k << " at " << from + i * width;
      }
      last = force;
    }
  };
  const formats::MagicFormula& p = law_.p;
  const std::array places{0.0,      -p.PHX1,  -p.PHY1,  -p.QHZ1,        p.KPUMIN,       p.KPUMAX,
                          p.ALPMIN, p.ALPMAX, p.CAMMIN, p.FZMIN / load, p.FZMAX / load, p.CAMMAX};
  const auto look_at = [&](auto at, double from, double to) {
    look_between(at, from, to, 3000);
    look_between(at, std::max(from, -0.1), 0.1, 2000);
    for (const double place : places)
      if (place > from) look_between(at, place - 1e-6, place + 1e-6, 20);
  };
  for (const double other : {0.0, 0.05, -0.3})
    for (const double camber : {0.0, 0.08, -0.3}) {
      look_at([&](double s) { return patch_force(law_, slipping(load, s, other, camber)); }, -2.0, 2.0);
      look_at([&](double s) { return patch_force(law_, slipping(load, other, s, camber)); }, -1.5, 1.5);
      look_at([&](double s) { return patch_force(law_, slipping(load, other, 0.1, s)); }, -0.5, 0.5);
      look_at([&](double s) { return patch_force(law_, slipping(load * s, other, 0.1, camber)); }, 0.0, 4.0);
      look_at(
          [&](double s) {
            PatchSlip<double> slip = slipping(load, other, 0.1, camber);
            slip.rolling = s;
            return patch_force(law_, slip);
          },
          -1.0, 1.0);
    }
}

TEST_P(Files, VanishesWithTheLoadAndKeepsItsRatioBeyondTheRange) {
  for (const double force : outputs(patch_force(law_, slipping(0.0, 0.1, 0.1, 0.05)))) EXPECT_EQ(force, 0.0);
  MagicFormulaLaw law = law_;
  law.p.FZMIN = 0.5 * law.p.FNOMIN;
  law.p.FZMAX = 1.5 * law.p.FNOMIN;
  for (const auto& [inside, beyond] : {std::pair{0.5, 0.1}, std::pair{1.5, 3.0}}) {
    const auto a = outputs(patch_force(law, slipping(inside * law.p.FNOMIN, 0.02, 0.05, 0.03)));
    const auto b = outputs(patch_force(law, slipping(beyond * law.p.FNOMIN, 0.02, 0.05, 0.03)));
    for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(b[k], a[k] * beyond / inside, 1e-12 * std::abs(b[k]) + 1e-12);
  }
}

// At standstill nothing pushes but what slips: conicity, ply steer and camber thrust come with rolling.
TEST_P(Files, RestsWithoutForce) {
  PatchSlip<double> slip = slipping(law_.p.FNOMIN, 0.0, 0.0, 0.0, 0.0);
  slip.rolling = 0.0;
  const PatchForce<double> force = patch_force(law_, slip);
  EXPECT_EQ(force.x, 0.0);
  EXPECT_EQ(force.y, 0.0);
  EXPECT_EQ(force.resistance, 0.0);
}

// On the other side of the vehicle: the mirror image of what the file says.
TEST_P(Files, MirrorsForTheOtherSide) {
  MagicFormulaLaw other = law_;
  other.mirrored = true;
  const auto a = outputs(patch_force(law_, slipping(law_.p.FNOMIN, 0.03, 0.04, 0.02)));
  const auto b = outputs(patch_force(other, slipping(law_.p.FNOMIN, 0.03, -0.04, -0.02)));
  const std::array sign{1.0, -1.0, -1.0, 1.0, -1.0};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(b[k], sign[k] * a[k], 1e-12 * std::abs(a[k]));
  EXPECT_NE(patch_force(other, slipping(law_.p.FNOMIN, 0.0, 0.04, 0.02)).y,
            patch_force(law_, slipping(law_.p.FNOMIN, 0.0, 0.04, 0.02)).y);
}

// A wet road halves both coefficients of friction, D of (4.E12) and (4.E22), and with them the peaks over all slips: D
// sin(..) and the vertical shift halve, and stiffness, hence the place of the peak, is as before. Sampled: a peak is
// missed by less than 1e-4.
TEST_P(Files, FrictionOfTheRoadLimitsTheForce) {
  const auto peaks = [&](double friction) {
    std::array<double, 2> most{};
    for (int i = 0; i <= 4000; ++i) {
      const double s = 1.4 * i / 4000;
      PatchSlip<double> along = slipping(law_.p.FNOMIN, -s, 0.0, 0.0), across = slipping(law_.p.FNOMIN, 0.0, s, 0.0);
      along.friction = across.friction = friction;
      most[0] = std::max(most[0], -patch_force(law_, along).x);
      most[1] = std::max(most[1], -patch_force(law_, across).y);
    }
    return most;
  };
  const auto dry = peaks(1.0), wet = peaks(0.5);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(wet[k] / dry[k], 0.5, 1e-4) << k;
}

// A file for one direction gives the other no force, and no number that is none, also in derivatives.
TEST(MagicFormula, OneDirectionAlone) {
  MagicFormulaLaw law;
  formats::MagicFormula& p = law.p;
  p.forces = formats::MagicFormulaForces::longitudinal;
  p.UNLOADED_RADIUS = 0.3;
  p.FNOMIN = 4000;
  p.VERTICAL_STIFFNESS = 2e5;
  p.PCX1 = 1.6;
  p.PDX1 = 1.0;
  p.PKX1 = 20;
  p.LONGITUDINAL_STIFFNESS = p.LATERAL_STIFFNESS = 2e5;
  PatchSlip<Dual> slip{Dual(-0.03, 1.0), Dual(0.05, 1.0), Dual(0.01, 1.0), Dual(3000.0, 1.0),
                       Dual(0.1),        Dual(0.3),       Dual(1.0)};
  slip.speed = Dual(10.0);
  const PatchForce<Dual> force = patch_force(law, slip);
  EXPECT_GT(force.x.value, 0.0);
  EXPECT_TRUE(std::isfinite(force.x.derivative));
  EXPECT_EQ(force.y.value, 0.0);
  EXPECT_EQ(force.moment.value, 0.0);
  EXPECT_TRUE(std::isfinite(force.adhesion));
  const RelaxationLengths<Dual> sigma = relaxation_lengths(law, slip);
  EXPECT_EQ(sigma.across.value, 0.0);
  EXPECT_EQ(sigma.across.derivative, 0.0);
}

// Dual numbers through every formula, against central differences.
TEST_P(Files, DerivativesAreThoseOfTheFormulas) {
  constexpr double h = 1e-6;
  const double load = 0.9 * law_.p.FNOMIN;
  for (int j = 0; j < 4; ++j) {
    const auto at = [&](double step) {
      return outputs(patch_force(law_, slipping(load * (1 + (j == 3) * step), 0.03 + (j == 0) * step,
                                                -0.05 + (j == 1) * step, 0.02 + (j == 2) * step)));
    };
    const auto d = [&](double value, double derivative, int k) { return Dual(value, k == j ? derivative : 0.0); };
    const double cosine = std::cos(-0.05);
    PatchSlip<Dual> slip{d(-0.03, -1.0, 0),
                         d(std::tan(-0.05), 1.0 / (cosine * cosine), 1),
                         d(std::sin(0.02), std::cos(0.02), 2),
                         d(load, load, 3),
                         Dual(0.1),
                         Dual(0.3),
                         Dual(1.0)};
    slip.speed = Dual(16.7);
    const PatchForce<Dual> force = patch_force(law_, slip);
    const std::array dual{force.x, force.y, force.overturning, force.resistance, force.moment};
    const auto up = at(h), down = at(-h);
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_NEAR(dual[k].derivative, (up[k] - down[k]) / (2 * h), 1e-6 * load) << j << " " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Files,
                         ::testing::Values("book_205_60R15", "synthetic_mf61_all", "hmmwv_pac2002",
                                           "synthetic_pac2002_all"));

// 6.1: σ = K/C with the stiffnesses of the carcass; 5.2: the formulas of PTX and PTY, here at the nominal load, where
// dfz = 0 with LFZO = 1.
TEST(MagicFormula, RelaxationLengthsAreThoseOfTheFile) {
  MagicFormulaLaw law = without_ranges(law_of("book_205_60R15.tir"));
  const PatchSlip<double> slip = slipping(law.p.FNOMIN, 0.0, 0.0, 0.0);
  constexpr double h = 1e-6;
  const double K_x =
      (patch_force(law, slipping(law.p.FNOMIN, h, 0, 0)).x - patch_force(law, slipping(law.p.FNOMIN, -h, 0, 0)).x) /
      (2 * h);
  const RelaxationLengths<double> carcass = relaxation_lengths(law, slip);
  EXPECT_NEAR(carcass.along, K_x / law.p.LONGITUDINAL_STIFFNESS, 2e-3 * carcass.along);  // shifts: not at the zero
  EXPECT_GT(carcass.across, 0.1);
  EXPECT_LT(carcass.across, 1.0);
  MagicFormulaLaw old = without_ranges(law_of("hmmwv_pac2002.tir"));
  old.p.LFZO = 1.0;
  old.p.PTX1 = 2.0;
  old.p.PTX2 = old.p.PTX3 = 0.0;
  old.p.PTY1 = 1.5;
  old.p.PTY2 = 1.0;
  const RelaxationLengths<double> by_file = relaxation_lengths(old, slipping(old.p.FNOMIN, 0.0, 0.0, 0.0));
  EXPECT_NEAR(by_file.along, 2.0 * old.p.UNLOADED_RADIUS * old.p.LSGKP, 1e-12);
  EXPECT_NEAR(by_file.across, 1.5 * std::sin(2.0 * std::atan(1.0)) * old.p.UNLOADED_RADIUS * old.p.LSGAL, 1e-12);
}

// Comprehensive slip has no shifts, the synthetic file has all of them (ply steer, conicity).
TEST(MagicFormula, PullsSidewaysByItsShifts) {
  Tyre tyre;
  tyre.radius = 0.31;
  tyre.stiffness = 190e3;
  tyre.low_speed = 0.1;
  for (const double relaxation : {0.0, 0.4}) {
    tyre.relaxation = relaxation;
    tyre.lag = relaxation > 0.0 ? 0 : -1;
    tyre.law = ComprehensiveSlip{80e3, 60e3, 3e3, 1.0, 0.75};
    EXPECT_EQ(sideways_share(tyre), 0.0);
    tyre.law = law_of("synthetic_pac2002_all.tir");
    EXPECT_GT(sideways_share(tyre), 1e-3);
  }
}

}  // namespace
}  // namespace tisserand::mechanism::magic_formula_test
