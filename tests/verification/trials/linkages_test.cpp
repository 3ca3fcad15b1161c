// SPDX-License-Identifier: GPL-3.0-or-later
// Random overconstrained linkages of one degree of freedom with every method and three steps each.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mechanism/bdf/bdf.hpp"
#include "mechanism/histories/series.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/scenes/linkages.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::linkages_test {
namespace {

using formats::Formulation;
using formats::Method;
using test_support::Linkage;
using test_support::LinkageFamily;

enum class Way { alpha, index3, hht, controlled, radau, radau_fixed, bdf };
constexpr std::array<Way, 7> all_ways = {Way::radau,      Way::alpha,       Way::index3, Way::hht,
                                         Way::controlled, Way::radau_fixed, Way::bdf};
constexpr int levels = 3;

std::string name_of(Way way) {
  constexpr std::array names = {"index 2", "index 3", "HHT", "error control", "Radau", "Radau, fixed steps", "BDF"};
  return names[static_cast<std::size_t>(way)];
}

bool has_fixed_steps(Way way) { return way == Way::alpha || way == Way::index3 || way == Way::hht; }

/// Level 0, 1, 2: the step halved, or the tolerance divided by ten.
formats::IntegratorSpec integrator(formats::IntegratorSpec spec, Way way, int level) {
  const double half = std::pow(0.5, level), tenth = std::pow(0.1, level);
  spec.step = 4e-3 * half;
  if (way == Way::index3) spec.formulation = Formulation::index3;
  if (way == Way::hht) spec.method = Method::hht;
  if (way == Way::controlled) spec.error_control = {true, 1e-3 * tenth};
  if (way == Way::radau) spec.error_control = {true, 1e-8 * tenth};
  if (way == Way::radau_fixed) spec.step = 2e-2 * half;
  if (way == Way::radau || way == Way::radau_fixed) spec.method = Method::radau;
  if (way != Way::bdf) return spec;
  spec.method = Method::bdf;
  spec.step = 0.0;
  spec.bdf.relative_tolerance = 1e-6 * tenth;
  spec.bdf.absolute_tolerance = 1e-8 * tenth;
  return spec;
}

/// Largest error of the energy that a method explains, of the energy that moved.
/// - Order 2: the motion goes on by pace times step [rad] in a step, and errs by the square of that.
/// - Controlled steps: the tolerance; with Radau the estimate of order 3, which is asked for 0.1 tolerance^(2/3).
/// - Radau with fixed steps: Newton's tolerance of 1e-8 in each step, far above (pace step)^5.
/// - BDF: the relative tolerance in each step.
double explained(Way way, int level, double pace, long steps) {
  const formats::IntegratorSpec spec = integrator({}, way, level);
  if (has_fixed_steps(way)) return std::pow(pace * spec.step, 2);
  if (way == Way::controlled) return spec.error_control.tolerance;
  if (way == Way::radau) return std::pow(spec.error_control.tolerance, 2.0 / 3.0);
  if (way == Way::radau_fixed) return spec.tolerance * static_cast<double>(steps) + std::pow(pace * spec.step, 5);
  return spec.bdf.relative_tolerance * static_cast<double>(steps);
}

struct Motion {
  RunReport report;
  std::vector<std::vector<double>> angles;  ///< changes since the start, of all joints over time
  double open = 0.0;                        ///< largest opening of the loop, by these angles
  double pace = 0.0;  ///< largest rate of a joint, or largest change of its rate over that: of turns, or of vibrations
};

Motion run(const Linkage& linkage, const formats::Scene& scene) {
  const test_support::TemporaryFolder folder;
  Motion motion;
  motion.report = simulate(scene, folder.file("a.results.h5"), {});
  SeriesRequest request{{motion.report.results}, {}, {}, {}};
  for (int i = 1; i <= linkage.size(); ++i) request.channels.push_back(fmt::format("joints/coordinate/j{}", i));
  for (const Series& one : read_series(request)) motion.angles.push_back(one.y);
  for (std::size_t row = 0; row < motion.angles.front().size(); ++row) {
    std::vector<double> angles = linkage.angles;
    for (std::size_t i = 0; i < angles.size(); ++i) angles[i] += motion.angles[i][row];
    motion.open = std::max(motion.open, test_support::opening(linkage.links, angles));
  }
  for (const std::vector<double>& angle : motion.angles) {
    double rate = 0.0, change = 0.0;
    for (std::size_t row = 1; row + 1 < angle.size(); ++row) {
      rate = std::max(rate, std::abs(angle[row] - angle[row - 1]) / *scene.output.interval);
      change = std::max(
          change, std::abs(angle[row + 1] - 2.0 * angle[row] + angle[row - 1]) / std::pow(*scene.output.interval, 2));
    }
    motion.pace = std::max({motion.pace, rate, rate > 0.0 ? change / rate : 0.0});
  }
  return motion;
}

/// Ends of the joint that moves most, by way and level.
using Ends = std::array<std::array<double, levels>, all_ways.size()>;

/// How far the ends may differ. What halving the step of methods of order 2 changes says how sensitive the motion is;
/// reference: Radau with the smallest tolerance. Extrapolated to no step (errors h² and h³), index 2 agrees with it.
void compare(const Ends& ends, const std::string& what) {
  const auto of = [&](Way way) { return ends[static_cast<std::size_t>(way)]; };
  const double reference = of(Way::radau)[2], noise = 1e-6 + 2.0 * std::abs(of(Way::radau)[1] - reference);
  double sensitivity = 1e-5;
  for (const Way way : {Way::alpha, Way::index3, Way::hht})
    sensitivity = std::max(sensitivity, std::abs(of(way)[1] - of(way)[0]));
  for (const Way way : all_ways) {
    const std::array<double, levels> end = of(way);
    for (int level = 0; level < levels; ++level) {
      const double error = std::abs(end[level] - reference), tenth = std::pow(0.1, level);
      double most = sensitivity;  // of Radau
      if (has_fixed_steps(way)) most *= 3.0 * std::pow(0.25, level);
      if (way == Way::controlled) most *= 300.0 * tenth;
      if (way == Way::bdf) most *= 10.0 * tenth;
      EXPECT_LT(error, most) << what << name_of(way) << level;
    }
    if (way == Way::alpha || way == Way::hht) {
      const double extrapolated = (32.0 * end[2] - 12.0 * end[1] + end[0]) / 21.0;
      EXPECT_NEAR(extrapolated, reference, noise + 0.1 * std::abs(end[1] - end[2])) << what << name_of(way);
    }
  }
}

/// Runs of random linkages: none fails or is doubted, all keep closed and keep their energy, and all ways agree.
void run_all(LinkageFamily family, unsigned seed, int count) {
  std::mt19937 random(seed);
  for (int k = 0; k < count; ++k) {
    const Linkage linkage = test_support::random_linkage(family, random);
    const formats::Scene moving = test_support::moving_linkage(linkage, random);
    const std::size_t joint = std::stoul(moving.initial.front().coordinate.name.substr(1)) - 1;
    Ends ends{};
    double pace = 0.0, size = 0.0;
    for (const test_support::LinkageLink& link : linkage.links) size += link.length + std::abs(link.offset);
    for (const Way way : all_ways) {
      if (way == Way::bdf && !bdf_available()) continue;
      for (int level = levels - 1; level >= 0; --level) {
        const std::string what =
            fmt::format("{} {}, {}, level {}", test_support::name_of(family), k, name_of(way), level);
        formats::Scene scene = moving;
        scene.integrator = integrator(scene.integrator, way, level);
        const Motion motion = run(linkage, scene);
        if (pace == 0.0) pace = motion.pace;
        EXPECT_EQ(motion.report.outcome, RunOutcome::completed) << what << ": " << motion.report.reason;
        // Index 3 does not damp its multipliers, and a doubt says so.
        for (const std::string& doubt : motion.report.doubts)
          EXPECT_TRUE(way == Way::index3 && doubt.find("the Lagrange multipliers oscillate") == 0)
              << what << ": " << doubt;
        // Each joint is open by the constraint tolerance of 1e-10 of the size at most.
        EXPECT_LT(motion.open, linkage.size() * 1e-10 * std::max(1.0, size)) << what;
        EXPECT_LT(motion.report.largest_balance,
                  explained(way, level, pace, motion.report.steps) * motion.report.energy_reference)
            << what;
        ends[static_cast<std::size_t>(way)][level] = motion.angles[joint].back();
      }
    }
    if (!bdf_available()) ends[static_cast<std::size_t>(Way::bdf)].fill(ends[static_cast<std::size_t>(Way::radau)][2]);
    compare(ends, fmt::format("{} {}: ", test_support::name_of(family), k));
  }
}

struct Family {
  const char* name;
  LinkageFamily family;
  int few, many;
};

class RandomLinkages : public ::testing::TestWithParam<Family> {};

TEST_P(RandomLinkages, FewWithEveryMethod) { run_all(GetParam().family, 1, GetParam().few); }
TEST_P(RandomLinkages, ManyWithEveryMethod) { run_all(GetParam().family, 2, GetParam().many); }

INSTANTIATE_TEST_SUITE_P(Families, RandomLinkages,
                         ::testing::Values(Family{"Bennett", LinkageFamily::bennett, 5, 100},
                                           Family{"Goldberg", LinkageFamily::goldberg, 1, 10},
                                           Family{"Myard", LinkageFamily::myard, 1, 10},
                                           Family{"BricardOfALine", LinkageFamily::bricard_line, 1, 10},
                                           Family{"BricardOfAPlane", LinkageFamily::bricard_plane, 1, 10},
                                           Family{"BricardTrihedral", LinkageFamily::bricard_trihedral, 1, 10}),
                         [](const auto& one) { return std::string(one.param.name); });

// The families move: their Jacobian has one rank less than joints along the whole path, which random_linkage()
// examines.
TEST(LinkageGeometry, ClosesAndMoves) {
  std::mt19937 random(3);
  for (const LinkageFamily family :
       {LinkageFamily::bennett, LinkageFamily::goldberg, LinkageFamily::myard, LinkageFamily::bricard_line,
        LinkageFamily::bricard_plane, LinkageFamily::bricard_trihedral}) {
    const Linkage linkage = test_support::random_linkage(family, random);
    EXPECT_LT(test_support::opening(linkage.links, linkage.angles), 1e-11) << test_support::name_of(family);
    EXPECT_GE(linkage.least_singular, 0.02);
    EXPECT_GT(linkage.path, 1.0);
    std::vector<double> moved = linkage.angles;
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += 1e-4 * linkage.tangent[i];
    EXPECT_LT(test_support::opening(linkage.links, moved), 1e-6) << test_support::name_of(family);
  }
}

}  // namespace
}  // namespace tisserand::mechanism::linkages_test
