// SPDX-License-Identifier: GPL-3.0-or-later
// Nonlinear beams of two nodes as heavy chains, turning blades, pushed columns and rolled-up strips: closed forms and
// series.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scenes/trial.hpp"

namespace tisserand::mechanism::chains_and_blades_test {
namespace {

using std::numbers::pi;
using test_support::Trial;
using ::testing::IsEmpty;

constexpr double gravity = 9.81, chain_length = 2.0;

/// Zeros of J₀ (Abramowitz & Stegun, table 9.5).
constexpr double bessel_zeros[] = {2.4048255577, 5.5200781103, 8.6537279129};

/// Bending of a beam of length 1 under an axial force p(x) = p₀ + p₁ x + p₂ x²: y'''' = (p y')' + μ y. Power series
/// from x = 0, where two of its first four coefficients vanish; at x = 1 two derivatives do. Frequencies are the zeros
/// of the determinant over ω, with μ = `inertia` ω².
struct BeamSeries {
  long double p[3];
  double inertia;
  int free[2];  ///< coefficients that do not vanish at x = 0
  int zero[2];  ///< derivatives that vanish at x = 1

  /// Derivative k at x = 1 of the solution with coefficient `one` equal to 1.
  long double at_end(long double mu, int one, int derivative) const {
    std::vector<long double> c(400, 0.0L);
    c[static_cast<std::size_t>(one)] = 1.0L;
    long double sum = 0.0L;
    for (int k = 0; k < static_cast<int>(c.size()); ++k) {
      if (k >= 4) {
        const int j = k - 4;  // c_k from the coefficient of x^j
        long double right = mu * c[j];
        for (int i = 0; i < 3 && j + 2 - i > 0; ++i) right += (j + 1) * p[i] * (j + 2 - i) * c[j + 2 - i];
        c[k] = right / (static_cast<long double>(k) * (k - 1) * (k - 2) * (k - 3));
      }
      long double factor = 1.0L;
      for (int d = 0; d < derivative; ++d) factor *= k - d;
      sum += factor * c[k];
    }
    return sum;
  }
  long double determinant(double omega) const {
    const auto speed = static_cast<long double>(omega);
    const long double mu = static_cast<long double>(inertia) * speed * speed;
    return at_end(mu, free[0], zero[0]) * at_end(mu, free[1], zero[1]) -
           at_end(mu, free[0], zero[1]) * at_end(mu, free[1], zero[0]);
  }
  /// The lowest frequencies, by changes of sign at steps of `step` and bisection.
  std::vector<double> frequencies(int count, double step) const {
    std::vector<double> found;
    for (double low = step; static_cast<int>(found.size()) < count; low += step) {
      double a = low, b = low + step;
      const bool sign = determinant(a) > 0.0L;
      if ((determinant(b) > 0.0L) == sign) continue;
      for (int i = 0; i < 50; ++i) ((determinant(0.5 * (a + b)) > 0.0L) == sign ? a : b) = 0.5 * (a + b);
      found.push_back(0.5 * (a + b));
    }
    return found;
  }
};

/// x from the free end, tension m g x: y'' = y''' = 0 there; y = y'' = 0 at the hook. ω in √(g/L).
BeamSeries chain_series(double EI) {
  const double stiffness = EI / (gravity * std::pow(chain_length, 3));
  return {{0.0L, 1.0L / static_cast<long double>(stiffness), 0.0L}, 1.0 / stiffness, {0, 1}, {0, 2}};
}

/// Flapping of a blade clamped to the axis, tension ½ m Ω² (L² − x²); ω and Ω in √(EI/(m L⁴)).
BeamSeries blade_series(double turn) {
  const long double p = 0.5L * static_cast<long double>(turn) * static_cast<long double>(turn);
  return {{p, 0.0L, -p}, 1.0, {2, 3}, {2, 3}};
}

/// Pairs of modes (two planes) of the chain, one of each [Hz].
std::vector<double> chain_frequencies(int elements, double EI) {
  const Trial trial("hanging_chain", {fmt::format("parameters.n={}", elements), fmt::format("parameters.EI={}", EI)});
  EXPECT_EQ(trial.report("rest").outcome, RunOutcome::completed);
  EXPECT_THAT(trial.report("tones").notes, IsEmpty());
  const std::vector<double> f = trial.frequencies("tones");
  return {f[0], f[2], f[4]};
}

// A heavy chain without bending stiffness: ω = (j/2) √(g/L) with the zeros j of J₀ (Daniel Bernoulli). EI = 1e-6 N m²
// adds 1e-5 to the third. m g h³/EI is 7.8e4 to 1200: the end of the chain hung in an unstable equilibrium from 130 on,
// as long as the weight of an element turned with its sections. Order 4.
TEST(HangingChain, SwingsAtBesselsZeros) {
  std::vector<double> error[3];
  for (const int n : {10, 20, 40}) {
    const std::vector<double> f = chain_frequencies(n, 1e-6);
    for (std::size_t k = 0; k < 3; ++k)
      error[k].push_back(std::abs(f[k] * 4.0 * pi / (bessel_zeros[k] * std::sqrt(gravity / chain_length)) - 1.0));
  }
  const double most[] = {2e-6, 1e-5, 1e-4};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(error[k][2], most[k]) << k;
  EXPECT_GT(error[2][0] / error[2][1], std::pow(2.0, 3.0)) << error[2][0] << ' ' << error[2][1];
  EXPECT_GT(error[2][1] / error[2][2], std::pow(2.0, 3.5)) << error[2][1] << ' ' << error[2][2];
}

// m g h³/EI = 123, just below that: the third frequency was 11 % too small. EI adds 8e-5.
TEST(HangingChain, NothingHappensBeforeTheEndTurnedOver) {
  const double f = bessel_zeros[2] * std::sqrt(gravity / chain_length) / (4.0 * pi);
  EXPECT_NEAR(chain_frequencies(40, 1e-5)[2] / f, 1.0, 2e-4);
}

// EI = 1e-3 m g L³, against the series. The weight stretches the chain by up to 1e-6, by which frequencies are less.
TEST(HangingChain, FrequenciesConvergeWithOrderFour) {
  constexpr double EI = 1e-3 * gravity * chain_length * chain_length * chain_length;
  const std::vector<double> exact = chain_series(EI).frequencies(3, 0.05);
  const std::vector<double> f20 = chain_frequencies(20, EI), f40 = chain_frequencies(40, EI),
                            f80 = chain_frequencies(80, EI);
  for (std::size_t k = 0; k < 3; ++k) {
    const double f = exact[k] * std::sqrt(gravity / chain_length) / (2.0 * pi);
    EXPECT_NEAR(f20[k] / f, 1.0, 1e-4) << k;
    EXPECT_NEAR(f80[k] / f, 1.0, 1e-6) << k;
  }
  EXPECT_NEAR(std::log2((f20[2] - f40[2]) / (f40[2] - f80[2])), 4.0, 0.3);
}

// The end of a straight chain that begins to turn with w: w L Σ 8/(j³ J₁(j)) sin(ω t)/ω, since the part of J₀(j √(x/L))
// in a straight line is 8/(j³ J₁(j)). Modes beyond the tenth have 2e-3 of the first.
TEST(HangingChain, SwingsAsTheSumOfItsModes) {
  const Trial trial("swinging_chain");
  EXPECT_EQ(trial.report("swing").outcome, RunOutcome::completed) << trial.report("swing").reason;
  EXPECT_EQ(trial.report("swing").rejected, 0);
  const std::vector<double> t = trial.time("swing"), x = trial.channel("nodes/position/chain/end/x", "swing");
  constexpr double turn = 0.01;
  double worst = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    double sum = 0.0;
    for (int k = 1; k <= 40; ++k) {
      double j = (k - 0.25) * pi;  // McMahon, then Newton
      for (int iteration = 0; iteration < 5; ++iteration) j += std::cyl_bessel_j(0, j) / std::cyl_bessel_j(1, j);
      const double omega = 0.5 * j * std::sqrt(gravity / chain_length);
      sum += 8.0 / (j * j * j * std::cyl_bessel_j(1, j)) * std::sin(omega * t[i]) / omega;
    }
    worst = std::max(worst, std::abs(std::abs(x[i]) - std::abs(turn * chain_length * sum)));
    largest = std::max(largest, std::abs(turn * chain_length * sum));
  }
  EXPECT_LT(worst, 5e-3 * largest) << worst / largest;
}

// Flapping frequencies of a uniform blade without hub by Wright, Smith, Thresher & Wang, J. Appl. Mech. 49, 1982, 197,
// table 1, and the same by series; in the plane of the turn ω² is less by Ω².
TEST(SpinningBlade, FrequenciesOfWright) {
  struct Row {
    double turn, flap[3];
  };
  for (const Row& row :
       {Row{2, {4.1373, 22.6149, 62.2732}}, Row{6, {7.3604, 26.8091, 66.6840}}, Row{12, {13.1702, 37.6031, 79.6145}}}) {
    const std::vector<double> exact = blade_series(row.turn).frequencies(3, 0.5);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(exact[k], row.flap[k], 1e-4) << row.turn;  // its last digit
    std::vector<double> both;
    for (const double f : exact) both.insert(both.end(), {f, std::sqrt(f * f - row.turn * row.turn)});
    std::sort(both.begin(), both.end());
    std::vector<double> error[2];
    for (const int n : {8, 16}) {
      const Trial trial("spinning_blade",
                        {fmt::format("parameters.W={}", row.turn), fmt::format("parameters.n={}", n)});
      EXPECT_EQ(trial.report("steady").outcome, RunOutcome::completed);
      EXPECT_THAT(trial.report("tones").notes, IsEmpty());
      const std::vector<double> f = trial.frequencies("tones");
      for (std::size_t k = 0; k < 6; ++k) error[n / 16].push_back(f[k] * 2.0 * pi / both[k] - 1.0);
    }
    const double most[] = {1e-3, 1e-3, 1e-3, 1e-3, 3e-3, 3e-3};
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_LT(std::abs(error[0][k]), most[k]) << row.turn << ' ' << k;
      EXPECT_LT(std::abs(error[1][k]), std::max(std::abs(error[0][k]) / 10.0, 1e-5))
          << row.turn << ' ' << k << ' ' << error[0][k] << ' ' << error[1][k];
    }
  }
}

/// Place of the end of a bar of length 1 that turns, k² = m Ω²/EA: EA x'' = −m Ω² x, x'(1) = 1: tan(k)/k.
double stretched(double turn, double EA) {
  const double k = turn / std::sqrt(EA);
  return std::tan(k) / k;
}

// Elongation of 0.5 % by centrifugal force, and its pull at the axle: EA (1/cos k − 1).
TEST(SpinningBlade, StretchesAsABar) {
  constexpr double turn = 12.0, EA = 1e4, k = turn / 100.0;
  const Trial trial("spinning_blade", {"parameters.EA=1e4"});
  EXPECT_NEAR((trial.last("nodes/position/blade/end/x", "steady") - 1.0) / (stretched(turn, EA) - 1.0), 1.0, 1e-4);
  EXPECT_NEAR(std::abs(trial.last("joints/force/mast/x", "steady")) / (EA * (1.0 / std::cos(k) - 1.0)), 1.0, 1e-4);
}

// From rest to 12 rad/s, 3.4 times the first frequency at rest: no step is repeated, and the blade ends stretched. It
// swings a little in the plane of the turn, as one of 24 elements does.
TEST(SpinningBlade, SpinsUpWithoutARepeatedStep) {
  double lag[2];
  for (const int n : {8, 24}) {
    const Trial trial("blade_spin_up", {fmt::format("parameters.n={}", n)});
    EXPECT_EQ(trial.report().outcome, RunOutcome::completed) << trial.report().reason;
    EXPECT_EQ(trial.report().rejected, 0);
    EXPECT_LT(trial.report().iterations, 3 * trial.report().steps);
    EXPECT_THAT(trial.report().doubts, IsEmpty());
    const double x = trial.last("nodes/position/blade/end/x"), y = trial.last("nodes/position/blade/end/y");
    EXPECT_NEAR((std::hypot(x, y) - 1.0) / (stretched(12.0, 1e4) - 1.0), 1.0, 1e-2);
    lag[n / 24] = std::remainder(std::atan2(y, x) - 84.0, 2.0 * pi);
    EXPECT_LT(std::abs(lag[n / 24]), 5e-3);
  }
  EXPECT_NEAR(lag[0], lag[1], 2e-4);
}

/// Stiffness across of a column of EI = L = 1 whose ends do not turn, under P = λ²: P λ/(2 tan(λ/2) − λ).
double stiffness_across(double P) {
  const double lambda = std::sqrt(P);
  return P * lambda / (2.0 * std::tan(0.5 * lambda) - lambda);
}

// A compression of 12 EI/h² per element is nothing special: the deflection across is F/(5 + S(P)), with S of the exact
// column, and for one element 12 − 6P/5, that of a cubic. It turns over where S(P) = −5, at P = 13.893.
TEST(PushedBeam, NothingHappensAtTwelve) {
  for (const double P : {1.0, 11.0, 11.99, 12.0, 12.01, 13.0}) {
    const auto deflection = [&](int n) {
      const Trial trial("pushed_beam", {fmt::format("parameters.P={}", P), fmt::format("parameters.n={}", n)});
      EXPECT_EQ(trial.report("rest").outcome, RunOutcome::completed) << P;
      EXPECT_THAT(trial.report("tones").notes, IsEmpty()) << P;
      EXPECT_GT(trial.frequencies("tones").front(), 0.0) << P;
      return trial.last("nodes/position/rod/end/z", "rest");
    };
    const double exact = 1e-3 / (5.0 + stiffness_across(P));
    EXPECT_NEAR(deflection(1) * (17.0 - 1.2 * P) / 1e-3, 1.0, 1e-3) << P;
    EXPECT_NEAR(deflection(8) / exact, 1.0, 1e-3) << P;
  }
  const auto outcome = [](double P) {
    return Trial("pushed_beam", {fmt::format("parameters.P={}", P), "parameters.n=8"}).report("rest").outcome;
  };
  EXPECT_EQ(outcome(13.86), RunOutcome::completed);
  EXPECT_EQ(outcome(13.92), RunOutcome::unstable);
}

// Rolled up to a circle by M = 2π EI/L in the ten load steps that were asked for, none halved; of eight elements, 45
// degrees each at the end, one is. Ten steps of 0.1 are ten, although their sum is less than 1.
TEST(RollUp, TakesItsTenLoadSteps) {
  for (const int n : {8, 16, 32}) {
    const Trial trial("roll_up", {fmt::format("parameters.n={}", n)});
    EXPECT_EQ(trial.report().outcome, RunOutcome::completed) << n;
    EXPECT_LE(trial.report().steps, n == 8 ? 11 : 10) << n;
    // A moment makes the stiffness unsymmetric: no loss of stability is claimed.
    EXPECT_THAT(trial.report().notes,
                ::testing::Each(::testing::HasSubstr("does not show whether the equilibrium is stable")));
    for (const char* axis : {"x", "y", "z"})
      EXPECT_NEAR(trial.last(std::string("nodes/position/rod/end/") + axis), 0.0, 1e-7) << n << axis;
  }
}

}  // namespace
}  // namespace tisserand::mechanism::chains_and_blades_test
