// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of the shell elements: symmetry, zero-energy modes, mass, invariance under rotation, renumbering and reversal.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "reducer/elements/element_matrices.hpp"
#include "tests/reducer/elements/shell_cases.hpp"

namespace tisserand::reducer::shell_laws_test {
namespace {

using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using formats::MassMatrix;

struct Case {
  std::string name;
  Matrix3Xd corners;
  ShellSection section;
  double offset;
  MassMatrix mass_matrix;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto& [shape, corners] : std::vector<std::pair<std::string, Matrix3Xd>>{
           {"square", square()}, {"distorted", distorted_quad()}, {"warped", warped_quad()}, {"triangle", triangle()}})
    for (MassMatrix mass : {MassMatrix::consistent, MassMatrix::lumped}) {
      const std::string kind = mass == MassMatrix::consistent ? "_consistent" : "_lumped";
      all.push_back({shape + "_steel" + kind, corners, steel(0.05), 0.0, mass});
      all.push_back({shape + "_laminate_offset" + kind, corners, skew_laminate(), 0.07, mass});
    }
  return all;
}

class ShellLaws : public ::testing::TestWithParam<Case> {
 protected:
  static Mesh mesh_of(const Case& c, const Matrix3Xd& corners) {
    Mesh mesh = one_shell(corners, c.section);
    mesh.shells[0].offset = c.offset;
    mesh.shell_properties[0].mass_matrix = c.mass_matrix;
    return mesh;
  }
  static ElementMatrices matrices_of(const Mesh& mesh) {
    ElementMatrices out;
    element_matrices(mesh, mesh.shells[0], out);
    return out;
  }
  Mesh mesh = mesh_of(GetParam(), somewhere(GetParam().corners));
  ElementMatrices element = matrices_of(mesh);
};

TEST_P(ShellLaws, MatricesAreSymmetric) {
  ASSERT_EQ(element.S.rows(), 6 * mesh.nodes());
  EXPECT_EQ((element.S - element.S.transpose()).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ((element.M - element.M.transpose()).cwiseAbs().maxCoeff(), 0.0);
}

TEST_P(ShellLaws, ExactlySixMotionsCostNoEnergy) {
  // Round-off of sums of 24 products of the size of the largest entry.
  EXPECT_LT((element.S * rigid_motions(mesh)).cwiseAbs().maxCoeff(), 1e-13 * element.S.cwiseAbs().maxCoeff());
  const Eigen::VectorXd value = Eigen::SelfAdjointEigenSolver<MatrixXd>(element.S).eigenvalues();
  const double largest = value[value.size() - 1];
  EXPECT_LT(value.head<6>().cwiseAbs().maxCoeff(), 1e-13 * largest);
  EXPECT_GT(value[6], 1e-6 * largest);  // t²/12 of the membrane's and the small factor of its quadratic modes
}

TEST_P(ShellLaws, MassIsPositiveSemidefinite) {
  const Eigen::VectorXd value = Eigen::SelfAdjointEigenSolver<MatrixXd>(element.M).eigenvalues();
  EXPECT_GT(value[0], -1e-14 * value[value.size() - 1]);
}

/// Integrals of 1, x and x xᵀ over the bilinear surface by a finer rule than the element's.
TEST_P(ShellLaws, MassAndInertiaAreThoseOfTheBody) {
  const Case& c = GetParam();
  const Matrix3Xd X = mesh.position;
  const ShellSection& s = c.section;
  Vector3d normal = X.cols() == 3 ? Vector3d((X.col(1) - X.col(0)).cross(X.col(2) - X.col(0)))
                                  : Vector3d((X.col(2) - X.col(0)).cross(X.col(3) - X.col(1)));
  normal.normalize();
  Eigen::Matrix<double, 6, 6> expected = Eigen::Matrix<double, 6, 6>::Zero();
  constexpr int n = 100;  // midpoint rule: error of n⁻²/24
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double a = (i + 0.5) / n, b = (j + 0.5) / n;
      Vector3d x, xa, xb;
      if (X.cols() == 3) {  // collapsed square
        x = X.col(0) + a * (X.col(1) - X.col(0)) + a * b * (X.col(2) - X.col(1));
        xa = X.col(1) - X.col(0) + b * (X.col(2) - X.col(1));
        xb = a * (X.col(2) - X.col(1));
      } else {
        x = (1 - a) * (1 - b) * X.col(0) + a * (1 - b) * X.col(1) + a * b * X.col(2) + (1 - a) * b * X.col(3);
        xa = (1 - b) * (X.col(1) - X.col(0)) + b * (X.col(2) - X.col(3));
        xb = (1 - a) * (X.col(3) - X.col(0)) + a * (X.col(2) - X.col(1));
      }
      const double dA = xa.cross(xb).norm() / (n * n);
      x += c.offset * normal;
      const double m0 = s.mass * dA, m1 = s.first_moment * dA, m2 = s.rotary_inertia * dA;
      const Eigen::Matrix3d r = skew<double>(x), z = skew<double>(normal);
      expected.topLeftCorner<3, 3>() += m0 * Eigen::Matrix3d::Identity();
      expected.topRightCorner<3, 3>() -= m0 * r + m1 * z;
      expected.bottomLeftCorner<3, 3>() += m0 * r + m1 * z;
      expected.bottomRightCorner<3, 3>() -= m0 * r * r + m1 * (r * z + z * r) + m2 * z * z;
    }
  const MatrixXd R = rigid_motions(mesh);
  const Eigen::Matrix<double, 6, 6> mass = R.transpose() * element.M * R;
  const double size = expected.cwiseAbs().maxCoeff();
  EXPECT_NEAR(mass(0, 0), expected(0, 0), 1e-4 * size);  // two rules on the same warped area
  if (c.mass_matrix == MassMatrix::consistent)
    EXPECT_LT((mass - expected).cwiseAbs().maxCoeff(), 1e-4 * size);
  else  // the centre of mass is kept, the inertia is that of masses at the corners
    EXPECT_LT((mass - expected).topRightCorner(3, 3).cwiseAbs().maxCoeff(), 1e-4 * size);
}

TEST_P(ShellLaws, MatricesTurnWithTheElement) {
  Mesh plain = mesh_of(GetParam(), GetParam().corners);
  const ElementMatrices before = matrices_of(plain);
  const Eigen::Matrix3d R = exp_so3<double>(Vector3d(0.4, -0.9, 1.3));
  MatrixXd T = MatrixXd::Zero(6 * mesh.nodes(), 6 * mesh.nodes());
  for (int i = 0; i < 2 * mesh.nodes(); ++i) T.block<3, 3>(3 * i, 3 * i) = R;
  EXPECT_LT((T * before.S * T.transpose() - element.S).cwiseAbs().maxCoeff(), 1e-13 * before.S.cwiseAbs().maxCoeff());
  EXPECT_LT((T * before.M * T.transpose() - element.M).cwiseAbs().maxCoeff(), 1e-13 * before.M.cwiseAbs().maxCoeff());
}

/// Matrices do not depend on the first node or on the side of the normal (plies reversed, offset negative).
TEST_P(ShellLaws, NumberingAndSideOfTheNormalDoNotMatter) {
  const int n = mesh.nodes();
  mesh.shells[0].material_x = Vector3d(0.2, 0.9, -0.3);
  const ElementMatrices first = matrices_of(mesh);
  Mesh other = mesh;
  for (int i = 0; i < n; ++i) other.shells[0].nodes[i] = (i + 1) % n;
  const ElementMatrices shifted = matrices_of(other);
  other = mesh;
  for (int i = 0; i < n; ++i) other.shells[0].nodes[i] = n - 1 - i;
  other.shells[0].offset = -mesh.shells[0].offset;
  ShellSection& s = other.shell_properties[0].section;  // x kept, y and z reversed
  const Vector3d flip(1.0, 1.0, -1.0);
  s.A = flip.asDiagonal() * s.A * flip.asDiagonal();
  s.B = -(flip.asDiagonal() * s.B * flip.asDiagonal()).eval();
  s.D = flip.asDiagonal() * s.D * flip.asDiagonal();
  s.As(0, 1) = s.As(1, 0) = -s.As(0, 1);
  s.first_moment = -s.first_moment;
  const ElementMatrices reversed = matrices_of(other);
  const double S = first.S.cwiseAbs().maxCoeff(), M = first.M.cwiseAbs().maxCoeff();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int si = (i + n - 1) % n, sj = (j + n - 1) % n, ri = n - 1 - i, rj = n - 1 - j;
      const auto block = [](const MatrixXd& K, int a, int b) { return MatrixXd(K.block(6 * a, 6 * b, 6, 6)); };
      EXPECT_LT((block(first.S, i, j) - block(shifted.S, si, sj)).cwiseAbs().maxCoeff(), 1e-12 * S);
      EXPECT_LT((block(first.M, i, j) - block(shifted.M, si, sj)).cwiseAbs().maxCoeff(), 1e-12 * M);
      EXPECT_LT((block(first.S, i, j) - block(reversed.S, ri, rj)).cwiseAbs().maxCoeff(), 1e-12 * S);
      EXPECT_LT((block(first.M, i, j) - block(reversed.M, ri, rj)).cwiseAbs().maxCoeff(), 1e-12 * M);
    }
}

INSTANTIATE_TEST_SUITE_P(All, ShellLaws, ::testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

/// A whole warped mesh has no motion without energy beyond the six rigid ones either.
TEST(ShellMesh, HasSixZeroEnergyModes) {
  for (const Facets facets : {Facets::quadrilaterals, Facets::triangles}) {
    const Surface twisted = [](double a, double b) {
      const double angle = 1.2 * a;
      return Vector3d(2.0 * a + 0.1 * std::sin(7.0 * a * b), (b - 0.5) * std::cos(angle), (b - 0.5) * std::sin(angle));
    };
    const Mesh mesh = shell_grid({4, 3, facets, false}, twisted, steel(0.05));
    const SmallMatrices whole = assemble_small(mesh);
    const Eigen::VectorXd value = Eigen::SelfAdjointEigenSolver<MatrixXd>(MatrixXd(whole.S)).eigenvalues();
    EXPECT_LT(value.head<6>().cwiseAbs().maxCoeff(), 1e-13 * value[value.size() - 1]);
    EXPECT_GT(value[6], 1e-9 * value[value.size() - 1]);
  }
}

}  // namespace
}  // namespace tisserand::reducer::shell_laws_test
