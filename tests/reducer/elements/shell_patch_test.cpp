// Patch tests of the shell elements: constant strain and curvature come out to round-off in any orientation.
#include <gtest/gtest.h>

#include "tests/reducer/elements/shell_cases.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// The patch of MacNeal and Harder ([MH85]): 0.24 x 0.12 with four inner nodes and five quadrilaterals, in the x-y
/// plane.
Mesh patch(Facets facets, const ShellSection& section) {
  Mesh mesh;
  mesh.position.resize(3, 8);
  mesh.position << 0.0, 0.24, 0.24, 0.0, 0.04, 0.18, 0.16, 0.08,  //
      0.0, 0.0, 0.12, 0.12, 0.02, 0.03, 0.08, 0.08,               //
      0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  mesh.node_label.assign(8, "node");
  mesh.shell_properties.push_back({section, formats::MassMatrix::consistent, "patch"});
  for (const std::array<int, 4>& q :
       std::vector<std::array<int, 4>>{{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}) {
    ShellElement shell;
    shell.material_x = Vector3d(0.8, 0.6, 0.0);
    if (facets == Facets::quadrilaterals) {
      shell.nodes = q;
      mesh.shells.push_back(shell);
    } else {
      shell.nodes = {q[0], q[1], q[2], -1};
      mesh.shells.push_back(shell);
      shell.nodes = {q[0], q[2], q[3], -1};
      mesh.shells.push_back(shell);
    }
  }
  return mesh;
}

/// Constant membrane strain and curvature of the middle surface in part axes x, y (engineering shear).
struct State {
  Vector3d epsilon = Vector3d::Zero();
  Vector3d kappa = Vector3d::Zero();
};

/// Displacements and rotations of a node whose middle surface lies `offset` above it.
Eigen::Matrix<double, 6, 1> motion(const State& state, const Vector3d& x, double offset) {
  const Vector3d& e = state.epsilon;
  const Vector3d& k = state.kappa;  // κxx = −w,xx etc.
  const Vector2d slope(-k[0] * x.x() - 0.5 * k[2] * x.y(), -k[1] * x.y() - 0.5 * k[2] * x.x());
  Vector3d u(e[0] * x.x() + 0.5 * e[2] * x.y(), 0.5 * e[2] * x.x() + e[1] * x.y(), 0.5 * slope.dot(x.head<2>()));
  const Vector3d theta(slope.y(), -slope.x(), 0.0);
  u -= theta.cross(Vector3d(0.0, 0.0, offset));
  Eigen::Matrix<double, 6, 1> result;
  result << u, theta;
  return result;
}

struct PatchCase {
  std::string name;
  Facets facets;
  ShellSection section;
  double offset;
  State state;
};

std::vector<PatchCase> patch_cases() {
  const ShellSection thin = isotropic_shell(1e6, 0.25, 1.0, 0.001, 5.0 / 6.0);
  const ShellSection thick = isotropic_shell(1e6, 0.25, 1.0, 0.05, 5.0 / 6.0);
  const State membrane{Vector3d(1e-3, 1e-3, 1e-3), Vector3d::Zero()};
  const State bending{Vector3d::Zero(), Vector3d(-1e-3, -1e-3, -1e-3)};
  const State both{Vector3d(1e-3, -2e-3, 5e-4), Vector3d(0.02, 0.01, -0.03)};
  std::vector<PatchCase> cases;
  for (Facets facets : {Facets::quadrilaterals, Facets::triangles}) {
    const std::string kind = facets == Facets::quadrilaterals ? "quads" : "triangles";
    cases.push_back({kind + "_membrane", facets, thin, 0.0, membrane});
    cases.push_back({kind + "_bending_thin", facets, thin, 0.0, bending});
    cases.push_back({kind + "_bending_thick", facets, thick, 0.0, bending});
    cases.push_back({kind + "_laminate_offset", facets, skew_laminate(), 0.03, both});
  }
  return cases;
}

class ShellPatch : public ::testing::TestWithParam<PatchCase> {};

/// The inner nodes find their places, and the energy is that of the constant state.
TEST_P(ShellPatch, ConstantStatesAreExact) {
  const PatchCase& c = GetParam();
  for (const Vector3d& turn : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.7, -1.1, 0.4)}) {
    const Matrix3d R = exp_so3<double>(turn);
    Mesh mesh = patch(c.facets, c.section);
    const Eigen::Matrix3Xd flat = mesh.position;
    mesh.position = R * flat;
    for (ShellElement& shell : mesh.shells) {
      shell.material_x = R * shell.material_x;
      shell.offset = c.offset;
    }
    SmallModel model(mesh);
    Eigen::VectorXd exact(48);
    for (int i = 0; i < 8; ++i) {
      const Eigen::Matrix<double, 6, 1> m = motion(c.state, flat.col(i), c.offset);
      exact.segment<3>(6 * i) = R * m.head<3>();
      exact.segment<3>(6 * i + 3) = R * m.tail<3>();
      for (int k = 0; k < 6 && i < 4; ++k) model.prescribe(i, k, exact[6 * i + k]);
    }
    const Eigen::VectorXd u = solve_small(model);
    const double condition = 1e4;  // of stiffness: (size/thickness)²
    EXPECT_LT((u - exact).cwiseAbs().maxCoeff(), 1e-15 * condition * 100.0 * exact.cwiseAbs().maxCoeff());
    Matrix3d to_material;  // strains along the material axes at atan(0.6/0.8)
    const double x = 0.8, y = 0.6;
    to_material << x * x, y * y, x * y, y * y, x * x, -x * y, -2 * x * y, 2 * x * y, x * x - y * y;
    const Vector3d e = to_material * c.state.epsilon, k = to_material * c.state.kappa;
    const double energy =
        0.24 * 0.12 * (e.dot(c.section.A * e) + 2.0 * e.dot(c.section.B * k) + k.dot(c.section.D * k));
    EXPECT_NEAR(u.dot(assemble_small(mesh).S * u) / energy, 1.0, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShellPatch, ::testing::ValuesIn(patch_cases()),
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
}  // namespace tisserand::reducer
