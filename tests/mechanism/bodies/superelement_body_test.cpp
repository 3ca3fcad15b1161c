// SPDX-License-Identifier: GPL-3.0-or-later
// Building a superelement body: weights, canonical form, units, cut of modes, order of nodes, errors; no allocation
// later.
#include <cstdlib>
#include <numeric>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/QR>

#include "common/error.hpp"
#include "formats/superelement/weights.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/bodies/superelement_cases.hpp"

namespace tisserand::mechanism::superelement_body_test {
namespace {

using formats::frame_weights;
using formats::FrameKind;
using formats::InertiaOption;
using formats::Weights;
using test_support::BodyState;
using test_support::relative_difference;

const Eigen::Vector3d kGravity(0.7, -9.1, 2.0);

SuperelementBody build(const formats::Superelement& element, const SuperelementOptions& options) {
  return build_superelement_body(element, formats::rigid_properties(element), options);
}

std::string error_of(const formats::Superelement& element, const SuperelementOptions& options) {
  try {
    (void)build(element, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(FrameWeights, MeetTheCentreOfMassWhereTheyCan) {
  const Eigen::Matrix3Xd points = test_support::bent_frame().position.transpose();
  const Eigen::Vector3d center(0.9, 0.3, 0.1);
  const Weights weights = frame_weights(points, center);
  EXPECT_NEAR(weights.alpha.sum(), 1.0, 1e-15);
  EXPECT_LT((points * weights.alpha - center).norm(), 1e-14);
}

TEST(FrameWeights, ProjectTheCentreOfMassOntoALineOfNodes) {
  Eigen::Matrix3Xd points(3, 2);
  points << 0, 2, 0, 0, 0, 0;
  const Weights weights = frame_weights(points, Eigen::Vector3d(0.5, 3.0, -1.0));
  EXPECT_NEAR(weights.alpha[0], 0.75, 1e-15);
  EXPECT_NEAR(weights.alpha[1], 0.25, 1e-15);
  EXPECT_EQ(frame_weights(points.leftCols(1), Eigen::Vector3d(0.5, 3.0, -1.0)).alpha[0], 1.0);
}

// Shifting the origin by 1e4 loses 4 of 16 digits of the input, no more.
TEST(FrameWeights, SumToOneFarFromTheOriginAndInOtherUnits) {
  const Eigen::Matrix3Xd points = test_support::bent_frame().position.transpose();
  const Eigen::Vector3d center(0.9, 0.3, 0.1), shift(1e4, -1e4, 1e4);
  const Weights here = frame_weights(points, center);
  const Weights there = frame_weights(points.colwise() + shift, center + shift);
  const Weights scaled = frame_weights(1e3 * points, 1e3 * center);
  EXPECT_NEAR(there.alpha.sum(), 1.0, 1e-15);
  EXPECT_LT((there.alpha - here.alpha).norm(), 1e-11);
  EXPECT_LT((scaled.alpha - here.alpha).norm(), 1e-14);
}

TEST(FrameWeights, StaySmallWhenNodesAreNearlyInAPlane) {
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 1, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0.01;
  const Weights weights = frame_weights(points, Eigen::Vector3d(0.5, 0.5, 0.3));
  EXPECT_TRUE(weights.flat);
  EXPECT_LT(weights.alpha.cwiseAbs().maxCoeff(), 1.0);
  EXPECT_NEAR(weights.alpha.sum(), 1.0, 1e-15);
}

TEST(SuperelementBuild, GivesTheCanonicalForm) {
  const formats::Superelement element = test_support::test_superelement("frame");
  const SuperelementBody body = build(element, {});
  EXPECT_EQ(body.boundary_size, 18);
  EXPECT_EQ(body.modes, 5);
  for (int k = 1; k < body.modes; ++k) EXPECT_LE(body.S_II[k - 1], body.S_II[k]);
  // The file is canonical already: same eigenvalues, same boundary matrices.
  EXPECT_LT(relative_difference(body.S_II, element.stiffness.diagonal().tail(5)), 1e-10);
  EXPECT_LT(relative_difference(body.M_BB, element.mass.topLeftCorner(18, 18)), 1e-12);
}

// A congruence y = T y' of the internal coordinates and their coupling to the boundary, as free-boundary methods write
// it.
formats::Superelement in_other_form(formats::Superelement element, int nb) {
  std::mt19937 random(5);
  const Eigen::Index n = element.size(), m = n - nb;
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index k = 0; k < m; ++k)
    T.bottomRightCorner(m, m).col(k) += test_support::random_vector_n(random, m, 0.4);
  // y_I = K S_BB y_B + ...: rigid motions of the boundary stay zero in the internal coordinates.
  Eigen::MatrixXd K(m, nb);
  for (Eigen::Index k = 0; k < nb; ++k) K.col(k) = test_support::random_vector_n(random, m, 1e-3);
  T.bottomLeftCorner(m, nb) = K * element.stiffness.topLeftCorner(nb, nb);
  element.stiffness = T.transpose() * element.stiffness * T;
  element.mass = T.transpose() * element.mass * T;
  return element;
}

// Same forces and same elastic energy from the same physics; the modes may differ in sign, so the internal state is
// zero except in rates that are mapped.
TEST(SuperelementBuild, AcceptsEveryForm) {
  for (const std::string name : {"beam", "frame", "mixed"}) {
    const formats::Superelement element = test_support::test_superelement(name);
    const SuperelementBody plain = build(element, {});
    const formats::Superelement other = in_other_form(element, plain.boundary_size);
    ASSERT_GT(other.stiffness.topRightCorner(plain.boundary_size, plain.modes).norm(), 0.1);
    const SuperelementBody body = build(other, {});
    EXPECT_LT(relative_difference(body.S_II, plain.S_II), 1e-9);
    EXPECT_LT(relative_difference(body.S_BB, plain.S_BB), 1e-10);
    EXPECT_LT(relative_difference(body.M_BB, plain.M_BB), 1e-10);
    // Elimination of all modes is blind to signs and to the basis of double modes: M_BI (S_II + s)⁻¹ M_IB.
    const auto schur = [](const SuperelementBody& b, double s) {
      return Eigen::MatrixXd(b.M_BI * (b.S_II.array() + s).inverse().matrix().asDiagonal() * b.M_IB);
    };
    for (const double s : {1.0, 1e3}) EXPECT_LT(relative_difference(schur(body, s), schur(plain, s)), 1e-9);
    const BodyState state = [&] {
      BodyState at_rest = test_support::random_state(plain, 3, 0.1);
      at_rest.y.setZero();
      at_rest.yd.setZero();
      at_rest.ydd.setZero();
      return at_rest;
    }();
    const Eigen::Index nb = plain.boundary_size;
    EXPECT_LT(relative_difference(test_support::residual_vector(body, state, kGravity).head(nb),
                                  test_support::residual_vector(plain, state, kGravity).head(nb)),
              1e-10);
  }
}

TEST(SuperelementBuild, ReportsInTheCoordinatesOfTheFile) {
  const formats::Superelement element = test_support::test_superelement("frame");
  const formats::Superelement other = in_other_form(element, 18);
  const SuperelementBody body = build(other, {});
  const BodyState state = test_support::random_state(body, 3, 0.1);
  SuperelementScratch scratch = make_scratch(body);
  test_support::evaluate(body, state, kGravity, scratch);
  Eigen::VectorXd y(file_coordinate_count(body));
  file_coordinates(body, scratch, y);
  // The elastic energy does not depend on the coordinates.
  const double strain = energy(body, scratch, kGravity).strain;
  EXPECT_NEAR(0.5 * y.dot(other.stiffness * y), strain, 1e-10 * strain);
}

TEST(SuperelementBuild, DoesNotDependOnTheOrderOfRowsAndNodes) {
  const formats::Superelement element = test_support::test_superelement("frame");
  std::vector<int> rows(static_cast<std::size_t>(element.size()));
  std::iota(rows.begin(), rows.end(), 0);
  std::shuffle(rows.begin(), rows.end(), std::mt19937(1));
  const std::vector<int> nodes{2, 0, 1};
  const formats::Superelement mixed = test_support::permute_nodes(test_support::permute_rows(element, rows), nodes);
  for (const FrameKind frame : {FrameKind::karcher, FrameKind::paper}) {
    SuperelementOptions options;
    options.frame = frame;
    options.modes = 0;
    const SuperelementBody a = build(element, options), b = build(mixed, options);
    const BodyState state = test_support::random_state(a, 3, 0.1);
    BodyState permuted = state;
    for (std::size_t i = 0; i < nodes.size(); ++i) permuted.nodes[i] = state.nodes[nodes[i]];
    const Eigen::VectorXd r = test_support::residual_vector(a, state, kGravity);
    const Eigen::VectorXd s = test_support::residual_vector(b, permuted, kGravity);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      EXPECT_LT((s.segment<6>(6 * static_cast<Eigen::Index>(i)) - r.segment<6>(6 * nodes[i])).norm(), 1e-11 * r.norm());
  }
}

TEST(SuperelementBuild, ConvertsUnits) {
  // The element in t, mm, s; the scene in kg, m, s. Internal coordinates of the file keep their numbers.
  const formats::Superelement si = test_support::test_superelement("frame");
  formats::Superelement mm = si;
  mm.node_position *= 1e3;
  const double energy_unit = 1e-3 * 1e6;  // 1 J = 1e3 t mm²/s²; mass·length² likewise: kg m² = 1e-3 t 1e6 mm²
  for (Eigen::Index i = 0; i < mm.size(); ++i)
    for (Eigen::Index j = 0; j < mm.size(); ++j) {
      const auto unit = [&](Eigen::Index k) {
        const auto row = static_cast<std::size_t>(k);
        return mm.dof_node[row] >= 0 && mm.dof_component[row] < 3 ? 1e3 : 1.0;
      };
      mm.stiffness(i, j) *= energy_unit / (unit(i) * unit(j));
      mm.mass(i, j) *= energy_unit / (unit(i) * unit(j));
    }
  SuperelementOptions options;
  options.units = {.length = 1e-3, .mass = 1e3, .time = 1.0};
  const SuperelementBody a = build(si, {}), b = build(mm, options);
  EXPECT_NEAR(b.mass, a.mass, 1e-12 * a.mass);
  EXPECT_LT((b.center_of_mass - a.center_of_mass).norm(), 1e-12);
  EXPECT_LT(relative_difference(b.S_BB, a.S_BB), 1e-12);
  EXPECT_LT(relative_difference(b.M_BB, a.M_BB), 1e-12);
  EXPECT_LT(relative_difference(b.S_II, a.S_II), 1e-10);
  EXPECT_LT(relative_difference(b.M_BI.cwiseAbs(), a.M_BI.cwiseAbs()), 1e-9);
}

TEST(SuperelementBuild, CutsModesWithoutSplittingClusters) {
  test_support::BeamData round = test_support::soft_beam();
  round.Iy = round.Iz;
  const formats::Superelement element = test_support::craig_bampton_beam(round, 6);
  const Eigen::VectorXd eigenvalue = build(element, {}).S_II;
  int first = 0;  // the first of two bending modes of one frequency
  while (eigenvalue[first + 1] - eigenvalue[first] > 1e-6 * eigenvalue[first]) ++first;
  SuperelementOptions options;
  options.modes = first + 1;
  const SuperelementBody body = build(element, options);
  EXPECT_EQ(body.modes, first + 2);
  ASSERT_EQ(body.notes.size(), 1u);
  EXPECT_THAT(body.notes[0], ::testing::HasSubstr("same frequency"));
  options.modes.reset();
  options.cutoff = std::sqrt(eigenvalue[first]) / (2.0 * 3.14159265358979323846) * 1.001;
  EXPECT_EQ(build(element, options).modes, first + 2);
  options.cutoff = 1e-6;
  EXPECT_EQ(build(element, options).modes, 0);
  options.cutoff = 0.0;
  EXPECT_THAT(error_of(element, options), ::testing::HasSubstr("cutoff is 0; choose a frequency above 0"));
}

TEST(SuperelementBuild, TakesWeightsOfTheUser) {
  const formats::Superelement element = test_support::test_superelement("frame");
  SuperelementOptions options;
  options.position_weights = {{"n0", 0.25}, {"n5", 0.75}};
  options.rotation_weights = {{"n2", 1.0}};
  const SuperelementBody body = build(element, options);
  EXPECT_EQ(body.node[0].alpha, 0.25);
  EXPECT_EQ(body.node[1].alpha, 0.0);
  EXPECT_EQ(body.node[2].alpha, 0.75);
  EXPECT_EQ(body.frame, FrameAlgorithm::single_node);
  EXPECT_EQ(body.frame_node, 1);
  options.position_weights[0].weight = 0.5;
  options.where = "scene.yaml:7:3";
  EXPECT_THAT(error_of(element, options),
              ::testing::AllOf(::testing::HasSubstr("sum 1.25"), ::testing::HasSubstr("scene.yaml:7:3")));
}

TEST(SuperelementBuild, NamesWhatIsWrong) {
  const formats::Superelement element = test_support::test_superelement("frame");
  SuperelementOptions options;
  options.modes = 6;
  EXPECT_THAT(error_of(element, options), ::testing::HasSubstr("6 modes are requested, but the superelement has 5"));
  options = {};
  options.frame = FrameKind::node;
  options.frame_node = "tip";
  EXPECT_THAT(error_of(element, options),
              ::testing::AllOf(::testing::HasSubstr("no node 'tip'"), ::testing::HasSubstr("n0, n2, n5")));
  options = {};
  options.damping.ratios_internal.assign(6, 0.01);
  EXPECT_THAT(error_of(element, options), ::testing::HasSubstr("6 ratios for 5 internal modes"));
  options.damping = {};
  options.damping.ratios.assign(18, 0.01);  // 3 nodes of six coordinates and five modes, less six rigid motions: 17
  EXPECT_THAT(error_of(element, options), ::testing::HasSubstr("18 ratios for 17 elastic modes"));
  options.damping = {.mass = -1.0, .stiffness = 0.0, .ratio = 0.0, .ratios = {}};
  EXPECT_THAT(error_of(element, options), ::testing::HasSubstr("mass is -1"));

  formats::Superelement singular = element;  // the fifth internal coordinate is the fourth once more
  singular.stiffness.row(22) = singular.stiffness.row(21);
  singular.stiffness.col(22) = singular.stiffness.col(21);
  EXPECT_THAT(error_of(singular, {}), ::testing::HasSubstr("S_II is singular"));
  formats::Superelement indefinite = element;
  indefinite.stiffness(21, 22) = indefinite.stiffness(22, 21) =
      2.0 * std::sqrt(element.stiffness(21, 21) * element.stiffness(22, 22));
  EXPECT_THAT(error_of(indefinite, {}), ::testing::HasSubstr("S_II is indefinite"));
  formats::Superelement incomplete = test_support::permute_rows(element, [&] {
    std::vector<int> rows(static_cast<std::size_t>(element.size()) - 1);
    std::iota(rows.begin(), rows.end(), 1);
    return rows;
  }());
  EXPECT_THAT(error_of(incomplete, {}), ::testing::HasSubstr("node 'n0' has 2 of three translations"));
}

TEST(SuperelementBuild, RefusesNodesOnALineWithoutRotations) {
  formats::Superelement element = test_support::test_superelement("network");
  for (int i = 0; i < 4; ++i) element.node_position.row(i) = i * Eigen::RowVector3d(1.0, 2.0, 0.5);
  EXPECT_THROW((void)build_superelement_body(element, formats::RigidProperties{.mass = 1.0}, {}), Error);
}

// Two nodes: the closed form of the Karcher mean equals the iterated one of a body with a third node of zero weight.
TEST(SuperelementFrame, ClosedFormEqualsIteration) {
  const formats::Superelement element = test_support::test_superelement("frame");
  SuperelementOptions options;
  options.rotation_weights = {{"n0", 0.3}, {"n5", 0.7}};
  const SuperelementBody body = build(element, options);
  ASSERT_EQ(body.frame, FrameAlgorithm::karcher);
  const BodyState state = test_support::random_state(body, 9, 0.5);
  SuperelementScratch scratch = make_scratch(body);
  test_support::evaluate(body, state, kGravity, scratch);
  const Eigen::Matrix3d R1 = state.nodes[0].R, R2 = state.nodes[2].R;
  const Eigen::Matrix3d expected = R1 * exp_so3<double>(0.7 * log_so3<double>(R1.transpose() * R2));
  EXPECT_LT((scratch.motion.R0 - expected).norm(), 1e-14);
  EXPECT_LT(scratch.motion.frame_error, 1e-13);
}

// The frame starts from any guess within the basin of attraction and forgets it.
TEST(SuperelementFrame, DoesNotRememberItsStart) {
  for (const std::string name : {"frame", "network"}) {
    const SuperelementBody body = build(test_support::test_superelement(name), {});
    BodyState state = test_support::random_state(body, 9, 0.2);
    SuperelementScratch scratch = make_scratch(body);
    test_support::evaluate(body, state, kGravity, scratch);
    const Eigen::Matrix3d R0 = scratch.motion.R0;
    state.R0_reference = R0 * exp_so3<double>(Eigen::Vector3d(0.4, -0.3, 0.5));
    test_support::evaluate(body, state, kGravity, scratch);
    EXPECT_LT((scratch.motion.R0 - R0).norm(), 1e-13);
    EXPECT_LT(scratch.motion.frame_error, 1e-13);
  }
}

}  // namespace
}  // namespace tisserand::mechanism::superelement_body_test
