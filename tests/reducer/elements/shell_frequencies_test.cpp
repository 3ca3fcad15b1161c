// SPDX-License-Identifier: GPL-3.0-or-later
// Frequencies of plates and shells against NAFEMS, Ritz and closed forms, and their order of convergence.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "tests/problems/shell_vibration.hpp"

namespace tisserand::reducer::shell_frequencies_test {
namespace {

using Eigen::VectorXd;

constexpr auto quads = Facets::quadrilaterals;
constexpr auto triangles = Facets::triangles;

void expect_frequencies(const VectorXd& hertz, int first, const std::vector<double>& target, double error) {
  for (std::size_t i = 0; i < target.size(); ++i)
    EXPECT_NEAR(hertz[first + static_cast<int>(i)] / target[i], 1.0, error) << "mode " << i + 1;
}

/// NAFEMS FV12, free square plate 10 x 10 x 0.05 m: thin-plate Ritz values; six rigid modes.
TEST(ShellFrequencies, FreeSquarePlate) {
  const std::vector<double> target{1.6217, 2.3595, 2.9223, 4.1902, 4.1902, 7.3560, 7.3560, 7.6682};
  for (const auto& [facets, n, error] : {std::tuple{quads, 8, 0.03}, {quads, 16, 0.01}, {triangles, 16, 0.005}}) {
    const VectorXd hertz = free_square_plate({facets, n});
    EXPECT_LT(hertz.head(6).maxCoeff(), 1e-3);
    expect_frequencies(hertz, 6, target, error);
  }
}

/// NAFEMS FV15, clamped rhombic plate of 45 degrees: thin-plate Ritz with 18 x 18 polynomials in oblique coordinates,
/// 5 digits. NAFEMS prints 7.938 12.835 17.941 19.133 24.009 27.922, up to 1.3 % higher, of a mesh.
TEST(ShellFrequencies, ClampedRhombicPlate) {
  for (const auto& [facets, n, error] : {std::tuple{quads, 24, 0.01}, {triangles, 24, 0.03}})
    expect_frequencies(clamped_rhombic_plate({facets, n}), 0, {7.9038, 12.8227, 17.8577, 18.932, 23.6927, 27.6322},
                       error);
}

/// NAFEMS FV52, simply supported thick square plate: Mindlin's closed form with 5/6.
TEST(ShellFrequencies, ThickPlateSimplySupported) {
  for (const auto& [facets, n, error] : {std::tuple{quads, 8, 0.04}, {quads, 16, 0.01}, {triangles, 16, 0.005}})
    expect_frequencies(thick_plate_bending({facets, n}), 0, {45.911, 109.528, 109.528, 168.074}, error);
}

/// Free vibration in the plane of the same plate: Ritz values; three rigid modes.
TEST(ShellFrequencies, SquareInItsPlane) {
  for (const auto& [facets, n, error] : {std::tuple{quads, 8, 0.01}, {quads, 16, 0.003}, {triangles, 16, 0.006}})
    expect_frequencies(thick_plate_in_its_plane({facets, n}), 3, {193.584, 206.182, 206.182}, error);
}

/// λ = ω a² √(ρh/D) of thin square plates: Ritz with 14 x 14 Legendre polynomials.
TEST(ShellFrequencies, ThinSquarePlates) {
  for (const Facets facets : {quads, triangles}) {
    expect_frequencies(square_plate_parameters({facets, 16}, SquareEdges::simply_supported), 0,
                       {19.7392, 49.3480, 49.3480, 78.9568}, 0.015);
    expect_frequencies(square_plate_parameters({facets, 16}, SquareEdges::clamped), 0,
                       {35.9852, 73.3938, 73.3938, 108.2165, 131.5808, 132.2048}, 0.03);
    expect_frequencies(square_plate_parameters({facets, 16}, SquareEdges::free), 0,
                       {13.4682, 19.5961, 24.2702, 34.8009, 34.8009, 61.0932}, 0.015);
  }
}

/// Clamped cylinder R 0.1, L 0.4, t 0.01 m: 1701 Hz (FinEtoolsFlexStructures, commit d7ccda5, from ADINA), a double
/// mode.
TEST(ShellFrequencies, ClampedCylinder) {
  for (const auto& [facets, n, error] : {std::tuple{quads, 4, 0.03}, {quads, 8, 0.01}, {triangles, 6, 0.025}})
    expect_frequencies(clamped_cylinder({facets, n}), 0, {1701.0, 1701.0}, error);
}

/// Torsion of the same cylinder: √(G/ρ)/(2L), of a thin wall; (t/R)²/12 of it is below 1e-3. Clamped ends also hold the
/// drilling rotation, which is wrong by half the shear strain there: from above, with order 1.
TEST(ShellFrequencies, TorsionOfTheClampedCylinder) {
  const double exact = std::sqrt(200e9 / 2.6 / 7800.0) / 0.8;
  for (const Facets facets : {quads, triangles})
    EXPECT_NEAR(cylinder_torsion({facets, 4}, CylinderEnds::hinged) / exact, 1.0, 0.005);
  const double coarse = cylinder_torsion({quads, 4}, CylinderEnds::clamped) / exact - 1.0;
  const double fine = cylinder_torsion({quads, 8}, CylinderEnds::clamped) / exact - 1.0;
  EXPECT_GT(fine, 0.0);
  EXPECT_LT(fine, 0.75 * coarse);
}

/// ω² of the thin simply supported plate, exact π⁴ 4 D/(ρ t a⁴) up to the shear and rotary terms of (t/a)² = 1e-6.
/// Linear curvatures: order 2.
TEST(ShellFrequencies, ConvergeWithOrderTwo) {
  for (const Facets facets : {quads, triangles}) {
    double previous = 0.0;
    for (const int n : {4, 8, 16}) {
      const double error = std::abs(square_plate_ratio({facets, n}) - 1.0);
      if (previous > 0.0) {
        EXPECT_GT(std::log2(previous / error), 1.6);
        EXPECT_LT(std::log2(previous / error), 2.4);
      }
      previous = error;
    }
  }
}

}  // namespace
}  // namespace tisserand::reducer::shell_frequencies_test
