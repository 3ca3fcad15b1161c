// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of every solid element by itself: symmetry, six zero modes, mass, rotation, renumbering.
#include "reducer/elements/element_matrices.hpp"

#include <random>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "common/math/rotation.hpp"
#include "reducer/properties/solid_anisotropic.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::reducer::solid_test {
namespace {

enum class Geometry { straight, curved };

/// An affine image of the reference element with corners shifted by up to 0.15; middles on straight edges or shifted
/// too.
Eigen::Matrix3Xd distorted(SolidShape shape, Geometry geometry, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.15, 0.15);
  Eigen::Matrix3d map;
  map << 1.1, 0.2, -0.1, 0.05, 0.8, 0.3, 0.1, -0.2, 1.3;
  Eigen::Matrix3Xd x = map * natural_nodes(shape);
  with_shape(shape, [&]<SolidShape s>() {
    constexpr std::size_t corners = SolidBasis<s>::corners;
    const double size = corners == 4 ? 0.5 : 1.0;
    for (std::size_t a = 0; a < corners; ++a)
      for (int i = 0; i < 3; ++i) x(i, static_cast<Eigen::Index>(a)) += size * shift(random);
    for (std::size_t a = corners; a < SolidBasis<s>::nodes.size(); ++a) {
      const auto [p, q] = SolidBasis<s>::edges[a - corners];
      x.col(a) = 0.5 * (x.col(p) + x.col(q));
      if (geometry == Geometry::curved)
        for (int i = 0; i < 3; ++i) x(i, static_cast<Eigen::Index>(a)) += 0.2 * size * shift(random);
    }
  });
  return x;
}

SolidProperty steel_like(formats::MassMatrix kind) { return {isotropic_solid(2.0, 0.3, 1.7), kind, "steel"}; }

/// A material without any symmetry: C = 1 + A Aᵀ with random A.
SolidProperty triclinic() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Matrix6 A = Matrix6::NullaryExpr([&] { return uniform(random); });
  return {anisotropic_solid(Matrix6::Identity() + A * A.transpose(), Eigen::Matrix3d::Identity(), 1.7, "test"),
          formats::MassMatrix::consistent, "triclinic"};
}

ElementMatrices matrices_of(const Mesh& mesh) {
  ElementMatrices out;
  element_matrices(mesh, mesh.solids.front(), out);
  return out;
}

/// Rigid motions of the nodes, rotations about the origin: 3 nodes x 6.
Eigen::MatrixXd rigid_motions_of(const Eigen::Matrix3Xd& x) {
  Eigen::MatrixXd R(3 * x.cols(), 6);
  for (Eigen::Index a = 0; a < x.cols(); ++a)
    R.middleRows<3>(3 * a) << Eigen::Matrix3d::Identity(), -skew<double>(x.col(a));
  return R;
}

class Solid : public ::testing::TestWithParam<SolidShape> {
 protected:
  std::vector<Eigen::Matrix3Xd> geometries() const {
    std::vector<Eigen::Matrix3Xd> all;
    for (unsigned seed = 1; seed <= 3; ++seed) all.push_back(distorted(GetParam(), Geometry::straight, seed));
    if (is_quadratic(GetParam()))
      for (unsigned seed = 4; seed <= 6; ++seed) all.push_back(distorted(GetParam(), Geometry::curved, seed));
    return all;
  }
};

TEST_P(Solid, ShapeFunctionsAreOneAtTheirNodeAndSumToOne) {
  with_shape(GetParam(), []<SolidShape s>() {
    using Basis = SolidBasis<s>;
    for (std::size_t j = 0; j < Basis::nodes.size(); ++j) {
      const auto x = natural_jets(Basis::nodes[j]);
      const auto N = Basis::functions(x[0], x[1], x[2]);
      for (std::size_t i = 0; i < N.size(); ++i) EXPECT_NEAR(N[i].value, i == j ? 1.0 : 0.0, 1e-15);
    }
    const auto x = natural_jets({0.21, 0.34, 0.17});
    Jet sum{};
    for (const Jet& N : Basis::functions(x[0], x[1], x[2])) sum = sum + N;
    EXPECT_NEAR(sum.value, 1.0, 1e-15);
    for (double slope : sum.slope) EXPECT_NEAR(slope, 0.0, 1e-14);
  });
}

TEST_P(Solid, StiffnessIsSymmetricWithExactlySixZeroModes) {
  for (const SolidProperty& property : {steel_like(formats::MassMatrix::consistent), triclinic()})
    for (const Eigen::Matrix3Xd& x : geometries()) {
      const ElementMatrices e = matrices_of(one_solid(GetParam(), x, property));
      EXPECT_EQ((e.S - e.S.transpose()).cwiseAbs().maxCoeff(), 0.0);
      EXPECT_EQ((e.M - e.M.transpose()).cwiseAbs().maxCoeff(), 0.0);
      const double largest = e.S.cwiseAbs().maxCoeff();
      EXPECT_LT((e.S * rigid_motions_of(x)).cwiseAbs().maxCoeff(), 1e-13 * largest);
      const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(e.S).eigenvalues();
      EXPECT_LT(eigenvalues.head<6>().cwiseAbs().maxCoeff(), 1e-13 * eigenvalues.maxCoeff());
      EXPECT_GT(eigenvalues[6], 1e-4 * eigenvalues.maxCoeff()) << solid_name(GetParam());
    }
}

/// ∫ ρ [1 x y z]ᵀ[1 x y z] dV of a tetrahedron in closed form: ρV/20 (Σ x_a x_aᵀ + Σ x_a Σ x_aᵀ) with x_a = [1 x y z].
Eigen::Matrix4d tetrahedron_moments(const Eigen::Matrix<double, 3, 4>& x, double density) {
  Eigen::Matrix4d X;
  X << Eigen::RowVector4d::Ones(), x;
  const double volume = std::abs(X.determinant()) / 6.0;
  const Eigen::Vector4d sum = X.rowwise().sum();
  return density * volume / 20.0 * (X * X.transpose() + sum * sum.transpose());
}

/// The mass matrix between the nodal values of 1, x, y, z.
Eigen::Matrix4d moments_of(const ElementMatrices& e, const Eigen::Matrix3Xd& x) {
  Eigen::MatrixXd fields(x.cols(), 4);
  fields << Eigen::VectorXd::Ones(x.cols()), x.transpose();
  Eigen::MatrixXd m(x.cols(), x.cols());
  for (Eigen::Index a = 0; a < x.cols(); ++a)
    for (Eigen::Index b = 0; b < x.cols(); ++b) m(a, b) = e.M(3 * a, 3 * b);
  return fields.transpose() * m * fields;
}

/// Parallelepipeds: the moments are sums over tetrahedra, known exactly.
TEST_P(Solid, ConsistentMassHasTheMomentsOfTheBody) {
  Eigen::Matrix3d map;
  map << 1.1, 0.2, -0.1, 0.05, 0.8, 0.3, 0.1, -0.2, 1.3;
  const Eigen::Matrix3Xd x = (map * natural_nodes(GetParam())).colwise() + Eigen::Vector3d(0.4, -0.3, 0.2);
  std::vector<std::vector<int>> tetrahedra{{0, 1, 2, 3}};
  if (GetParam() == SolidShape::hexahedron8 || GetParam() == SolidShape::hexahedron20)
    tetrahedra = cell_elements(SolidShape::tetrahedron4, {0, 1, 2, 3, 4, 5, 6, 7});
  if (GetParam() == SolidShape::prism6 || GetParam() == SolidShape::prism15)
    tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}, {2, 3, 4, 5}};
  Eigen::Matrix4d exact = Eigen::Matrix4d::Zero();
  for (const std::vector<int>& t : tetrahedra) {
    Eigen::Matrix<double, 3, 4> corners;
    for (int a = 0; a < 4; ++a) corners.col(a) = x.col(t[a]);
    exact += tetrahedron_moments(corners, 1.7);
  }
  const Mesh mesh = one_solid(GetParam(), x, steel_like(formats::MassMatrix::consistent));
  EXPECT_LT((moments_of(matrices_of(mesh), x) - exact).cwiseAbs().maxCoeff(), 1e-14 * exact.cwiseAbs().maxCoeff());
}

TEST_P(Solid, MassIsPositiveAndLumpingKeepsIt) {
  for (const Eigen::Matrix3Xd& x : geometries()) {
    const ElementMatrices full = matrices_of(one_solid(GetParam(), x, steel_like(formats::MassMatrix::consistent)));
    const ElementMatrices lumped = matrices_of(one_solid(GetParam(), x, steel_like(formats::MassMatrix::lumped)));
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(full.M).eigenvalues()[0], 0.0);
    EXPECT_GT(lumped.M.diagonal().minCoeff(), 0.0);
    EXPECT_TRUE(lumped.M.isDiagonal(0.0));
    EXPECT_NEAR(lumped.M.sum(), full.M.sum(), 1e-14 * full.M.sum());
  }
}

TEST_P(Solid, TurnsWithThePart) {
  const Eigen::Matrix3d R = exp_so3<double>(Eigen::Vector3d(0.7, -1.1, 0.4));
  const SolidProperty property = triclinic();
  SolidProperty turned = property;
  turned.material.C = rotated_elasticity(property.material.C, R);
  for (const Eigen::Matrix3Xd& x : geometries()) {
    const ElementMatrices e = matrices_of(one_solid(GetParam(), x, property));
    const Eigen::Matrix3Xd y = (R * x).colwise() + Eigen::Vector3d(3.0, -2.0, 5.0);
    const ElementMatrices f = matrices_of(one_solid(GetParam(), y, turned));
    Eigen::MatrixXd T = Eigen::MatrixXd::Zero(e.S.rows(), e.S.rows());
    for (Eigen::Index a = 0; a < x.cols(); ++a) T.block<3, 3>(3 * a, 3 * a) = R;
    EXPECT_LT((T * e.S * T.transpose() - f.S).cwiseAbs().maxCoeff(), 1e-13 * e.S.cwiseAbs().maxCoeff());
    EXPECT_LT((T * e.M * T.transpose() - f.M).cwiseAbs().maxCoeff(), 1e-13 * e.M.cwiseAbs().maxCoeff());
  }
}

/// Proper symmetries of the reference element as maps of natural coordinates: hexahedron 24, tetrahedron 12, prism 6.
std::vector<Eigen::Matrix<double, 3, 4>> symmetries(SolidShape shape) {
  std::vector<Eigen::Matrix<double, 3, 4>> maps;
  const Eigen::Matrix3Xd nodes = natural_nodes(shape);
  with_shape(shape, [&]<SolidShape s>() {
    const auto& corner = SolidBasis<s>::nodes;
    const int n = static_cast<int>(SolidBasis<s>::corners);
    // An affine map is known from the images of four corners that are not in one plane.
    const std::array<int, 4> base = n == 8 ? std::array<int, 4>{0, 1, 3, 4} : std::array<int, 4>{0, 1, 2, 3};
    Eigen::Matrix4d X;
    for (int k = 0; k < 4; ++k) X.col(k) << Eigen::Vector3d::Map(corner[base[k]].data()), 1.0;
    const Eigen::Matrix4d inverse = X.inverse();
    for (int image = 0; image < n * n * n * n; ++image) {
      Eigen::Matrix<double, 3, 4> Y;
      for (int k = 0, rest = image; k < 4; ++k, rest /= n) Y.col(k) = nodes.col(rest % n);
      const Eigen::Matrix<double, 3, 4> map = Y * inverse;
      if (map.leftCols<3>().determinant() < 0.5) continue;
      int kept = 0;
      for (int a = 0; a < n; ++a) {
        const Eigen::Vector3d p = map.leftCols<3>() * nodes.col(a) + map.col(3);
        kept += (nodes.leftCols(n).colwise() - p).colwise().norm().minCoeff() < 1e-9;
      }
      if (kept == n && std::abs(map.leftCols<3>().determinant() - 1.0) < 1e-9) maps.push_back(map);
    }
  });
  return maps;
}

TEST_P(Solid, DoesNotDependOnTheNodeItStartsFrom) {
  const Eigen::Matrix3Xd nodes = natural_nodes(GetParam());
  const auto maps = symmetries(GetParam());
  EXPECT_EQ(maps.size(), nodes.cols() % 10 == 4 || nodes.cols() == 10 ? 12U
                         : nodes.cols() == 8 || nodes.cols() == 20    ? 24U
                                                                      : 6U);
  for (const Eigen::Matrix3Xd& x : geometries()) {
    const ElementMatrices e = matrices_of(one_solid(GetParam(), x, triclinic()));
    for (const auto& map : maps) {
      Eigen::Matrix3Xd y = x;
      std::vector<Eigen::Index> from(static_cast<std::size_t>(x.cols()));
      for (Eigen::Index a = 0; a < x.cols(); ++a) {
        const Eigen::Vector3d p = map.leftCols<3>() * nodes.col(a) + map.col(3);
        (nodes.colwise() - p).colwise().norm().minCoeff(&from[a]);
        y.col(a) = x.col(from[a]);
      }
      const ElementMatrices f = matrices_of(one_solid(GetParam(), y, triclinic()));
      double difference = 0.0;
      for (Eigen::Index a = 0; a < x.cols(); ++a)
        for (Eigen::Index b = 0; b < x.cols(); ++b) {
          const Eigen::Index i = from[a], j = from[b];
          difference = std::max(
              {difference, (f.S.block<3, 3>(3 * a, 3 * b) - e.S.block<3, 3>(3 * i, 3 * j)).cwiseAbs().maxCoeff(),
               (f.M.block<3, 3>(3 * a, 3 * b) - e.M.block<3, 3>(3 * i, 3 * j)).cwiseAbs().maxCoeff()});
        }
      EXPECT_LT(difference, 1e-13 * e.S.cwiseAbs().maxCoeff());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Solid, ::testing::ValuesIn(all_solid_shapes),
                         [](const auto& shape) { return solid_name(shape.param); });

}  // namespace
}  // namespace tisserand::reducer::solid_test
