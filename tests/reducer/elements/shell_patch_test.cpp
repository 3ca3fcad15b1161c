// SPDX-License-Identifier: GPL-3.0-or-later
// Patch tests of the shell elements: constant strain and curvature come out to round-off in any orientation.
#include <gtest/gtest.h>

#include "tests/problems/shell_patch.hpp"
#include "tests/reducer/elements/shell_cases.hpp"

namespace tisserand::reducer::shell_patch_test {
namespace {

using Eigen::Vector3d;

struct PatchCase {
  std::string name;
  ShellPatch patch;
};

std::vector<PatchCase> patch_cases() {
  const ShellSection thin = isotropic_shell(1e6, 0.25, 1.0, 0.001, 5.0 / 6.0);
  const ShellSection thick = isotropic_shell(1e6, 0.25, 1.0, 0.05, 5.0 / 6.0);
  const PatchState both{Vector3d(1e-3, -2e-3, 5e-4), Vector3d(0.02, 0.01, -0.03)};
  std::vector<PatchCase> cases;
  for (Facets facets : {Facets::quadrilaterals, Facets::triangles}) {
    const std::string kind = facets == Facets::quadrilaterals ? "quads" : "triangles";
    cases.push_back({kind + "_membrane", {facets, thin, 0.0, patch_membrane()}});
    cases.push_back({kind + "_bending_thin", {facets, thin, 0.0, patch_bending()}});
    cases.push_back({kind + "_bending_thick", {facets, thick, 0.0, patch_bending()}});
    cases.push_back({kind + "_laminate_offset", {facets, skew_laminate(), 0.03, both}});
  }
  return cases;
}

class ConstantStates : public ::testing::TestWithParam<PatchCase> {};

/// The inner nodes find their places, and the energy is that of the constant state.
TEST_P(ConstantStates, AreExact) {
  for (const Vector3d& turn : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.7, -1.1, 0.4)}) {
    const PatchErrors errors = patch_errors(GetParam().patch, turn);
    const double condition = 1e4;  // of stiffness: (size/thickness)²
    EXPECT_LT(errors.motion, 1e-15 * condition * 100.0);
    EXPECT_LT(errors.energy, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(ShellPatch, ConstantStates, ::testing::ValuesIn(patch_cases()),
                         [](const auto& test) { return test.param.name; });

/// Constant transverse shear: with rotations held at zero, only shear is left. The residual flexibility of bending
/// vanishes with the square of the size over the thickness ([LSV93], [Kat93]), and so does the error of the energy.
TEST(ShellShear, BecomesConstantAsElementsShrink) {
  for (const Facets facets : {Facets::quadrilaterals, Facets::triangles}) {
    double previous = 0.0;
    for (const int n : {4, 8, 16}) {
      const ShellSection section = isotropic_shell(1.0, 0.3, 0.0, 0.5, 5.0 / 6.0);
      const Mesh mesh = shell_grid(
          {n, n, facets, false}, [](double a, double b) { return Vector3d(a, b, 0.0); }, section);
      Eigen::VectorXd u = Eigen::VectorXd::Zero(6 * mesh.nodes());
      for (int i = 0; i < mesh.nodes(); ++i) u[6 * i + 2] = mesh.position(0, i);
      const double error = 1.0 - u.dot(assemble_small(mesh).S * u) / section.As(0, 0);
      EXPECT_GT(error, 0.0);
      EXPECT_LT(error, 0.5 / (n * n) / (0.5 * 0.5));
      if (previous > 0.0) {
        EXPECT_GT(std::log2(previous / error), 1.8);
        EXPECT_LT(std::log2(previous / error), 2.2);
      }
      previous = error;
    }
  }
}

}  // namespace
}  // namespace tisserand::reducer::shell_patch_test
