// Frequencies of plates and shells against NAFEMS, Ritz and closed forms, and their order of convergence.
#include <gtest/gtest.h>

#include "tests/reducer/elements/shell_cases.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;

constexpr Components x = 1, y = 2, z = 4, rx = 8, ry = 16, rz = 32;
constexpr auto quads = Facets::quadrilaterals;
constexpr auto triangles = Facets::triangles;

ShellSection nafems(double thickness) { return isotropic_shell(200e9, 0.3, 8000.0, thickness, 5.0 / 6.0); }

Mesh plate(const GridShape& grid, double thickness) {
  return shell_grid(
      grid, [](double a, double b) { return Vector3d(10.0 * a, 10.0 * b, 0.0); }, nafems(thickness));
}

void expect_frequencies(const VectorXd& hertz, int first, const std::vector<double>& target, double error) {
  for (std::size_t i = 0; i < target.size(); ++i)
    EXPECT_NEAR(hertz[first + static_cast<int>(i)] / target[i], 1.0, error) << "mode " << i + 1;
}

/// NAFEMS FV12, free square plate 10 x 10 x 0.05 m: thin-plate Ritz values; six rigid modes.
TEST(ShellFrequencies, FreeSquarePlate) {
  const std::vector<double> target{1.6217, 2.3595, 2.9223, 4.1902, 4.1902, 7.3560, 7.3560, 7.6682};
  for (const auto& [facets, n, error] : {std::tuple{quads, 8, 0.03}, {quads, 16, 0.01}, {triangles, 16, 0.005}}) {
    const VectorXd hertz = modes_small(SmallModel(plate({n, n, facets, false}, 0.05)), 14, 100.0).hertz();
    EXPECT_LT(hertz.head(6).maxCoeff(), 1e-3);
    expect_frequencies(hertz, 6, target, error);
  }
}

/// NAFEMS FV15, clamped rhombic plate of 45 degrees.
TEST(ShellFrequencies, ClampedRhombicPlate) {
  for (const auto& [facets, n, error] : {std::tuple{quads, 8, 0.07}, {quads, 16, 0.015}, {triangles, 24, 0.03}}) {
    const GridShape grid{n, n, facets, false};
    const double c = std::sqrt(0.5);
    SmallModel model(shell_grid(
        grid, [&](double a, double b) { return Vector3d(10.0 * (a + c * b), 10.0 * c * b, 0.0); }, nafems(0.05)));
    hold_where(model, x | y | rz, [](const Vector3d&) { return true; });
    for (int i = 0; i <= n; ++i)
      for (const int node :
           {grid_node(grid, i, 0), grid_node(grid, i, n), grid_node(grid, 0, i), grid_node(grid, n, i)})
        model.hold(node, all_components);
    expect_frequencies(modes_small(model, 6, 0.0).hertz(), 0, {7.938, 12.835, 17.941, 19.133, 24.009, 27.922}, error);
  }
}

/// Supports of a plate with edges at 0 and 10: no deflection, no rotation along the edge.
void support_simply(SmallModel& model) {
  const auto at_edge = [](double p) { return std::abs(p) < 1e-9 || std::abs(p - 10.0) < 1e-9; };
  hold_where(model, z | rx, [&](const Vector3d& p) { return at_edge(p.x()); });
  hold_where(model, z | ry, [&](const Vector3d& p) { return at_edge(p.y()); });
}

/// NAFEMS FV52, simply supported thick square plate: Mindlin's closed form with 5/6.
TEST(ShellFrequencies, ThickPlateSimplySupported) {
  for (const auto& [facets, n, error] : {std::tuple{quads, 8, 0.04}, {quads, 16, 0.01}, {triangles, 16, 0.005}}) {
    SmallModel model(plate({n, n, facets, false}, 1.0));
    support_simply(model);
    hold_where(model, x | y | rz, [](const Vector3d&) { return true; });
    expect_frequencies(modes_small(model, 4, 0.0).hertz(), 0, {45.911, 109.528, 109.528, 168.074}, error);
  }
}

/// Free vibration in the plane of the same plate: Ritz values; three rigid modes.
TEST(ShellFrequencies, SquareInItsPlane) {
  for (const auto& [facets, n, error] : {std::tuple{quads, 8, 0.01}, {quads, 16, 0.003}, {triangles, 16, 0.006}}) {
    SmallModel model(plate({n, n, facets, false}, 1.0));
    hold_where(model, z | rx | ry, [](const Vector3d&) { return true; });
    expect_frequencies(modes_small(model, 6, 1e5).hertz(), 3, {193.584, 206.182, 206.182}, error);
  }
}

/// Clamped cylinder R 0.1, L 0.4, t 0.01 m: 1701 Hz (FinEtoolsFlexStructures, commit d7ccda5, from ADINA), a double
/// mode.
TEST(ShellFrequencies, ClampedCylinder) {
  for (const auto& [facets, n, error] : {std::tuple{quads, 4, 0.03}, {quads, 8, 0.01}, {triangles, 6, 0.025}}) {
    SmallModel model(shell_grid(
        {4 * n, 2 * n, facets, true},
        [](double a, double b) { return Vector3d(0.1 * std::cos(2 * pi * a), 0.1 * std::sin(2 * pi * a), 0.4 * b); },
        isotropic_shell(200e9, 0.3, 7800.0, 0.01, 5.0 / 6.0)));
    hold_where(model, all_components, [](const Vector3d& p) { return std::abs(p.z() - 0.2) > 0.2 - 1e-9; });
    expect_frequencies(modes_small(model, 2, 0.0).hertz(), 0, {1701.0, 1701.0}, error);
  }
}

/// ω² of the thin simply supported plate, exact π⁴ 4 D/(ρ t a⁴) up to the shear and rotary terms of (t/a)² = 1e-6.
/// Linear curvatures: order 2.
TEST(ShellFrequencies, ConvergeWithOrderTwo) {
  const ShellSection s = nafems(0.01);
  const double exact = 4.0 * std::pow(pi / 10.0, 4) * s.D(0, 0) / s.mass;
  for (const Facets facets : {quads, triangles}) {
    double previous = 0.0;
    for (const int n : {4, 8, 16}) {
      SmallModel model(plate({n, n, facets, false}, 0.01));
      support_simply(model);
      hold_where(model, x | y | rz, [](const Vector3d&) { return true; });
      const double error = std::abs(modes_small(model, 1, 0.0).omega2[0] / exact - 1.0);
      if (previous > 0.0) {
        EXPECT_GT(std::log2(previous / error), 1.6);
        EXPECT_LT(std::log2(previous / error), 2.4);
      }
      previous = error;
    }
  }
}

}  // namespace
}  // namespace tisserand::reducer
