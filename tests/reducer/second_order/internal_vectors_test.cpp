// SPDX-License-Identifier: GPL-3.0-or-later
// Companions whose internal coordinates are no fixed-boundary modes: moment vectors and Rubin's; and methods and ties
// that have no second order, told by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "formats/companion/operations.hpp"
#include "reducer/report/certificate.hpp"
#include "reducer/second_order/companion.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/second_order/reduced_part.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::testing::internal_vectors_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::Companion;
using formats::ReductionMethod;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

reducer::Mesh frame() { return reducer::build_mesh(space_frame(0)); }

formats::ModeSelection selection(int modes, int moments, ReductionMethod method) {
  formats::ModeSelection chosen;
  chosen.count = modes;
  if (moments > 0) chosen.moments = moments;
  chosen.method = method;
  return chosen;
}

/// Without the internal coordinates behind the first `kept`.
Companion dropped(const ReducedPart& part, int kept) {
  Companion c = part.companion;
  const Index boundary = 18, n = part.element.size();
  std::vector<int> rows;
  for (Index k = boundary + kept; k < n; ++k) rows.push_back(static_cast<int>(k));
  const VectorXd omega2 = part.element.stiffness.diagonal()(rows);
  formats::drop_modes(c, part.element.mass, formats::rigid_motions(part.element, c.reference_point), rows, omega2);
  return c;
}

template <class Arrays>
void expect_arrays(const Arrays& found, const Arrays& expected, const std::string& what) {
  double size = 0.0, error = 0.0;
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    size = std::max(size, expected[i].cwiseAbs().maxCoeff());
    error = std::max(error, (found[i] - expected[i]).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(error, 1e-8 * size) << what;
}

void expect_companion(const Companion& found, const Companion& expected) {
  expect_arrays(found.H, expected.H, "H");
  expect_arrays(found.C, expected.C, "C");
  expect_arrays(found.E, expected.E, "E");
  expect_arrays(found.N, expected.N, "N");
  expect_arrays(found.T, expected.T, "T");
}

// Internal coordinates of any kind carry their own share of w_g, so that without them the file is that of a reduction
// that never had them.
TEST(CompanionVectors, OfMomentsAndOfRubinDropToTheModesBelowThem) {
  const Companion guyan = reduce_with_companion(frame(), 0).companion,
                  modes = reduce_with_companion(frame(), 3).companion;
  const ReducedPart moments = reduce_with_companion(frame(), selection(3, 6, ReductionMethod::craig_bampton));
  ASSERT_GT(moments.element.size(), 18 + 3);
  expect_companion(dropped(moments, 3), modes);
  expect_companion(dropped(moments, 0), guyan);
  const ReducedPart rubin = reduce_with_companion(frame(), selection(4, 0, ReductionMethod::rubin));
  ASSERT_GT(rubin.element.size(), 18 + 4);
  expect_companion(dropped(rubin, 0), guyan);
}

double largest(const std::array<MatrixXd, 6>& arrays) {
  double value = 0.0;
  for (const MatrixXd& A : arrays) value = std::max(value, A.cwiseAbs().maxCoeff());
  return value;
}

// What the nodes inside do under accelerations of the rigid part is spanned by all moment vectors, and by the inertia
// relief of Rubin's method. N, which has it in Guyan's reduction, then holds what the insides of the elements do between
// held nodes, the same for both where the modes are: it falls with the square of their length, and that of translations
// with it.
TEST(CompanionVectors, ThatHoldInertiaReliefLeaveToNTheInsidesOfElements) {
  const double guyan = largest(reduce_with_companion(frame(), 0).companion.N);
  formats::Part finer = space_frame(0);
  for (formats::BeamLine& beam : finer.beams) beam.elements *= 2;
  for (const auto& chosen :
       {selection(2, 18, ReductionMethod::craig_bampton), selection(3, 0, ReductionMethod::rubin)}) {
    const double left = largest(reduce_with_companion(frame(), chosen).companion.N);
    EXPECT_LT(left, 2e-3 * guyan);
    EXPECT_NEAR(largest(reduce_with_companion(reducer::build_mesh(finer), chosen).companion.N), left / 4.0, left / 16.0);
  }
  EXPECT_GT(largest(reduce_with_companion(frame(), selection(2, 2, ReductionMethod::craig_bampton)).companion.N),
            1e-4 * guyan);
}

// Rows of Rubin's vectors and moment vectors in other coordinates: the file stays one that is accepted, and the energy
// of the stress of any w is the same.
TEST(CompanionVectors, KeepTheirEnergyInOtherCoordinates) {
  for (const auto& chosen :
       {selection(2, 6, ReductionMethod::craig_bampton), selection(3, 0, ReductionMethod::rubin)}) {
    const ReducedPart part = reduce_with_companion(frame(), chosen);
    const Index n = part.element.size(), internal = n - 18;
    MatrixXd A = MatrixXd::Identity(n, n);  // turns the internal coordinates among themselves
    for (Index i = 0; i < internal; ++i)
      for (Index j = 0; j < internal; ++j) A(18 + i, 18 + j) += 0.3 * std::sin(1.0 + double(3 * i + 7 * j));
    ReducedPart turned = part;
    turned.element.stiffness = A.transpose() * part.element.stiffness * A;
    turned.element.mass = A.transpose() * part.element.mass * A;
    turned.element.content_id = turned.companion.content_id = formats::content_id(turned.element);
    formats::congruence(turned.companion, A);
    formats::check(turned.companion, turned.element, "turned");
    const VectorXd y = VectorXd::LinSpaced(n, -1.0, 2.0), Ay = A * y;
    const double energy = Ay.dot(stress_stiffness(part.companion, Ay) * Ay);
    EXPECT_NEAR(y.dot(stress_stiffness(turned.companion, y) * y), energy, 1e-10 * std::abs(energy));
  }
}

TEST(CompanionNotes, SayThatMacNealsMassHasNone) {
  formats::Part part = cardona_beam(6, 2);
  part.modes.method = ReductionMethod::macneal;
  for (const auto wanted : {formats::SecondOrder::yes, formats::SecondOrder::unless_large, formats::SecondOrder::no}) {
    part.second_order = wanted;
    part.load_cases.clear();
    const reducer::Reduction without = reduce(part);
    EXPECT_FALSE(without.companion.has_value());
    const std::string notes = ::testing::PrintToString(without.model.notes);
    if (wanted == formats::SecondOrder::no)
      EXPECT_THAT(notes, ::testing::Not(HasSubstr("second order")));
    else
      EXPECT_THAT(notes, ::testing::AllOf(
                             HasSubstr("No second order (stiffening, exact inertia) was written to a companion file"),
                             HasSubstr("method: macneal"), HasSubstr("method: craig_bampton or method: rubin")));
    part.load_cases.emplace_back();
    part.load_cases[0].name = "fall";
    part.load_cases[0].gravity = Vector3d(0, 0, -9.81);
    const reducer::Reduction loaded = reduce(part);
    ASSERT_TRUE(loaded.companion.has_value());
    EXPECT_FALSE(loaded.companion->has_second_order());
  }
}

TEST(CompanionNotes, NameTheTiesWhoseSecondOrderIsLeftOut) {
  reducer::Mesh mesh = frame();
  reducer::Spider mean;
  mean.name = "mean";
  mean.kind = reducer::SpiderKind::averaging;
  mean.node_components = reducer::Components{0b000100};
  mesh.spiders = {mean};
  mean.name = "whole";
  mean.node_components = reducer::translations_only;
  mesh.spiders.push_back(mean);
  reducer::TieEquation equation;
  equation.name = "slot";
  mesh.equations = {equation};
  formats::Superelement element;
  element.node_position.setZero(2, 3);
  element.dof_node.assign(12, 0);
  reducer::ModelCertificate model;
  reducer::describe_companion(mesh, {}, element, model);
  EXPECT_THAT(model.warnings,
              ElementsAre(::testing::AllOf(HasSubstr("the second order of spider 'mean', equation 'slot'"),
                                           HasSubstr("The companion file omits"))));
}

// A piece that swings on a hinge inside has no stress under a unit load there: the reduction ends before the companion.
TEST(CompanionErrors, MechanismsInsideThePartAreNamed) {
  reducer::Mesh mesh = frame();
  mesh.beams.back().released = 1 << 4 | 1 << 5;  // the last piece of the whip, at its first end
  EXPECT_THAT(test_support::error_of([&] { reduce_with_companion(mesh, 2); }),
              ::testing::AllOf(HasSubstr("the part has 2 motion(s) without stiffness while its boundary is held"),
                               HasSubstr("end turns about"), HasSubstr("hold these nodes at the boundary")));
}

// A straight line of point masses has no inertia about its axis: the file is accepted, and N of that turn vanishes.
TEST(CompanionErrors, NoInertiaAboutAnAxisIsNoError) {
  reducer::Mesh mesh = reducer::build_mesh(plain_beam(Vector3d::Zero(), Vector3d(1, 0, 0), 6, 3));
  mesh.beam_properties[0].data.material.density = 0.0;
  for (int node = 0; node < mesh.nodes(); ++node) {
    reducer::NodalMass mass;
    mass.node = node;
    mass.mass = 1.0 + 0.2 * node;
    mesh.masses.push_back(mass);
  }
  const ReducedPart part = reduce_with_companion(mesh, 3);
  const Companion& c = part.companion;
  const MatrixXd R = formats::rigid_motions(part.element, c.reference_point);
  const MatrixXd J = R.transpose() * part.element.mass * R;
  EXPECT_LT(J(3, 3), 1e-12 * J(4, 4));
  EXPECT_LT(c.N[3].cwiseAbs().maxCoeff(), 1e-9 * c.N[4].cwiseAbs().maxCoeff());
  EXPECT_GT(c.N[4].cwiseAbs().maxCoeff(), 0.0);
}

}  // namespace
}  // namespace tisserand::testing::internal_vectors_test
