// SPDX-License-Identifier: GPL-3.0-or-later
// The planar body alone: r_p = Eᵀ r(E q) and A_p = Eᵀ A E, since E is constant where motion stays in the plane.
#include "mechanism/bodies/planar/planar_body.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/QR>

#include "mechanism/bodies/modal/node.hpp"
#include "mechanism/bodies/planar/planar_modal_body.hpp"
#include "mechanism/bodies/superelement/evaluate.hpp"
#include "mechanism/build/build_model.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/uncondensed_tangent.hpp"
#include "tests/support/scenes/planar_scenes.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"

namespace tisserand::mechanism::planar_body_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Motion of the nodes of a beam in the x-y plane, deformed and turned.
std::vector<NodeMotion> some_motion(const SuperelementBody& body, double size) {
  std::vector<NodeMotion> nodes;
  double k = 1.0;
  const Matrix3d R0 = Eigen::AngleAxisd(0.8, Vector3d::UnitZ()).toRotationMatrix();
  for (const SuperelementNode& node : body.node) {
    NodeMotion motion;
    const double turn = size * std::sin(3.0 * k);
    motion.R = R0 * Eigen::AngleAxisd(turn, Vector3d::UnitZ()).toRotationMatrix();
    motion.x = Vector3d(0.3, -0.2, 0) + R0 * (node.X + size * Vector3d(std::cos(5.0 * k), std::sin(7.0 * k), 0));
    motion.xd = {1.0 + 0.3 * std::sin(k), -2.0 * std::cos(k), 0};
    motion.Omega = {0, 0, 3.0 + 0.1 * std::cos(4.0 * k)};
    motion.xdd = {5.0 * std::sin(2.0 * k), 4.0, 0};
    motion.Omegad = {0, 0, -7.0 + std::sin(6.0 * k)};
    nodes.push_back(motion);
    ++k;
  }
  return nodes;
}

struct Evaluated {
  VectorXd r;
  MatrixXd step, exact;
  SuperelementEnergy energy;
  double damping = 0.0;
};

Evaluated evaluated(const SuperelementBody& body, const std::vector<NodeMotion>& nodes, const VectorXd& y) {
  SuperelementScratch scratch = make_scratch(body);
  std::vector<int> index(nodes.size());
  for (std::size_t i = 0; i < index.size(); ++i) index[i] = static_cast<int>(i);
  const NodeView<NodeMotion> view{nodes.data(), index.data()};
  const VectorXd yd = 30.0 * y, ydd = -200.0 * y;
  const Matrix3d R0 = Eigen::AngleAxisd(0.79, Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d gravity(1, -9.81, 0);
  update_kinematics(body, view, y.data(), yd.data(), ydd.data(), R0, scratch);
  residual(body, scratch, gravity);
  Evaluated out;
  out.r.resize(body.boundary_size + body.modes);
  out.r << scratch.forces.r_B, scratch.forces.r_I;
  const TangentCoefficients c{1.3, 17.0, 250.0};
  test_support::uncondensed_tangent(body, scratch, view, gravity, c, TangentKind::step, out.step);
  test_support::uncondensed_tangent(body, scratch, view, gravity, c, TangentKind::exact, out.exact);
  out.energy = energy(body, scratch, gravity);
  out.damping = damping_power(body, scratch);
  return out;
}

/// Columns of the planar coordinates in those of the body in space.
MatrixXd lift_of(const SuperelementBody& spatial, const SuperelementBody& flat) {
  MatrixXd E = MatrixXd::Zero(spatial.boundary_size + spatial.modes, flat.boundary_size + flat.modes);
  E.topLeftCorner(spatial.boundary_size, flat.boundary_size) = flat.file.lift;
  E.bottomRightCorner(spatial.modes, flat.modes) =
      spatial.file.modal_part.colPivHouseholderQr().solve(flat.file.modal_part);
  return E;
}

void expect_restriction(const SuperelementBody& spatial, double size) {
  const SuperelementBody flat = planar_body(spatial, Matrix3d::Identity());
  const MatrixXd E = lift_of(spatial, flat);
  VectorXd y(flat.modes);
  for (int k = 0; k < flat.modes; ++k) y[k] = size * 0.3 * std::cos(2.0 * k);
  const std::vector<NodeMotion> nodes = some_motion(spatial, size);
  const Evaluated a = evaluated(flat, nodes, y),
                  b = evaluated(spatial, nodes, E.bottomRightCorner(spatial.modes, flat.modes) * y);
  const VectorXd r = E.transpose() * b.r;
  EXPECT_LT((a.r - r).norm(), 1e-11 * b.r.norm());
  EXPECT_LT((b.r - E * r).norm(), 1e-9 * b.r.norm());  // nothing out of the plane
  const MatrixXd step = E.transpose() * b.step * E, exact = E.transpose() * b.exact * E;
  EXPECT_LT((a.step - step).norm(), 1e-11 * step.norm());
  EXPECT_LT((a.exact - exact).norm(), 1e-11 * exact.norm());
  EXPECT_NEAR(a.energy.kinetic, b.energy.kinetic, 1e-11 * b.energy.kinetic);
  EXPECT_NEAR(a.energy.strain, b.energy.strain, 1e-11 * b.energy.strain);
  EXPECT_NEAR(a.damping, b.damping, 1e-11 * b.damping + 1e-300);
}

TEST(PlanarBody, IsTheRestrictionOfTheOneInSpace) {
  BodyFiles files;
  test_support::add_file("rod", test_support::craig_bampton_beam({}, 6), files.superelements);
  for (const formats::InertiaOption inertia :
       {formats::InertiaOption::A, formats::InertiaOption::B, formats::InertiaOption::M})
    for (const double ratio : {0.0, 0.02}) {
      formats::Scene scene = test_support::empty_scene(1e-3, 0.1);
      formats::SuperelementBodySpec spec = test_support::superelement_body("rod", "rod");
      spec.inertia = inertia;
      spec.damping.ratio = ratio;
      spec.damping.stiffness = 1e-5;
      scene.bodies.emplace_back(spec);
      expect_restriction(build_model(scene, files).model.superelement_bodies[0], 0.01);
    }
}

TEST(PlanarBody, OfSecondOrderIsTheRestrictionOfTheOneInSpace) {
  formats::Scene scene = test_support::empty_scene(1e-3, 0.1);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  const auto beam = test_support::bernoulli_beam(test_support::slender_section(1e5), 2.0, 8);
  const BodyFiles files = test_support::files_of(test_support::second_order_beam(beam, {0, 4, 8}, 6));
  const SuperelementBody body = build_model(scene, files).model.superelement_bodies[0];
  ASSERT_TRUE(body.second_order.inertia && body.second_order.stiffening);
  expect_restriction(body, 0.02);
}

// A mode that moves the body along the normal alone: none is left, and results still have one.
TEST(PlanarModalBody, MayKeepNoMode) {
  ModalBody body;
  body.modes = 1;
  body.mass = 2.0;
  body.P0 = Vector3d(0.3, 0.2, 0.1).asDiagonal();
  body.J_mu.setIdentity();
  body.C1 = Vector3d::UnitZ();
  body.N_mu = Vector3d::Zero();
  body.P1 = VectorXd::Zero(9);
  body.P2 = MatrixXd::Zero(9, 1);
  body.stiffness = VectorXd::Ones(1);
  body.damping = VectorXd::Zero(1);
  make_planar(Matrix3d::Identity(), 1.0, body, {});
  EXPECT_EQ(body.modes, 0);
  EXPECT_EQ(body.modes_in_space(), 1);
  EXPECT_EQ(body.C1.cols(), 0);
  EXPECT_EQ(VectorXd(body.lift * VectorXd(0)), VectorXd::Zero(1));
}

// What moves in the plane, by the kernels of the plane and by those of space.
TEST(PlanarModalBody, MovesAsInSpace) {
  const Model model =
      build_model(test_support::modal_slider_crank(test_support::upright).scene, test_support::modal_rod_files(6))
          .model;
  const ModalBody& space_body = model.modal_bodies[0];
  ModalBody body = space_body;
  std::vector<ModalNode> nodes(model.modal_nodes.begin(), model.modal_nodes.end());
  std::vector<ModalNode*> own;
  for (ModalNode& node : nodes) own.push_back(&node);
  make_planar(Matrix3d::Identity(), 1.0, body, own);
  ASSERT_EQ(body.modes, 3);
  NodeMotion frame;
  frame.x = {0.3, -0.2, 0.0};
  frame.R = Eigen::AngleAxisd(0.8, Vector3d::UnitZ()).toRotationMatrix();
  frame.xd = {1.0, -2.0, 0.0};
  frame.xdd = {5.0, 4.0, 0.0};
  frame.Omega = {0.0, 0.0, 3.0};
  frame.Omegad = {0.0, 0.0, -7.0};
  const Vector3d gravity(1, -9.81, 0);
  const VectorXd w = Vector3d(0.02, -0.03, 0.01), wd = Vector3d(0.5, 0.3, -0.7), wdd = Vector3d(-9.0, 4.0, 11.0);
  const VectorXd lifted = body.lift * w, lifted_d = body.lift * wd, lifted_dd = body.lift * wdd;
  ModalScratch plane = make_scratch(body), space = make_scratch(space_body);
  update_kinematics(body, frame, {w.data(), wd.data(), wdd.data()}, gravity, plane);
  update_kinematics(space_body, frame, {lifted.data(), lifted_d.data(), lifted_dd.data()}, gravity, space);
  // Coordinates of the plane among [r ω w] in space.
  MatrixXd E = MatrixXd::Zero(6 + space_body.modes, 6);
  for (const auto& [row, column] : {std::pair(0, 0), std::pair(1, 1), std::pair(5, 2)}) E(row, column) = 1.0;
  E.bottomRightCorner(space_body.modes, 3) = body.lift;
  const std::vector<int> rows{0, 1, 5, 6, 7, 8};
  residual(body, plane);
  residual(space_body, space);
  EXPECT_LT((plane.r(rows) - E.transpose() * space.r).norm(), 1e-13 * space.r.norm());
  EXPECT_LT((E * plane.r(rows) - space.r).norm(), 1e-12 * space.r.norm());  // nothing out of the plane
  for (const TangentCoefficients& c : {TangentCoefficients{1, 0, 0}, TangentCoefficients{0, 1, 0},
                                       TangentCoefficients{0, 0, 1}, TangentCoefficients{1, 2, 3}}) {
    tangent(body, c, plane);
    tangent(space_body, c, space);
    const MatrixXd expected = E.transpose() * space.tangent * E;
    EXPECT_LT((plane.tangent(rows, rows) - expected).norm(), 1e-13 * expected.norm());
  }
  const ModalEnergy a = energy(body, frame, gravity, plane), b = energy(space_body, frame, gravity, space);
  EXPECT_NEAR(a.kinetic, b.kinetic, 1e-12 * b.kinetic);
  EXPECT_NEAR(a.strain, b.strain, 1e-12 * b.strain);
  EXPECT_NEAR(a.potential, b.potential, 1e-12 * std::abs(b.potential));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    ModalNodeTerms in_plane = make_terms(nodes[i]), in_space = make_terms(model.modal_nodes[i]);
    NodeMotion moved_in_plane, moved_in_space;
    update_node<2>(nodes[i], plane, frame, moved_in_plane, in_plane);
    update_node<3>(model.modal_nodes[i], space, frame, moved_in_space, in_space);
    const std::vector<int> turned{0, 1, 5};
    EXPECT_LT((in_plane.T(turned, rows) - in_space.T(turned, Eigen::all) * E).norm(), 1e-14);
    EXPECT_LT((in_plane.bias - in_space.bias)(turned).norm(), 1e-12);
    EXPECT_LT((in_plane.E - in_space.E).topLeftCorner(2, 2).norm(), 1e-14);
    EXPECT_LT(std::abs(in_plane.L(2, 2) - in_space.L(2, 2)), 1e-14);
    const NodeMotion &p = moved_in_plane, &s = moved_in_space;
    EXPECT_LT((p.x - s.x).head<2>().norm() + (p.R - s.R).topLeftCorner(2, 2).norm(), 1e-14);
    EXPECT_LT((p.xd - s.xd).head<2>().norm() + std::abs((p.Omega - s.Omega).z()), 1e-13);
    EXPECT_LT((p.xdd - s.xdd).head<2>().norm() + std::abs((p.Omegad - s.Omegad).z()), 1e-12);
    // Out of it modes of the file, of one frequency, are turned apart to their round-off.
    EXPECT_LT(std::abs(s.x.z()) + std::abs(s.xd.z()) + s.Omega.head<2>().norm(), 1e-10);
  }
}

}  // namespace
}  // namespace tisserand::mechanism::planar_body_test
