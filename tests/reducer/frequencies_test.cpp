// SPDX-License-Identifier: GPL-3.0-or-later
// Frequencies of meshed beams against analytic ones, and their order of convergence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/reducer/parts.hpp"

namespace tisserand::testing::frequencies_test {
namespace {

using Eigen::Vector3d;
using formats::BeamTheory;
using formats::MassMatrix;

/// Coordinates (deflection, slope) of one bending plane of all nodes, without the held ones.
std::vector<int> plane(const FullModel& full, int deflection, int slope, const std::vector<int>& held) {
  std::vector<int> keep;
  for (int a = 0; a < full.mesh.nodes(); ++a)
    for (const int c : {deflection, slope})
      if (std::find(held.begin(), held.end(), 6 * a + c) == held.end()) keep.push_back(6 * a + c);
  return keep;
}

constexpr double E = 2.1e11, rho = 7850.0, A = 2e-3, Iz = 8e-7, Iy = 3e-7, L = 1.7;

formats::Part beam_along_x(int elements) { return plain_beam(Vector3d::Zero(), Vector3d(L, 0, 0), elements, 0); }

/// cos βL cosh βL = −1.
constexpr double cantilever_roots[3] = {1.875104068711961, 4.694091132974175, 7.854757438237613};

double cantilever_omega(int k, double I) { return std::pow(cantilever_roots[k] / L, 2) * std::sqrt(E * I / (rho * A)); }

TEST(Frequencies, EulerBernoulliCantilever) {
  formats::Part part = beam_along_x(16);
  set_theory(part, BeamTheory::euler_bernoulli);
  set_mass(part, MassMatrix::consistent, false);
  const FullModel full = full_model(part);
  const Eigen::VectorXd xy = angular_frequencies(full.S, full.M, plane(full, 1, 5, {1, 5}));
  const Eigen::VectorXd xz = angular_frequencies(full.S, full.M, plane(full, 2, 4, {2, 4}));
  for (int k = 0; k < 3; ++k) {
    // Error of the Hermite element: (βh)⁴/1440 relative in ω, 4e-5 for the third root; from above.
    const double bound = std::pow(cantilever_roots[k] / 16, 4) / 1440.0;
    EXPECT_GT(xy[k] / cantilever_omega(k, Iz) - 1.0, 0.0);
    EXPECT_LT(xy[k] / cantilever_omega(k, Iz) - 1.0, 1.5 * bound + 1e-9);
    EXPECT_NEAR(xz[k] / xy[k], std::sqrt(Iy / Iz), 1e-9);
  }
}

/// Pinned at both ends, mode n, k = nπ/L: ω⁴ ρI ρA/(GA_s) − ω² (ρA + k² (ρI + ρA EI/(GA_s))) + EI k⁴ = 0. The error is
/// of order 2 where shear counts: its fourth-order remainder is what extrapolation leaves, (kh)⁴ × shear share 0.07 <
/// 1e-6.
TEST(Frequencies, PinnedTimoshenkoBeam) {
  Eigen::VectorXd omega[2];
  for (int i = 0; i < 2; ++i) {
    const FullModel full = full_model(beam_along_x(64 << i));
    omega[i] = angular_frequencies(full.S, full.M, plane(full, 1, 5, {1, 7}));
  }
  const double GAs = E / 2.6 * 1.6e-3;
  for (int n = 1; n <= 4; ++n) {
    const double k = n * std::numbers::pi / L;
    const double a = rho * Iz * rho * A / GAs, b = rho * A + k * k * (rho * Iz + rho * A * E * Iz / GAs);
    const double c = E * Iz * std::pow(k, 4);
    const double exact = std::sqrt(2.0 * c / (b + std::sqrt(b * b - 4.0 * a * c)));
    const double coarse = omega[0][n - 1] / exact - 1.0, fine = omega[1][n - 1] / exact - 1.0;
    EXPECT_GT(fine, 0.0) << "mode " << n;
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1) << "mode " << n;
    EXPECT_NEAR((4.0 * fine - coarse) / 3.0, 0.0, 1e-6) << "mode " << n;
    EXPECT_LT(exact, k * k * std::sqrt(E * Iz / (rho * A)) * (1.0 - 1e-3)) << "shear and rotary inertia count";
  }
}

/// Pinned-free beam of [Car00] 8.1, linear Timoshenko theory: roots of the determinant of its four boundary conditions
/// (w = M = 0, M = Q = 0), solved with 40 digits. A discretised beam gave 10.94188, 35.36524, 73.48415, 124.97026
/// (reference data of the example): 4e-5 above at the fourth.
TEST(Frequencies, PinnedFreeBeamOfThePaper) {
  Eigen::VectorXd omega[2];
  for (int i = 0; i < 2; ++i) {
    const FullModel full = full_model(cardona_beam(60 << i, 0));
    const std::vector<int> keep = plane(full, 1, 5, {1});
    omega[i] = eigenvalues(full.S(keep, keep), full.M(keep, keep), -50.0).cwiseMax(0.0).cwiseSqrt();
  }
  const double exact[4] = {10.9418746264, 35.3651347396, 73.4831884064, 124.965530471};
  const double discretised[4] = {10.94188, 35.36524, 73.48415, 124.97026};
  EXPECT_LT(omega[0][0], 1e-4);  // turning about the pin
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR((4.0 * omega[1][k + 1] - omega[0][k + 1]) / 3.0 / exact[k], 1.0, 1e-6) << "mode " << k + 1;
    EXPECT_NEAR(omega[0][k + 1] / discretised[k], 1.0, 5e-5) << "mode " << k + 1;
  }
}

/// log2 of the ratio of errors of the first cantilever frequency on n and 2 n elements.
double measured_order(MassMatrix mass_matrix, int coarse) {
  double error[2];
  for (int i = 0; i < 2; ++i) {
    formats::Part part = beam_along_x(coarse << i);
    set_theory(part, BeamTheory::euler_bernoulli);
    set_mass(part, mass_matrix, false);
    const FullModel full = full_model(part);
    error[i] = angular_frequencies(full.S, full.M, plane(full, 1, 5, {1, 5}))[0] / cantilever_omega(0, Iz) - 1.0;
  }
  return std::log2(error[0] / error[1]);
}

TEST(Frequencies, ConsistentMassConvergesWithOrderFour) {
  const double order = measured_order(MassMatrix::consistent, 2);
  EXPECT_GT(order, 3.7);
  EXPECT_LT(order, 4.3);
}

TEST(Frequencies, TorsionAndAxialOfALumpedBeamConvergeFromBelow) {
  // Clamped-free rod: ω = π/(2 L) c; lumped: ω = 2 c/h sin(π h/(4 L)).
  const int n = 8;
  formats::Part part = beam_along_x(n);
  set_mass(part, MassMatrix::lumped, true);
  const FullModel full = full_model(part);
  const double h = L / n;
  for (const int component : {0, 3}) {
    std::vector<int> keep;
    for (int a = 1; a < full.mesh.nodes(); ++a) keep.push_back(6 * a + component);
    const double c = component == 0 ? std::sqrt(E / rho) : std::sqrt(E / 2.6 * 6e-7 / (rho * 11e-7));
    EXPECT_NEAR(
        angular_frequencies(full.S, full.M, keep)[0] / (2.0 * c / h * std::sin(std::numbers::pi * h / (4.0 * L))), 1.0,
        1e-12);
  }
}

TEST(Frequencies, LumpedMassConvergesWithOrderTwo) {
  const double order = measured_order(MassMatrix::lumped, 8);
  EXPECT_GT(order, 1.8);
  EXPECT_LT(order, 2.2);
}

}  // namespace
}  // namespace tisserand::testing::frequencies_test
