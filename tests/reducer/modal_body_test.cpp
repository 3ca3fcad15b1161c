// SPDX-License-Identifier: GPL-3.0-or-later
// Modal bodies of the reducer: analytic beams, the file of examples/modal_slider_crank, dense eigenproblems, sums over
// the nodes, masses beside nodes and behind ties, refused inputs.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "reducer/modal_body/modal_body.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::testing::modal_body_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using formats::ModalBody;
using formats::ModalBodyRequest;
using test_support::error_of;
using ::testing::HasSubstr;

constexpr unsigned x = 1, y = 2, z = 4, rx = 8;

/// The part with a modal body of all nodes; `held` empty: the mean axis.
formats::Part asking(formats::Part part, const std::vector<ModalBodyRequest::Held>& held, int modes) {
  part.modal_body.emplace();
  part.modal_body->held = held;
  part.modal_body->modes = modes;
  part.modal_body->all_nodes = true;
  part.modal_body->where = "frame.part.yaml:9:1";
  return part;
}

ModalBody body_of(const formats::Part& part) {
  const ModalBody body = *reduce(part).modal_body;
  formats::check(body, "");  // sums over the nodes, XᵀM X = 1, reference conditions
  return body;
}

/// Frequencies [rad/time] over those of a uniform Euler-Bernoulli beam, √(EI/(ρA)) (k/L)² with I the smaller one.
double over_analytic(const ModalBody& body, Eigen::Index mode, double k) {
  const double L = 1.7, E = 2.1e11, I = 3e-7, mass = 7850.0 * 2e-3;
  return std::sqrt(body.omega2[mode]) / (std::sqrt(E * I / mass) * std::pow(k / L, 2));
}

formats::Part slender_beam(int elements) {
  formats::Part part = plain_beam(Vector3d(0.1, -0.2, 0.3), Vector3d(0.1, 1.5, 0.3), elements, 2);
  set_theory(part, formats::BeamTheory::euler_bernoulli);
  set_mass(part, formats::MassMatrix::consistent, false);
  return part;
}

// The trials: a report that does not say which eigensolver found the modes of the body.
TEST(ReducedModalBody, ReportNamesItsEigensolver) {
  for (const std::vector<ModalBodyRequest::Held>& held : {std::vector<ModalBodyRequest::Held>{{"base"}}, {}}) {
    const reducer::Reduction r = reduce(asking(slender_beam(8), held, 2));
    ASSERT_TRUE(r.model.modal_body);
    EXPECT_FALSE(r.model.modal_body->eigenvalue_solver.empty());
    EXPECT_NE(reducer::certificate_text(r.superelement, r.file, r.model).find("its eigenvalues by "), std::string::npos);
  }
}

// Roots of cos k cosh k = -1 (clamped) and 1 (free). Lumped masses leave an error of order 2 in the size of the
// elements.
TEST(ReducedModalBody, BeamsHaveTheirAnalyticFrequencies) {
  for (const bool clamped : {true, false}) {
    const std::vector<ModalBodyRequest::Held> held =
        clamped ? std::vector<ModalBodyRequest::Held>{{"base"}} : std::vector<ModalBodyRequest::Held>{};
    const double k = clamped ? 1.8751040687 : 4.7300407449;
    const double coarse = over_analytic(body_of(asking(slender_beam(10), held, 3)), 0, k) - 1.0;
    const double fine = over_analytic(body_of(asking(slender_beam(20), held, 3)), 0, k) - 1.0;
    EXPECT_LT(std::abs(fine), 1e-2) << clamped;
    EXPECT_GT(coarse / fine, 3.5) << clamped;
    EXPECT_LT(coarse / fine, 4.5) << clamped;
  }
}

/// Σ_j X_j X_jᵀ/ω_j² of the nodes in the order of their x: bending in y and z has equal frequencies, so single modes
/// are not unique.
MatrixXd flexibility(const ModalBody& body) {
  std::vector<std::size_t> order(body.node_name.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::ranges::sort(order, {}, [&](std::size_t k) { return body.node_position(static_cast<Eigen::Index>(k), 0); });
  MatrixXd X(6 * static_cast<Eigen::Index>(order.size()), body.modes());
  for (std::size_t k = 0; k < order.size(); ++k) X.middleRows<6>(6 * static_cast<Eigen::Index>(k)) = body.X[order[k]];
  return X * body.omega2.cwiseInverse().asDiagonal() * X.transpose();
}

// The rod of [GA00] Table 2, of which tests/support makes the file of the example: small dense matrices, own elements.
TEST(ReducedModalBody, IsTheFileOfTheSliderCrank) {
  const test_support::Rod rod = test_support::paper_rod();
  formats::Part part = plain_beam(Vector3d::Zero(), Vector3d(rod.length, 0, 0), rod.elements, 0);
  set_theory(part, formats::BeamTheory::euler_bernoulli);
  part.materials[0] = {"steel", rod.E, 0.3, rod.density, ""};
  part.sections[0] = {"square", rod.area, rod.I, rod.I, 2 * rod.I, 2 * rod.I, 0.0, 0.0, ""};
  for (const bool mean_axis : {false, true}) {
    const std::vector<ModalBodyRequest::Held> held{{"base", x | y | z | rx}, {"tip", y | z}};
    const int modes = mean_axis ? 4 : 6;
    const ModalBody ours = body_of(asking(part, mean_axis ? std::vector<ModalBodyRequest::Held>{} : held, modes));
    const ModalBody other = test_support::modal_body(
        test_support::lumped_rod(rod), mean_axis ? test_support::Conditions{} : test_support::rod_conditions(8), modes);
    ASSERT_EQ(ours.modes(), other.modes());
    EXPECT_LT((ours.omega2.array() / other.omega2.array() - 1.0).abs().maxCoeff(), 1e-7);  // 1e-16 × 1e7, its condition
    EXPECT_LT(relative_difference(flexibility(ours), flexibility(other)), 1e-7);
    EXPECT_NEAR(ours.integrals.mass / other.integrals.mass, 1.0, 1e-13);
    EXPECT_LT((ours.frame_position - other.frame_position).norm(), 1e-13);
    EXPECT_LT(relative_difference(ours.integrals.P0, other.integrals.P0), 1e-13);
    EXPECT_LT(relative_difference(ours.integrals.J_mu, other.integrals.J_mu), 1e-13);
    EXPECT_EQ(ours.reference, other.reference);
    EXPECT_EQ(ours.reference_component, other.reference_component);
  }
}

Eigen::Matrix3d inertia(const ModalBody& body) {
  const formats::ModalIntegrals& sums = body.integrals;
  return sums.P0.trace() * Eigen::Matrix3d::Identity() - sums.P0 + sums.J_mu;
}

/// A frame with a mass beside its node.
formats::Part frame_with_mass_beside() {
  formats::Part part = space_frame(4);
  part.point_masses[0].offset = Vector3d(0.1, -0.05, 0.2);
  return part;
}

// Rigid properties are those that the reducer finds for the same part with lumped matrices, in another way (RᵀM R of
// the assembled system); frequencies those of its dense S and M without the rows of the held node.
TEST(ReducedModalBody, AgreesWithTheDenseMatrices) {
  formats::Part lumped = frame_with_mass_beside();
  set_mass(lumped, formats::MassMatrix::lumped, true);
  const FullModel full = full_model(lumped);
  const formats::RigidProperties rigid = reduce(lumped).model.rigid;
  std::vector<int> rest;
  for (int q = 0; q < full.system.size(); ++q)
    if (full.system.coordinates.node[full.system.T.source[q]] != full.mesh.boundary[0].node) rest.push_back(q);
  const Eigen::VectorXd held = angular_frequencies(full.S, full.M, rest);
  const Eigen::VectorXd free = eigenvalues(full.S, full.M, -1e4);

  for (const bool mean_axis : {false, true}) {
    const ModalBody body = body_of(
        asking(frame_with_mass_beside(),
               mean_axis ? std::vector<ModalBodyRequest::Held>{} : std::vector<ModalBodyRequest::Held>{{"A"}}, 12));
    for (Eigen::Index j = 0; j < body.modes(); ++j)
      EXPECT_NEAR(body.omega2[j] / (mean_axis ? free[6 + j] : held[j] * held[j]), 1.0, 1e-8) << j;
    EXPECT_NEAR(body.integrals.mass / rigid.mass, 1.0, 1e-12);
    EXPECT_LT((body.frame_position - rigid.center_of_mass).norm(), 1e-12);
    EXPECT_LT(relative_difference(inertia(body), rigid.inertia), 1e-11);
  }
}

TEST(ReducedModalBody, KeepsTheNodesThatAreWantedAndTheLowestModes) {
  formats::Part part = asking(frame_with_mass_beside(), {{"hub"}}, 8);
  const ModalBody all = body_of(part);
  part.modal_body->all_nodes = false;
  part.modal_body->modes = 3;
  part.modal_body->damping = 0.02;
  const ModalBody few = body_of(part);
  EXPECT_EQ(few.node_name, (std::vector<std::string>{"A", "B", "C", "hub"}));
  EXPECT_EQ(few.reference_node, (std::vector<int>(6, 3)));
  EXPECT_FALSE(few.all_nodes);
  EXPECT_EQ(few.zeta, Eigen::Vector3d::Constant(0.02));
  EXPECT_LT((few.omega2.array() / all.omega2.head(3).array() - 1.0).abs().maxCoeff(), 1e-9);
  EXPECT_LT(relative_difference(few.integrals.C1, all.integrals.C1.leftCols(3)), 1e-6);
  EXPECT_LT(relative_difference(few.integrals.N_mu, all.integrals.N_mu.leftCols(3)), 1e-6);
  EXPECT_LT(
      relative_difference(few.X[1], all.X[std::ranges::find(all.node_name, "B") - all.node_name.begin()].leftCols(3)),
      1e-6);
}

// A mass beside its node and one on a node that a rigid spider ties to it are the same body.
TEST(ReducedModalBody, TiesRestrictTheModesAlone) {
  const formats::Part part = asking(frame_with_mass_beside(), {{"A"}}, 6);
  start_solvers();
  reducer::Mesh mesh = reducer::build_mesh(part);
  const ModalBody beside = reducer::lumped_modal_body(mesh, part, 0.0);
  reducer::NodalMass& mass = mesh.masses[0];
  const int node = mesh.nodes();
  mesh.position.conservativeResize(3, node + 1);
  mesh.position.col(node) = mesh.position.col(mass.node) + mass.offset;
  mesh.node_label.push_back("tied");
  reducer::Spider spider;
  spider.reference = mass.node;
  spider.nodes = {node};
  mesh.spiders.push_back(spider);
  mass.node = node;
  mass.offset.setZero();
  const ModalBody tied = reducer::lumped_modal_body(mesh, part, 0.0);
  formats::check(tied, "");
  EXPECT_LT((tied.omega2.array() / beside.omega2.array() - 1.0).abs().maxCoeff(), 1e-9);
  EXPECT_LT(relative_difference(inertia(tied), inertia(beside)), 1e-12);
  EXPECT_LT(relative_difference(tied.integrals.C1, beside.integrals.C1), 1e-6);
}

TEST(ReducedModalBody, RefusesWhatHasNone) {
  const formats::Part frame = space_frame(2);
  const auto error = [](const formats::Part& part) { return error_of([&] { static_cast<void>(reduce(part)); }); };
  EXPECT_THAT(
      error(asking(frame, {{"A", x | y | z}, {"B", x | y | z}}, 3)),
      HasSubstr("frame.part.yaml:9:1: modal_body: the six held components leave a rigid motion of the part free"));
  EXPECT_THAT(error(asking(frame, {{"A"}}, 100000)), HasSubstr("modal_body: 100000 modes asked for, but only "));
  EXPECT_THAT(error(asking(frame, {}, 100000)), HasSubstr("modal_body: 100000 modes asked for, but only "));
  formats::Part released = frame;
  released.beams[3].releases.end = 0b110000;
  EXPECT_THAT(error(asking(released, {{"A"}}, 3)), HasSubstr("modal_body: lumped masses couple "));
  start_solvers();
  const formats::Part mean = asking(frame, {}, 3);
  EXPECT_THAT(error_of([&] { static_cast<void>(reducer::lumped_modal_body(reducer::build_mesh(mean), mean, 0.0)); }),
              HasSubstr("no free frequencies, so it has no mean axis; hold six components"));
}

}  // namespace
}  // namespace tisserand::testing::modal_body_test
