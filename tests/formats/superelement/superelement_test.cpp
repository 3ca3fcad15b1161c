// SPDX-License-Identifier: GPL-3.0-or-later
// Superelements: rigid motions and rigid body against formulas, every rule of check(), rearrangements, the filter.
#include "formats/superelement/superelement.hpp"

#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "common/error.hpp"
#include "tests/support/bodies/beam_superelement.hpp"

namespace tisserand::formats::superelement_test {
namespace {

using test_support::beam_superelement;
using test_support::BeamData;
using test_support::craig_bampton_beam;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string error_of(const Superelement& element) {
  try {
    static_cast<void>(check(element, "part.superelement.h5"));
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// Keeps the rows for which `keep` holds: static condensation is not needed where only the rules are tested.
Superelement keep_rows(const Superelement& element, const std::function<bool(int node, int component)>& keep) {
  std::vector<int> rows;
  for (std::size_t i = 0; i < element.dof_node.size(); ++i)
    if (keep(element.dof_node[i], element.dof_component[i])) rows.push_back(static_cast<int>(i));
  return test_support::permute_rows(element, rows);
}

/// Translations-only or mixed superelement from a list of points: springs between all pairs, point masses at the nodes.
Superelement spring_truss(const std::vector<Eigen::Vector3d>& points, double stiffness, double mass) {
  Superelement e;
  e.name = "truss";
  e.units = Units::si();
  const auto count = static_cast<Eigen::Index>(points.size());
  e.node_position.resize(count, 3);
  e.stiffness.setZero(3 * count, 3 * count);
  e.mass = mass * Eigen::MatrixXd::Identity(3 * count, 3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    e.node_name.push_back(std::string(1, static_cast<char>('a' + i)));
    e.node_position.row(i) = points[i].transpose();
    for (int k = 0; k < 3; ++k) {
      e.dof_node.push_back(static_cast<int>(i));
      e.dof_component.push_back(k);
    }
    for (Eigen::Index j = 0; j < i; ++j) {
      const Eigen::Vector3d d = (points[i] - points[j]).normalized();
      const Eigen::Matrix3d k = stiffness * d * d.transpose();
      e.stiffness.block<3, 3>(3 * i, 3 * i) += k;
      e.stiffness.block<3, 3>(3 * j, 3 * j) += k;
      e.stiffness.block<3, 3>(3 * i, 3 * j) -= k;
      e.stiffness.block<3, 3>(3 * j, 3 * i) -= k;
    }
  }
  return e;
}

TEST(Superelement, RigidMotionsAreTranslationsAndTurnsAboutTheOrigin) {
  Superelement e = spring_truss({{1, 2, 3}, {4, 5, 7}, {0, 1, 0}}, 1.0, 1.0);
  const Eigen::Vector3d origin(0.5, -1, 2);
  const Eigen::MatrixXd R = rigid_motions(e, origin);
  for (int node = 0; node < 3; ++node)
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d X = e.node_position.row(node).transpose() - origin;
      const Eigen::Vector3d expected_turn = Eigen::Vector3d::Unit(k).cross(X);
      EXPECT_EQ((R.block<3, 1>(3 * node, k)), Eigen::Vector3d::Unit(k));
      EXPECT_EQ((R.block<3, 1>(3 * node, 3 + k)), expected_turn);
    }
}

TEST(Superelement, RigidPropertiesOfTheBeamAreThoseOfTheSolid) {
  const BeamData b;
  for (const double shift : {0.0, 1e4}) {
    Superelement e = beam_superelement(b);
    e.node_position.rowwise() += Eigen::RowVector3d(shift, -shift, 3.0);
    const RigidProperties r = rigid_properties(e);
    const double m = b.density * b.area * b.length, L2 = b.length * b.length;
    // Position differences at 1e4 are rounded to 2e-12: relative error of lengths and their squares below 1e-11.
    EXPECT_NEAR(r.mass, m, 1e-14 * m);
    EXPECT_LT((r.center_of_mass - Eigen::Vector3d(shift + 0.5 * b.length, -shift, 3.0)).norm(), 1e-11);
    const Eigen::Vector3d I(b.density * (b.Iy + b.Iz) * b.length, m * L2 / 12 + b.density * b.Iy * b.length,
                            m * L2 / 12 + b.density * b.Iz * b.length);
    EXPECT_LT((r.inertia - Eigen::Matrix3d(I.asDiagonal())).norm(), 1e-11 * m * L2);
  }
}

TEST(Superelement, CheckAcceptsTheBeamInAnyUnitsAndPlace) {
  for (const double length : {1e-6, 1.0, 1e6})
    for (const double force : {1e-9, 1.0, 1e12})
      for (const double mass : {1e-9, 1.0, 1e9}) {
        Superelement e = craig_bampton_beam({}, 8);
        e.units = Units::consistent();
        Eigen::VectorXd to_SI = Eigen::VectorXd::Constant(e.size(), 1.0 / length);  // y_new = y_SI × length
        for (Eigen::Index i = 0; i < e.size(); ++i) {
          const std::size_t row = static_cast<std::size_t>(i);
          if (e.dof_node[row] >= 0 && e.dof_component[row] >= 3) to_SI[i] = 1.0;
          if (e.dof_node[row] < 0) to_SI[i] = std::pow(10.0, e.dof_component[row] - 4);
        }
        const double energy = force * length;
        e.stiffness = (energy * to_SI).asDiagonal() * e.stiffness * to_SI.asDiagonal();
        e.mass = (mass * length * length * to_SI).asDiagonal() * e.mass * to_SI.asDiagonal();
        e.node_position *= length;
        const SuperelementReport report = check(e, "x");
        EXPECT_LT(report.rigid_residual, 1e-12);
        EXPECT_THAT(report.warnings, IsEmpty());
        EXPECT_NEAR(report.characteristic_length, length, 1e-12 * length);
      }
}

TEST(Superelement, OrderOfNodesAndRowsDoesNotMatter) {
  const Superelement e = craig_bampton_beam({}, 4);
  std::vector<int> rows;
  for (int i = 0; i < 16; ++i) rows.push_back((7 * i + 3) % 16);
  const Superelement p = test_support::permute_nodes(test_support::permute_rows(e, rows), {1, 0});
  const SuperelementReport a = check(e, "x"), b = check(p, "x");
  EXPECT_NEAR(a.rigid.mass, b.rigid.mass, 1e-14 * a.rigid.mass);
  EXPECT_LT((a.rigid.center_of_mass - b.rigid.center_of_mass).norm(), 1e-14);
  EXPECT_LT((a.rigid.inertia - b.rigid.inertia).norm(), 1e-14 * a.rigid.inertia.norm());
  EXPECT_LT(b.rigid_residual, 1e-12);
}

TEST(Superelement, TranslationsOnlyAndRotationsOnlyNodesAreAccepted) {
  const Superelement truss = spring_truss({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1e6, 2.0);
  const SuperelementReport report = check(truss, "x");
  EXPECT_NEAR(report.rigid.mass, 8.0, 1e-14 * 8);
  EXPECT_LT((report.rigid.center_of_mass - Eigen::Vector3d(0.25, 0.25, 0.25)).norm(), 1e-15);
  EXPECT_THAT(report.warnings, IsEmpty());
  // A node with rotations alone, attached to node a's corner: a rigid motion turns it, so S and M gain nothing but its
  // own inertia and a rotational spring against the linearised rotation of the triangle is not needed for the rules.
  Superelement mixed = beam_superelement({});
  mixed.node_name.push_back("gyro");
  mixed.node_position.conservativeResize(3, 3);
  mixed.node_position.row(2) << 1, 0, 0;
  mixed.stiffness.conservativeResize(15, 15);
  mixed.mass.conservativeResize(15, 15);
  mixed.stiffness.bottomRows(3).setZero();
  mixed.stiffness.rightCols(3).setZero();
  mixed.mass.bottomRows(3).setZero();
  mixed.mass.rightCols(3).setZero();
  for (int k = 0; k < 3; ++k) {
    mixed.dof_node.push_back(2);
    mixed.dof_component.push_back(3 + k);
    // A torsional spring of 5 N m/rad between the gyro and the base.
    mixed.stiffness(12 + k, 12 + k) = mixed.stiffness(3 + k, 3 + k) + 5.0 - mixed.stiffness(3 + k, 3 + k);
    mixed.stiffness(3 + k, 3 + k) += 5.0;
    mixed.stiffness(12 + k, 3 + k) = mixed.stiffness(3 + k, 12 + k) = -5.0;
    mixed.mass(12 + k, 12 + k) = 0.7;
  }
  const SuperelementReport with_gyro = check(mixed, "x"), alone = check(beam_superelement({}), "x");
  EXPECT_LT(with_gyro.rigid_residual, 1e-12);
  EXPECT_NEAR(with_gyro.rigid.inertia(0, 0) - alone.rigid.inertia(0, 0), 0.7, 1e-13);
}

TEST(Superelement, RigidMotionThatTheBoundaryCannotSeeIsNamed) {
  const auto no_rotations = [](int, int component) { return component < 3; };
  EXPECT_THAT(error_of(keep_rows(beam_superelement({}), no_rotations)), HasSubstr("turns about the line base-tip"));
  const auto no_translations = [](int, int component) { return component >= 3; };
  EXPECT_THAT(error_of(keep_rows(beam_superelement({}), no_translations)), HasSubstr("moves in x, y or z"));
  // Four collinear points in a direction of no axis; the ends are b and c.
  const Eigen::Vector3d d(1, 2, -0.5);
  EXPECT_THAT(error_of(spring_truss({d, -2 * d, 3 * d, 0.5 * d}, 1.0, 1.0)), HasSubstr("turns about the line b-c"));
  EXPECT_THAT(error_of(spring_truss({d}, 1.0, 1.0)), HasSubstr("turns about node a"));
}

TEST(Superelement, SmallRigidResidualIsFilteredByProjection) {
  const Superelement exact = craig_bampton_beam({}, 4);
  Superelement e = exact;
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(e.size(), e.size());
  for (Eigen::Index i = 0; i < 12; ++i)
    for (Eigen::Index j = 0; j < 12; ++j)
      noise(i, j) = std::sin(1.0 + 3.0 * static_cast<double>(i * j)) + (i == j ? 20 : 0);
  noise = (0.5 * (noise + noise.transpose())).eval();
  e.stiffness += 1e-7 * exact.stiffness.cwiseAbs().maxCoeff() / 20 * noise;
  EXPECT_THAT(error_of(e), HasSubstr("resists rigid-body motion"));
  filter_rigid_motions(e);
  EXPECT_LT(check(e, "x").rigid_residual, 1e-14);
  EXPECT_EQ((e.stiffness - e.stiffness.transpose()).norm(), 0.0);
  // The projection removes no more than the noise has added, whose norm bounds the change.
  EXPECT_LT((e.stiffness - exact.stiffness).norm(), 1e-5 * exact.stiffness.norm());
}

struct BadSuperelement {
  std::string name;
  std::function<void(Superelement&)> spoil;
  std::string dataset;
  std::string message;
};

std::ostream& operator<<(std::ostream& out, const BadSuperelement& bad) { return out << bad.name; }

class SpoiledSuperelement : public ::testing::TestWithParam<BadSuperelement> {};

TEST_P(SpoiledSuperelement, IsRejectedWithDatasetValueAndMeaning) {
  Superelement e = craig_bampton_beam({}, 2);  // rows 0-5 base, 6-11 tip, 12, 13 internal
  ASSERT_EQ(error_of(e), "no error");
  GetParam().spoil(e);
  EXPECT_THAT(error_of(e),
              AllOf(HasSubstr("part.superelement.h5: "), HasSubstr(GetParam().dataset), HasSubstr(GetParam().message)));
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<BadSuperelement> bad_superelements() {
  return {
      BadSuperelement{"NegativeUnit", [](Superelement& e) { e.units.mass.factor = -1; }, "mass_unit", "is -1"},
      BadSuperelement{"NanUnit", [](Superelement& e) { e.units.time.factor = nan; }, "time_unit", "is nan"},
      BadSuperelement{"HalfNamedUnits", [](Superelement& e) { e.units.time.factor = 0; }, "time_unit",
                      "but length_unit is 1"},
      BadSuperelement{"LabelContradictsFactor", [](Superelement& e) { e.units.length.label = "mm"; }, "length_unit",
                      "label 'mm' means 0.001"},
      BadSuperelement{"NoNodes", [](Superelement& e) { e.node_name.clear(); }, "/boundary/name", "no boundary node"},
      BadSuperelement{"NoCoordinates", [](Superelement& e) { e.dof_node.clear(); }, "/dof/node", "no coordinates"},
      BadSuperelement{"ShortTable", [](Superelement& e) { e.dof_component.pop_back(); }, "/dof/component",
                      "has 13 entries, but /dof/node has 14"},
      BadSuperelement{"Positions", [](Superelement& e) { e.node_position.conservativeResize(1, 3); },
                      "/boundary/position", "has 1 rows, but /boundary/name has 2 names"},
      BadSuperelement{"StiffnessShape", [](Superelement& e) { e.stiffness.conservativeResize(13, 14); }, "/stiffness",
                      "shape 13 x 14, expected 14 x 14"},
      BadSuperelement{"MassShape", [](Superelement& e) { e.mass.conservativeResize(14, 1); }, "/mass",
                      "shape 14 x 1, expected 14 x 14"},
      BadSuperelement{"EmptyName", [](Superelement& e) { e.node_name[1].clear(); }, "/boundary/name", "entry 1 is ''"},
      BadSuperelement{"NameWithSlash", [](Superelement& e) { e.node_name[0] = "a/b"; }, "/boundary/name", "'a/b'"},
      BadSuperelement{"NameTwice", [](Superelement& e) { e.node_name[1] = "base"; }, "/boundary/name", "earlier node"},
      BadSuperelement{"NodeNumber", [](Superelement& e) { e.dof_node[3] = 2; }, "/dof/node", "entry 3 is 2"},
      BadSuperelement{"NodeBelow", [](Superelement& e) { e.dof_node[3] = -2; }, "/dof/node", "entry 3 is -2"},
      BadSuperelement{"Component", [](Superelement& e) { e.dof_component[3] = 6; }, "/dof/component", "entry 3 is 6"},
      BadSuperelement{"InternalNumber", [](Superelement& e) { e.dof_component[13] = 2; }, "/dof/component",
                      "entry 13 is 2, expected the number 0 to 1"},
      BadSuperelement{"Duplicate", [](Superelement& e) { e.dof_component[3] = 4; }, "/dof/component",
                      "rows 3 and 4 are the same coordinate: row 4 (node 'base', rotation y)"},
      BadSuperelement{"TwoRotations",
                      [](Superelement& e) { e = keep_rows(e, [](int n, int c) { return n != 1 || c != 4; }); },
                      "/dof/component", "node 'tip' has 3 translations and 2 rotations"},
      BadSuperelement{"NodeWithoutRows", [](Superelement& e) { e = keep_rows(e, [](int n, int) { return n != 1; }); },
                      "/dof/component", "node 'tip' has 0 translations and 0 rotations"},
      BadSuperelement{"NanPosition", [](Superelement& e) { e.node_position(1, 2) = nan; }, "/boundary/position",
                      "[1, 2] = nan is not a usable number: z of node 'tip'"},
      BadSuperelement{"NanStiffness", [](Superelement& e) { e.stiffness(2, 7) = nan; }, "/stiffness",
                      "[2, 7] = nan is not a usable number: row 2 (node 'base', translation z)"},
      BadSuperelement{"InfiniteMass", [](Superelement& e) { e.mass(13, 0) = infinity; }, "/mass",
                      "[13, 0] = inf is not a usable number: row 13 (internal coordinate 1)"},
      BadSuperelement{"HugeStiffness", [](Superelement& e) { e.stiffness(0, 0) = 1e300; }, "/stiffness",
                      "[0, 0] = 1e+300"},
      BadSuperelement{"AsymmetricStiffness", [](Superelement& e) { e.stiffness(1, 5) *= 1.001; }, "/stiffness",
                      "is not symmetric: [1, 5]"},
      BadSuperelement{"AsymmetricMass", [](Superelement& e) { e.mass(0, 12) += 0.1; }, "/mass",
                      "is not symmetric: [0, 12]"},
      BadSuperelement{"GroundedStiffness", [](Superelement& e) { e.stiffness(6, 6) *= 1.001; }, "/stiffness",
                      "resists rigid-body motion: moving in x"},
      BadSuperelement{"NegativeStiffness", [](Superelement& e) { e.stiffness *= -1; }, "/stiffness",
                      "not positive semidefinite"},
      BadSuperelement{"NegativeInternalStiffness", [](Superelement& e) { e.stiffness(12, 12) *= -1; }, "/stiffness",
                      "not positive semidefinite: [12, 12]"},
      BadSuperelement{"IndefiniteStiffness",
                      [](Superelement& e) { e.stiffness(12, 13) = e.stiffness(13, 12) = 2 * e.stiffness(13, 13); },
                      "/stiffness", "not positive semidefinite: scaled eigenvalue"},
      BadSuperelement{"IndefiniteMass", [](Superelement& e) { e.mass(12, 13) = e.mass(13, 12) = 1.01; }, "/mass",
                      "not positive semidefinite: scaled eigenvalue"},
      BadSuperelement{"NegativeMass", [](Superelement& e) { e.mass *= -1; }, "/mass", "not positive semidefinite"},
      BadSuperelement{"NoMass", [](Superelement& e) { e.mass.setZero(); }, "/mass", "rigid-body mass of the part is 0"},
      BadSuperelement{"MassOfOneDirection", [](Superelement& e) { e.mass(1, 1) += 1.0; }, "/mass",
                      "not the same in all directions"},
      BadSuperelement{"TriangleInequality", [](Superelement& e) { e.mass(3, 3) += 1e3; }, "/mass",
                      "no real body has the principal moments of inertia"},
      BadSuperelement{"MirroredRotations",
                      [](Superelement& e) {
                        for (const int row : {5, 11}) {
                          e.mass.row(row) *= -1;
                          e.mass.col(row) *= -1;
                        }
                      },
                      "/mass", "is"}};
}

INSTANTIATE_TEST_SUITE_P(Rules, SpoiledSuperelement, ::testing::ValuesIn(bad_superelements()),
                         [](const ::testing::TestParamInfo<BadSuperelement>& test) { return test.param.name; });

TEST(Superelement, ZeroAxialInertiaIsAWarningThatNamesTheAxis) {
  BeamData round;
  round.Iz = round.Iy;
  Superelement e = beam_superelement(round);
  for (const int row : {3, 9}) {
    e.mass.row(row).setZero();
    e.mass.col(row).setZero();
  }
  const SuperelementReport report = check(e, "x");
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_THAT(report.warnings[0], HasSubstr("no inertia about the axis (1, 0, 0)"));
}

TEST(Superelement, PrincipalMomentsThatSlightlyBreakTheTriangleAreAWarning) {
  // Without torsional inertia, moments 0, m L²/12 + ρ Iy L, m L²/12 + ρ Iz L break it by ρ (Iz − Iy) L / (m L²/12) =
  // 4e-5.
  Superelement e = beam_superelement({});
  for (const int row : {3, 9}) {
    e.mass.row(row).setZero();
    e.mass.col(row).setZero();
  }
  const SuperelementReport report = check(e, "x");
  ASSERT_EQ(report.warnings.size(), 2u);
  EXPECT_THAT(report.warnings[0], HasSubstr("no real body has the principal moments of inertia"));
}

TEST(Superelement, OneNodeWithInternalModesIsJudgedByItsFrequencies) {
  Superelement e;  // a rigid block of 2 kg with one mode of 100 rad/s that does not move the block
  e.name = "block";
  e.units = Units::si();
  e.node_name = {"only"};
  e.node_position.setZero(1, 3);
  e.dof_node = {0, 0, 0, 0, 0, 0, -1};
  e.dof_component = {0, 1, 2, 3, 4, 5, 0};
  e.mass = Eigen::VectorXd{{2, 2, 2, 0.1, 0.1, 0.1, 1}}.asDiagonal();
  e.stiffness.setZero(7, 7);
  e.stiffness(6, 6) = 1e4;
  EXPECT_EQ(check(e, "x").rigid_residual, 0.0);
  e.stiffness(0, 0) = 1e-8;  // rounding of a reduction, against 2 kg × (100 rad/s)²
  EXPECT_LT(check(e, "x").rigid_residual, 1e-11);
  e.stiffness(0, 0) = 100;
  EXPECT_THAT(error_of(e), HasSubstr("resists rigid-body motion: moving in x"));
}

TEST(Superelement, ContentIdDependsOnEveryFieldOfTheContents) {
  const Superelement e = craig_bampton_beam({}, 2);
  const std::string id = content_id(e);
  EXPECT_EQ(id.size(), 64u);
  const std::vector<std::function<void(Superelement&)>> changes{
      [](Superelement& s) { s.node_name[0] = "root"; },
      [](Superelement& s) { s.node_position(1, 0) = std::nextafter(s.node_position(1, 0), 9); },
      [](Superelement& s) { std::swap(s.dof_node[0], s.dof_node[6]); },
      [](Superelement& s) { std::swap(s.dof_component[0], s.dof_component[1]); },
      [](Superelement& s) { s.stiffness(3, 4) = -s.stiffness(3, 4); },
      [](Superelement& s) { s.mass(13, 13) = std::nextafter(1.0, 2.0); }};
  for (const auto& change : changes) {
    Superelement other = e;
    change(other);
    EXPECT_NE(content_id(other), id);
  }
  Superelement renamed = e;
  renamed.name = "other";
  renamed.producer = "other";
  EXPECT_EQ(content_id(renamed), id);
}

}  // namespace
}  // namespace tisserand::formats::superelement_test
