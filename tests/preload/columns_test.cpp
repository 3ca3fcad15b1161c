// SPDX-License-Identifier: GPL-3.0-or-later
// Columns of one reduced body in a mechanism: frequencies under load against the characteristic equation of the beam,
// loads at which they vanish, beam-columns.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "tests/preload/preloaded_scenes.hpp"
#include "tests/reducer/second_order/reduced_buckling.hpp"

namespace tisserand::preload::columns_test {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;
using formats::LoadKind;
using reducer::ColumnEnds;
using std::numbers::pi;
using test_support::Simulation;

constexpr double length = 10.0, EI = 100.0;  // of the softer plane; mass 1 per length
constexpr ColumnEnds all_ends[] = {ColumnEnds::pinned, ColumnEnds::clamped_free, ColumnEnds::clamped_pinned,
                                   ColumnEnds::clamped};

/// w and its derivatives of the functions cosh ax, sinh(ax)/a, cos bx, sin(bx)/b at x; rows: order 0 to 3.
Matrix4d shapes(double a, double b, double x) {
  const double C = std::cosh(a * x), S = a > 0.0 ? std::sinh(a * x) / a : x, c = std::cos(b * x),
               s = std::sin(b * x) / b;
  Matrix4d f;
  f << C, S, c, s,                                   //
      a * a * S, C, -b * b * s, c,                   //
      a * a * C, a * a * S, -b * b * c, -b * b * s,  //
      a * a * a * a * S, a * a * C, b * b * b * b * s, -b * b * c;
  return f;
}

/// Determinant of EI w'''' + P w'' − ω² w = 0 with its four conditions: zero at frequencies. A free end has no moment,
/// and with a load of fixed direction EI w''' + P w' = 0.
double characteristic(ColumnEnds ends, double P, double omega) {
  const double p = 0.5 * P / EI, root = std::sqrt(p * p + omega * omega / EI);
  const double a = std::sqrt(std::max(root - p, 0.0)), b = std::sqrt(root + p);
  const Matrix4d base = shapes(a, b, 0.0), tip = shapes(a, b, length);
  Matrix4d D;
  D.row(0) = base.row(0);
  D.row(1) = base.row(ends == ColumnEnds::pinned ? 2 : 1);
  if (ends == ColumnEnds::clamped_free) {
    D.row(2) = tip.row(2);
    D.row(3) = tip.row(3) + 2.0 * p * tip.row(1);
  } else {
    D.row(2) = tip.row(0);
    D.row(3) = tip.row(ends == ColumnEnds::clamped ? 1 : 2);
  }
  return D.determinant();
}

/// The lowest frequency [rad/time] of the column under the compression P, by bisection.
double exact_frequency(ColumnEnds ends, double P) {
  constexpr double step = 1e-3;
  double low = 0.5 * step, high = low + step;
  while (characteristic(ends, P, low) * characteristic(ends, P, high) > 0.0) low = high, high += step;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (characteristic(ends, P, low) * characteristic(ends, P, middle) > 0.0 ? low : high) = middle;
  }
  return low;
}

testing::ReducedPart column(int modes) {
  return testing::reduce_with_companion(reducer::slender_beam({.density = 1e-8, .torsional = 0.01}, 40), modes);
}

std::array<bool, 6> held(ColumnEnds ends, int node) {
  std::array<bool, 6> hold{};
  for (const int row : reducer::held_rows(ends))
    if (row / 6 == node) hold[static_cast<std::size_t>(row % 6)] = true;
  return hold;
}

formats::Scene column_scene(ColumnEnds ends, double compression) {
  formats::Scene scene = static_scene(true);
  scene.joints = {support("base", Vector3d::Zero(), held(ends, 0))};
  if (ends != ColumnEnds::clamped_free) scene.joints.push_back(support("tip", {length, 0, 0}, held(ends, 1)));
  scene.loads.push_back(test_support::constant_load("axial", LoadKind::force, "part/tip", {-compression, 0, 0}));
  return scene;
}

/// ω² of the softest mode; below zero where it grows.
double squared_frequency(const mechanism::BodyFiles& files, ColumnEnds ends, double compression) {
  Simulation run(column_scene(ends, compression), files);
  solve(run);
  const auto modes = mechanism::solve_modes(run.model(), run.state(), {}, run.workspace.now).modes;
  return std::norm(modes.at(0).eigenvalue) * (modes.at(0).eigenvalue.real() > 1e-6 ? -1.0 : 1.0);
}

double critical(ColumnEnds ends) { return reducer::euler_factor(ends) * pi * pi * EI / (length * length); }

// The equation itself: frequencies without load (β L = π, 1.8751, 3.9266, 4.7300), and none left at Euler's load.
TEST(PreloadedColumns, CharacteristicEquationHasTheTextbookLimits) {
  const double beta[] = {pi, 1.8751041, 3.9266023, 4.7300407};
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(exact_frequency(all_ends[k], 0.0), std::pow(beta[k] / length, 2) * std::sqrt(EI), 1e-6) << k;
    EXPECT_LT(exact_frequency(all_ends[k], 0.9999 * critical(all_ends[k])), 0.015 * exact_frequency(all_ends[k], 0.0))
        << k;
  }
}

TEST(PreloadedColumns, FrequenciesUnderLoad) {
  const mechanism::BodyFiles files = files_of(column(12));
  for (const ColumnEnds ends : all_ends) {
    const double free = std::pow(exact_frequency(ends, 0.0), 2);
    for (const double part : {-2.0, -0.5, 0.0, 0.5, 0.9}) {
      const double P = part * critical(ends), exact = std::pow(exact_frequency(ends, P), 2);
      const double found = squared_frequency(files, ends, P);
      EXPECT_NEAR(found, exact, 1e-3 * std::max(free, exact)) << static_cast<int>(ends) << " " << part;
    }
  }
}

// The load at which the frequency of the mechanism vanishes is that of the eigenproblem of the companion's arrays.
TEST(PreloadedColumns, FrequenciesVanishAtTheBucklingLoad) {
  for (const int modes : {4, 8}) {
    const mechanism::BodyFiles files = files_of(column(modes));
    for (const ColumnEnds ends : all_ends) {
      const double expected = reducer::reduced_column(ends, modes), P = critical(ends) * expected;
      const double a = squared_frequency(files, ends, 0.98 * P), b = squared_frequency(files, ends, 0.995 * P);
      EXPECT_NEAR(0.98 + 0.015 * a / (a - b), 1.0, 3e-4) << modes << static_cast<int>(ends);
    }
  }
}

/// Force at which the strip of `EI_z` on edge turns over in statics, over that of the companion's eigenproblem, less 1.
double strip_excess(double EI_z) {
  const testing::ReducedPart part = testing::reduce_with_companion(reducer::slender_strip(EI_z), 8);
  const mechanism::BodyFiles files = files_of(part);
  const double P = 4.0126 * std::sqrt(EI * 80.0) / (length * length) * reducer::reduced_strip(8, EI_z);
  const auto stiffness = [&](double share) {
    formats::Scene scene = column_scene(ColumnEnds::clamped_free, 0.0);
    scene.loads.push_back(test_support::constant_load("edge", LoadKind::force, "part/tip", {0, share * P, 0}));
    scene.statics.load_steps = 4;
    Simulation run(scene, files);
    solve(run);
    return std::norm(mechanism::solve_modes(run.model(), run.state(), {}, run.workspace.now).modes.at(0).eigenvalue);
  };
  // ω² falls with the square of the force.
  const double a = stiffness(0.99), b = stiffness(0.999), x = 0.99 * 0.99, y = 0.999 * 0.999;
  return std::sqrt(x + (y - x) * a / (a - b)) - 1.0;
}

// Statics knows that the strip bends on edge before it turns over, which the eigenproblem at the straight strip leaves
// out: an excess of the order of EI_y/EI_z = 1e-3, and a tenth of it where the strip is ten times as stiff on edge.
TEST(PreloadedColumns, StripTurnsOverAtTheLoadOfTheCompanion) {
  const double soft = strip_excess(1e5), stiff = strip_excess(1e6);
  EXPECT_GT(soft, 0.0);
  EXPECT_LT(soft, 2.5e-3);
  EXPECT_NEAR(stiff / soft, 0.1, 0.05);
}

/// Deflection of the tip of a cantilever under an axial and a small lateral force there, over the exact one:
/// w = (Q L/P) (tan kL/kL − 1), k² = P/EI, tanh in tension (Timoshenko and Gere 1961, 1.11).
double beam_column(const mechanism::BodyFiles& files, double part) {
  const double Q = 1e-5, P = part * critical(ColumnEnds::clamped_free), kL = length * std::sqrt(std::abs(P) / EI);
  formats::Scene scene = column_scene(ColumnEnds::clamped_free, P);
  scene.loads.push_back(test_support::constant_load("lateral", LoadKind::force, "part/tip", {0, 0, Q}));
  Simulation run(scene, files);
  solve(run);
  const double exact = Q * length / P * ((P > 0.0 ? std::tan(kL) : std::tanh(kL)) / kL - 1.0);
  return run.position("part/tip").z() / exact;
}

// An independent program of this theory: 0.9965, 0.99997 with m = 0, 4 at half of the buckling load, 0.986 and 0.9998
// in tension of four times that.
TEST(PreloadedColumns, BeamColumn) {
  for (const auto& [modes, pressed, pulled] : {std::tuple{0, 0.9965, 0.986}, {4, 0.99997, 0.9998}}) {
    const mechanism::BodyFiles files = files_of(column(modes));
    EXPECT_NEAR(beam_column(files, 0.5), pressed, 1e-4) << modes;
    EXPECT_NEAR(beam_column(files, -4.0), pulled, 5e-4) << modes;
  }
}

}  // namespace
}  // namespace tisserand::preload::columns_test
