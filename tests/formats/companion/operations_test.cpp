// SPDX-License-Identifier: GPL-3.0-or-later
// Load-time operations on companions against companions computed anew by their definitions, and against one another.
#include "formats/companion/operations.hpp"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "formats/superelement/mirror.hpp"
#include "tests/support/bodies/second_order_network.hpp"

namespace tisserand::formats::companion_operations_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using test_support::SecondOrderBody;

const Eigen::Vector4d weights(0.1, 0.2, 0.3, 0.4);
constexpr int boundary_rows = 12;

MatrixXd rigid(const SecondOrderBody& body) { return rigid_motions(body.element, body.companion.reference_point); }

/// Relative to the largest entry of `b`: arrays of round-off alone do not occur in the network.
void expect_near(const MatrixXd& a, const MatrixXd& b, const std::string& what) {
  ASSERT_EQ(a.rows(), b.rows()) << what;
  ASSERT_EQ(a.cols(), b.cols()) << what;
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 2e-12 * b.cwiseAbs().maxCoeff()) << what;
}

void expect_near(const Companion& a, const Companion& b) {
  expect_near(a.reference_point, b.reference_point, "reference_point");
  expect_near(MatrixXd::Constant(1, 1, a.mass), MatrixXd::Constant(1, 1, b.mass), "mass");
  expect_near(a.S0, b.S0, "S0");
  expect_near(a.S1, b.S1, "S1");
  ASSERT_EQ(a.H.size(), b.H.size());
  for (std::size_t j = 0; j < a.H.size(); ++j) expect_near(a.H[j], b.H[j], "H" + std::to_string(j));
  for (int k = 0; k < 3; ++k) expect_near(a.C[k], b.C[k], "C" + std::to_string(k));
  for (int i = 0; i < 6; ++i) {
    expect_near(a.E[i], b.E[i], "E" + std::to_string(i));
    expect_near(a.N[i], b.N[i], "N" + std::to_string(i));
    expect_near(a.T[i], b.T[i], "T" + std::to_string(i));
  }
  ASSERT_EQ(a.load_cases.size(), b.load_cases.size());
  for (std::size_t i = 0; i < a.load_cases.size(); ++i) {
    expect_near(a.load_cases[i].force, b.load_cases[i].force, "force");
    expect_near(a.load_cases[i].stiffness, b.load_cases[i].stiffness, "stiffness");
  }
}

TEST(CompanionOperations, DroppedModesFollowQuasiStatically) {
  const SecondOrderBody full = test_support::second_order_network(5, weights);
  for (const int modes : {0, 2, 4}) {
    const SecondOrderBody reduced = test_support::second_order_network(modes, weights);
    Companion cut = full.companion;
    std::vector<int> rows;
    for (int k = modes; k < 5; ++k) rows.push_back(boundary_rows + k);
    drop_modes(cut, full.element.mass, rigid(full), rows, full.omega_squared.tail(5 - modes));
    expect_near(cut, reduced.companion);
  }
}

TEST(CompanionOperations, ReferenceMovesWithTheWeights) {
  const SecondOrderBody body = test_support::second_order_network(2, weights);
  const SecondOrderBody other = test_support::second_order_network(2, Eigen::Vector4d(0.7, -0.3, 0.5, 0.1));
  Companion moved = body.companion;
  move_reference(moved, other.companion.reference_point);
  expect_near(moved, other.companion);
}

// Masses of the network move alike in all directions: R_Tᵀ C_k = e_k x S1 as it is. A defect put into C goes, and with
// it E stays that of a Gram matrix.
TEST(CompanionOperations, GalileanStepMakesMomentaTurnAsVectors) {
  const SecondOrderBody body = test_support::second_order_network(2, weights);
  const MatrixXd R = rigid(body);
  Companion same = body.companion;
  galilean_step(same, body.element.mass, R);
  expect_near(same, body.companion);

  const Eigen::Index n = body.element.size();
  const MatrixXd momentum = body.element.mass * R.leftCols<3>() / body.companion.mass;
  Companion spoiled = body.companion;
  std::array<MatrixXd, 3> P, d;
  for (int k = 0; k < 3; ++k) {
    P[k] = R.leftCols<3>().transpose() * spoiled.C[k];
    d[k] = 0.01 *
           MatrixXd::NullaryExpr(3, n, [k](Eigen::Index i, Eigen::Index j) { return std::sin(1.0 + i + 2.0 * j + k); });
    spoiled.C[k] += momentum * d[k];
  }
  for (int pair = 0; pair < 6; ++pair) {  // the velocities that such a C belongs to: Ω x Φ y + D_T d y/m
    const auto [j, k] = axis_pairs[pair];
    const MatrixXd X = P[j].transpose() * d[k] + d[j].transpose() * P[k] + d[j].transpose() * d[k];
    spoiled.E[pair] += 0.5 / spoiled.mass * (X + X.transpose());
  }
  check(spoiled, body.element, "spoiled");
  galilean_step(spoiled, body.element.mass, R);
  expect_near(spoiled, body.companion);
}

/// Two thirds of a rotation of coordinates and a mixture of the modes.
TEST(CompanionOperations, CongruenceIsThatOfTheBasis) {
  const SecondOrderBody body = test_support::second_order_network(3, weights);
  const Eigen::Index n = body.element.size();
  const auto random = [n](double phase) {
    return MatrixXd::NullaryExpr(
        n, n, [phase](Eigen::Index i, Eigen::Index j) { return std::sin(phase + 3.0 * i + 7.0 * j * j); });
  };
  const MatrixXd A = random(0.3).leftCols(n - 2);
  Companion turned = body.companion;
  congruence(turned, A);
  const Eigen::VectorXd y = random(1.1).col(0).head(n - 2), Ay = A * y;
  const auto form = [](const MatrixXd& matrix, const Eigen::VectorXd& v) { return v.dot(matrix * v); };
  const auto cubic = [&](const Companion& c, const Eigen::VectorXd& v) {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < v.size(); ++j) sum += v[j] * form(c.H[j], v);
    return sum;
  };
  EXPECT_NEAR(cubic(turned, y) / cubic(body.companion, Ay), 1.0, 1e-11);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(form(turned.E[i], y) / form(body.companion.E[i], Ay), 1.0, 1e-11);
    EXPECT_NEAR(form(turned.N[i], y) / form(body.companion.N[i], Ay), 1.0, 1e-11);
    EXPECT_NEAR(form(turned.T[i], y) / form(body.companion.T[i], Ay), 1.0, 1e-11);
  }
  const Eigen::VectorXd z = random(2.0).col(1).head(n - 2), Az = A * z;
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(z.dot(turned.C[k] * y) / Az.dot(body.companion.C[k] * Ay), 1.0, 1e-11);
  expect_near(turned.S1 * y, body.companion.S1 * Ay, "S1");
  EXPECT_NEAR(turned.load_cases[0].force.dot(y) / body.companion.load_cases[0].force.dot(Ay), 1.0, 1e-11);
  EXPECT_NEAR(form(turned.load_cases[0].stiffness, y) / form(body.companion.load_cases[0].stiffness, Ay), 1.0, 1e-11);
}

// [ẏᵀ W_k y] is an angular momentum: the same in all coordinates, an axial vector in a mirror, and dropped modes take
// their rows alone.
TEST(CompanionOperations, RelativeTurnsAreAnAngularMomentum) {
  SecondOrderBody body = test_support::second_order_network(3, weights);
  body.companion.load_cases.clear();
  const Eigen::Index n = body.element.size();
  for (int k = 0; k < 3; ++k) {
    const MatrixXd A = MatrixXd::NullaryExpr(
        n, n, [k](Eigen::Index i, Eigen::Index j) { return std::sin(1.0 + k + 3.0 * i + 7.0 * j * j); });
    body.companion.W[k] = A - A.transpose();
  }
  const auto momentum = [](const Companion& c, const Eigen::VectorXd& yd, const Eigen::VectorXd& y) {
    return Vector3d(yd.dot(c.W[0] * y), yd.dot(c.W[1] * y), yd.dot(c.W[2] * y));
  };
  const Eigen::VectorXd y = Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index i) { return std::sin(1.0 + 3.0 * i); }),
                        yd = y.reverse();
  const Vector3d expected = momentum(body.companion, yd, y);

  Companion turned = body.companion;
  const MatrixXd A = MatrixXd::Identity(n, n) + 0.1 * y * y.reverse().transpose();
  congruence(turned, A);
  const Eigen::PartialPivLU<MatrixXd> inverse(A);
  EXPECT_LT((momentum(turned, inverse.solve(yd), inverse.solve(y)) - expected).norm(), 1e-11 * expected.norm());

  Companion cut = body.companion;
  drop_modes(cut, body.element.mass, rigid(body), {boundary_rows + 2}, body.omega_squared.tail(1));
  EXPECT_EQ(cut.W[1], body.companion.W[1].topLeftCorner(n - 1, n - 1));

  Companion image = body.companion;
  const Vector3d axes(1, -1, 1), axial = axes.prod() * axes;
  mirror(image, axes, mirrored(LoadedSuperelement{body.element, {}}, axes).superelement);
  Eigen::VectorXd seen = y, seen_rate = yd;
  for (Eigen::Index row = 0; row < boundary_rows; ++row) {
    seen[row] *= axes[body.element.dof_component[row]];
    seen_rate[row] *= axes[body.element.dof_component[row]];
  }
  EXPECT_LT((momentum(image, seen_rate, seen) - expected.cwiseProduct(axial)).norm(), 1e-12 * expected.norm());

  const UnitConversion units{1000.0, 0.001, 500.0};
  Companion converted = body.companion;
  std::vector<bool> translation;
  for (const int node : body.element.dof_node) translation.push_back(node >= 0);
  convert(converted, units, translation);
  Eigen::VectorXd other = y, other_rate = yd;
  other.head(boundary_rows) *= units.length;
  other_rate.head(boundary_rows) *= units.length;
  EXPECT_LT((momentum(converted, other_rate, other) - 1e3 * expected).norm(), 1e-9 * expected.norm());

  Companion moved = body.companion;
  move_reference(moved, Vector3d(0.3, -0.2, 0.7));
  galilean_step(moved, body.element.mass, rigid(body));
  EXPECT_EQ(moved.W, body.companion.W);
}

// ½ Σ (½ yᵀΛy)² is an energy of the motion: the same in all coordinates, units, and in a mirror, and dropped modes do
// not change that of the others.
TEST(CompanionOperations, TrappedStressHasTheSameEnergyInAllCoordinates) {
  SecondOrderBody body = test_support::second_order_network(3, weights);
  body.companion.load_cases.clear();
  const MatrixXd& S = body.element.stiffness;
  body.companion.Lambda = {S * S / S.norm(), S * body.element.mass * S / S.norm()};
  const Eigen::Index n = S.rows();
  const auto energy = [](const Companion& c, const Eigen::VectorXd& y) {
    double sum = 0.0;
    for (const MatrixXd& Lambda : c.Lambda) sum += 0.125 * std::pow(y.dot(Lambda * y), 2);
    return sum;
  };
  const Eigen::VectorXd y = Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index i) { return std::sin(1.0 + 3.0 * i); });
  const double expected = energy(body.companion, y);

  Companion turned = body.companion;
  const MatrixXd A = MatrixXd::Identity(n, n) + 0.1 * y * y.reverse().transpose();
  congruence(turned, A);
  EXPECT_NEAR(energy(turned, A.partialPivLu().solve(y)) / expected, 1.0, 1e-11);

  Eigen::VectorXd kept = y;
  kept.tail(2).setZero();
  Companion cut = body.companion;
  drop_modes(cut, body.element.mass, rigid(body), {boundary_rows + 1, boundary_rows + 2}, body.omega_squared.tail(2));
  EXPECT_NEAR(energy(cut, kept.head(n - 2)) / energy(body.companion, kept), 1.0, 1e-12);

  Companion image = body.companion;
  const Vector3d axes(1, -1, 1);
  mirror(image, axes, mirrored(LoadedSuperelement{body.element, {}}, axes).superelement);
  Eigen::VectorXd seen = y;
  for (Eigen::Index row = 0; row < boundary_rows; ++row) seen[row] *= axes[body.element.dof_component[row]];
  EXPECT_NEAR(energy(image, seen) / expected, 1.0, 1e-12);

  const UnitConversion units{1000.0, 0.001, 500.0};
  Companion converted = body.companion;
  std::vector<bool> translation;
  for (const int node : body.element.dof_node) translation.push_back(node >= 0);
  convert(converted, units, translation);
  Eigen::VectorXd other = y;
  other.head(boundary_rows) *= units.length;
  EXPECT_NEAR(energy(converted, other) / expected, 0.001 * 1e6 / (500.0 * 500.0), 1e-12);
}

TEST(CompanionOperations, MirrorImageIsTheCompanionOfTheImage) {
  using enum test_support::Keep;
  SecondOrderBody body = test_support::second_order_network(3, weights);
  body.companion.load_cases.clear();  // its full vector is not mirrored with the network
  for (const Vector3d& axes : {Vector3d(-1, 1, 1), Vector3d(1, -1, -1), Vector3d(-1, -1, -1)}) {
    SecondOrderBody expected = test_support::second_order_network(test_support::mirrored_network(axes),
                                                                  {all, all, all, all, nothing, nothing}, 3, weights);
    expected.companion.load_cases.clear();
    Companion image = body.companion;
    const LoadedSuperelement mirrored_file = mirrored(LoadedSuperelement{body.element, {}}, axes);
    mirror(image, axes, mirrored_file.superelement);
    check(image, mirrored_file.superelement, "image");
    // Signs of modes are the eigensolver's: those of the expected image are turned to those of the mirrored file.
    MatrixXd sign = MatrixXd::Identity(body.element.size(), body.element.size());
    for (Eigen::Index k = boundary_rows; k < sign.rows(); ++k)
      if (expected.element.mass.row(k)
              .head(boundary_rows)
              .dot(mirrored_file.superelement.mass.row(k).head(boundary_rows)) < 0.0)
        sign(k, k) = -1.0;
    congruence(expected.companion, sign);
    expect_near(image, expected.companion);
  }
}

// The network in millimetres, tonnes and milliseconds, reduced there.
TEST(CompanionOperations, UnitsAreThoseOfAModelInOtherUnits) {
  const SecondOrderBody body = test_support::second_order_network(2, weights);
  const UnitConversion units{1000.0, 0.001, 500.0};
  test_support::FullModel model = test_support::spring_network();
  model.position *= units.length;
  model.M *= units.mass;
  model.S *= units.mass / (units.time * units.time);
  using enum test_support::Keep;
  SecondOrderBody expected =
      test_support::second_order_network(model, {all, all, all, all, nothing, nothing}, 2, weights);
  Companion converted = body.companion;
  std::vector<bool> translation;
  for (const int node : body.element.dof_node) translation.push_back(node >= 0);
  convert(converted, units, translation);
  // Internal coordinates of unit modal mass have the unit of sqrt(mass) length: those of the file keep their numbers.
  MatrixXd scale = MatrixXd::Identity(body.element.size(), body.element.size());
  for (Eigen::Index k = boundary_rows; k < scale.rows(); ++k) scale(k, k) = std::sqrt(units.mass) * units.length;
  congruence(expected.companion, scale);
  converted.load_cases.clear();
  expected.companion.load_cases.clear();  // its full vector is one of numbers
  expect_near(converted, expected.companion);
}

}  // namespace
}  // namespace tisserand::formats::companion_operations_test
