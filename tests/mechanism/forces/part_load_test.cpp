// SPDX-License-Identifier: GPL-3.0-or-later
// Load cases of companion files as loads: against gravity, closed formulas, differences, and the balance of energy.
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "common/math/rotation.hpp"
#include "mechanism/analyses/modes.hpp"
#include "mechanism/analyses/statics.hpp"
#include "tests/support/bodies/second_order_network.hpp"
#include "tests/support/bodies/superelement_cases.hpp"
#include "tests/support/bodies/uncondensed_tangent.hpp"
#include "tests/support/scenes/model_tangent.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/scenes/second_order_scenes.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::mechanism::part_load_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::InertiaOption;
using formats::JointKind;
using formats::StiffeningOption;
using test_support::BodyState;
using test_support::empty_scene;
using test_support::files_of;
using test_support::joint;
using test_support::SecondOrderBody;
using test_support::Simulation;
using ::testing::HasSubstr;

const Vector3d z = Vector3d::UnitZ();

/// The acceleration `a` of every node of a model with `components` coordinates per node, as forces.
VectorXd body_force(const test_support::FullModel& model, const Vector3d& a) {
  VectorXd everywhere = VectorXd::Zero(model.M.rows());
  for (Eigen::Index node = 0; node < model.position.rows(); ++node) everywhere.segment<3>(model.components * node) = a;
  return model.M * everywhere;
}

/// EI 100 and 200, length 10, mass 1 per length; two boundary nodes. Load cases of a force per length of 1: "across"
/// along z, "aside" along y, "down" against x.
SecondOrderBody beam(int modes) {
  const test_support::SectionData section = test_support::slender_section(1e6);
  const test_support::BernoulliBeam model = test_support::bernoulli_beam(section, 10.0, 16);
  SecondOrderBody body = test_support::second_order_beam(model, {0, 16}, modes);
  const auto add = [&](const char* name, const Vector3d& a) {
    test_support::add_load_case(model, {0, 16}, name, body_force(model.model, a), body);
  };
  add("across", z);
  add("aside", Vector3d::UnitY());
  add("down", -Vector3d::UnitX());
  return body;
}
constexpr double length = 10.0, EI = 100.0;

formats::PartLoadSpec part_load(const std::string& load_case, const formats::TimeFunctionSpec& value) {
  return {"load_" + load_case, "beam", load_case, value, "test.yaml:9:3"};
}

formats::Scene one_body(bool second_order) {
  formats::Scene scene = empty_scene(0.01, 1.0);
  formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
  body.second_order = second_order;
  scene.bodies.push_back(body);
  return scene;
}

formats::SuperelementBodySpec& body_of(formats::Scene& scene) {
  return std::get<formats::SuperelementBodySpec>(scene.bodies[0]);
}

/// The first node clamped where it stands.
formats::Scene clamped(bool second_order) {
  formats::Scene scene = one_body(second_order);
  scene.analysis = formats::AnalysisKind::statics;
  scene.joints.push_back(joint("wall", JointKind::fixed, "ground", "beam/n0", Vector3d::Zero(), z));
  return scene;
}

void solve(Simulation& run) {
  run.start();
  const StaticsReport statics = solve_statics(run.model(), run.scene.statics, {}, run.state(), run.workspace);
  EXPECT_EQ(statics.outcome, StepOutcome::accepted) << statics.explanation;
}

// q L⁴/(8 EI) along the axis of the part that the load has, whatever way the body stands: consistent loads on Hermite
// elements give nodes exactly; what remains is of the order of the square of the deflection of 1e-5 of the length.
TEST(PartLoad, LineLoadBendsACantileverAlongItsOwnAxes) {
  const double q = 1e-5 * EI / std::pow(length, 3), deflection = q * std::pow(length, 4) / (8 * EI);
  for (const int modes : {0, 6})
    for (const bool second_order : {false, true})
      for (const Vector3d& turn : {Vector3d(0, 0, 0), Vector3d(0.4, -1.1, 2.0)}) {
        formats::Scene scene = clamped(second_order);
        const Eigen::Matrix3d R = exp_so3<double>(turn);
        body_of(scene).start.pose.orientation = Eigen::Quaterniond(R);
        scene.part_loads.push_back(part_load("across", q));
        Simulation run(scene, files_of(beam(modes)));
        solve(run);
        const Vector3d moved = R.transpose() * run.position("beam/n16") - Vector3d(length, 0, 0);
        EXPECT_NEAR(moved.z() / deflection, 1.0, 1e-8) << modes << second_order;
        EXPECT_LT(moved.head<2>().norm(), 1e-4 * deflection);
      }
}

/// A network of point masses with the load case "fall" of the acceleration `a`.
SecondOrderBody falling_network(int modes, const Vector3d& a) {
  SecondOrderBody body = test_support::second_order_network(modes, Eigen::Vector4d(0.4, 0.3, 0.2, 0.1));
  test_support::add_load_case("fall", body_force(test_support::spring_network(), a), body);
  return body;
}

SuperelementBody body_with_loads(const SecondOrderBody& from, SuperelementOptions options) {
  options.companion = &from.companion;
  for (const formats::LoadCase& load : from.companion.load_cases) options.load_cases.push_back(load.name);
  return build_superelement_body(from.element, formats::rigid_properties(from.element), options);
}

SuperelementOptions second_order_options() {
  SuperelementOptions options;
  options.inertia = InertiaOption::F;
  options.stiffening = StiffeningOption::full;
  return options;
}

int index_of(const SuperelementBody& body, const std::string& name) {
  for (std::size_t i = 0; i < body.load_cases.size(); ++i)
    if (body.load_cases[i].name == name) return static_cast<int>(i);
  throw std::runtime_error("no load case " + name);
}

/// r with the load case `name` less r with gravity, relative to the weight; the acceleration `a` in axes of the frame.
double apart_from_gravity(const SuperelementBody& body, const BodyState& state, const std::string& name,
                          const Vector3d& a) {
  SuperelementScratch scratch = make_scratch(body);
  test_support::evaluate(body, state, Vector3d::Zero(), scratch);
  const Vector3d gravity = scratch.motion.R0 * a;
  const VectorXd weight = test_support::residual_vector(body, state, gravity);
  scratch.forces.loads.factors[index_of(body, name)] = 1.0;
  residual(body, scratch, Vector3d::Zero());
  VectorXd load(weight.size());
  load << scratch.forces.r_B, scratch.forces.r_I;
  return (load - weight).cwiseAbs().maxCoeff() /
         (weight - test_support::residual_vector(body, state, Vector3d::Zero())).cwiseAbs().maxCoeff();
}

// Weight has its moment where the masses have moved to, which the load case knows from its second-order part; the
// linear body has all of that, also with fewer modes than the file.
TEST(PartLoad, FallIsGravityOnADeformedLinearBody) {
  const Vector3d a(0.3, -0.9, 0.5);
  const SecondOrderBody network = falling_network(6, a);
  for (const int modes : {6, 2, 0}) {
    SuperelementOptions options;
    options.modes = modes;
    const SuperelementBody body = body_with_loads(network, options);
    EXPECT_LT(apart_from_gravity(body, test_support::random_state(body, 3, 0.1), "fall", a), 1e-11) << modes;
  }
}

// With second-order terms both have N_a; gravity alone has the moment of what w₂ moves, of second order in y.
TEST(PartLoad, FallIsGravityOnASecondOrderBodyToSecondOrder) {
  const Vector3d a(0.3, -0.9, 0.5);
  const SecondOrderBody network = falling_network(6, a);
  for (const int modes : {6, 2}) {
    SuperelementOptions options = second_order_options();
    options.modes = modes;
    const SuperelementBody body = body_with_loads(network, options);
    const double coarse = apart_from_gravity(body, test_support::random_state(body, 3, 2e-3), "fall", a);
    const double fine = apart_from_gravity(body, test_support::random_state(body, 3, 1e-3), "fall", a);
    EXPECT_LT(fine, 1e-5);
    if (modes == 6) {
      EXPECT_LT(coarse, 1e-13) << "with all modes the inside does not move by itself";
    } else {
      EXPECT_NEAR(coarse / fine, 4.0, 0.4);
    }
  }
}

// Moments of clamped ends count half with the turn of their nodes: otherwise the difference is ½ ψ × q L²/12, half a
// turn times the weight. Hermite shapes weigh displacements along and across differently, which leaves (h/L)² of that.
TEST(PartLoad, FallIsGravityOfABeam) {
  const SecondOrderBody from = beam(6);
  const SuperelementBody body = body_with_loads(from, {});
  constexpr double turn = 1e-3;
  for (const auto& [name, a] : {std::pair<const char*, Vector3d>{"across", z}, {"down", {-1, 0, 0}}})
    EXPECT_LT(apart_from_gravity(body, test_support::random_state(body, 3, turn), name, a), 0.05 * turn) << name;
}

/// c_m ∂/∂v̇ + c_c ∂/∂v + c_k ∂/∂q of (r_B, r_I) by central differences.
MatrixXd differences(const SuperelementBody& body, const BodyState& state, const VectorXd& factors,
                     const TangentCoefficients& c) {
  constexpr double h = 1e-6;
  const int nb = body.boundary_size, n = nb + body.modes;
  MatrixXd A(n, n);
  for (int column = 0; column < n; ++column) {
    VectorXd side[2];
    for (int s = 0; s < 2; ++s) {
      const VectorXd d = (s == 0 ? h : -h) * VectorXd::Unit(n, column);
      BodyState moved = state;
      for (std::size_t i = 0; i < body.node.size(); ++i) {
        NodeMotion& node = moved.nodes[i];
        if (body.node[i].has_translation()) {
          const Vector3d x = d.segment<3>(body.node[i].translation_row);
          node.x += c.stiffness * x, node.xd += c.damping * x, node.xdd += c.mass * x;
        }
        if (body.node[i].has_rotation()) {
          const Vector3d turn = d.segment<3>(body.node[i].rotation_row);
          node.R = node.R * exp_so3<double>(c.stiffness * turn);
          node.Omega += c.damping * turn, node.Omegad += c.mass * turn;
        }
      }
      moved.y += c.stiffness * d.tail(body.modes);
      moved.yd += c.damping * d.tail(body.modes);
      moved.ydd += c.mass * d.tail(body.modes);
      SuperelementScratch scratch = make_scratch(body);
      scratch.forces.loads.factors = factors;
      test_support::evaluate(body, moved, Vector3d(0.7, -9.1, 2.0), scratch);
      side[s].resize(n);
      side[s] << scratch.forces.r_B, scratch.forces.r_I;
    }
    A.col(column) = (side[0] - side[1]) / (2 * h);
  }
  return A;
}

// The loads are of the size of the elastic forces; without them in the tangent the difference is of order 1.
TEST(PartLoad, ExactTangentAgainstDifferences) {
  const SecondOrderBody network = falling_network(6, {3, -9, 5}), rod = beam(4);
  SuperelementOptions option_A;
  option_A.inertia = InertiaOption::A;
  SuperelementOptions option_M;
  option_M.inertia = InertiaOption::M;
  for (const SecondOrderBody* from : {&network, &rod})
    for (const SuperelementOptions& options : {SuperelementOptions{}, option_A, option_M, second_order_options()}) {
      const SuperelementBody body = body_with_loads(*from, options);
      const BodyState state = test_support::random_state(body, 5, 0.05);
      SuperelementScratch scratch = make_scratch(body);
      scratch.forces.loads.factors.setLinSpaced(100.0, 200.0);
      const VectorXd factors = scratch.forces.loads.factors;
      test_support::evaluate(body, state, Vector3d(0.7, -9.1, 2.0), scratch);
      const TangentCoefficients c{0.3, 0.7, 1.1};
      MatrixXd A;
      test_support::uncondensed_tangent(body, scratch, test_support::in_order(state.nodes), Vector3d(0.7, -9.1, 2.0), c,
                                        TangentKind::exact, A);
      EXPECT_LT(test_support::relative_difference(A, differences(body, state, factors, c)), 1e-6);
    }
}

// One with an expression in a channel: the position of the tip feeds back on the factor.
TEST(PartLoad, TangentsHoldChannels) {
  for (const bool rigid : {false, true}) {
    formats::Scene scene = one_body(false);
    body_of(scene).modes = 0;
    body_of(scene).rigid = rigid;
    formats::ChannelSpec height;
    height.name = "height";
    height.kind = formats::ChannelKind::position;
    height.a.node = "beam/n16";
    height.axis = z;
    scene.channels.push_back(height);
    scene.part_loads.push_back(part_load("across", formats::TimeExpression{"30 - 20 * height", {}, "test"}));
    Simulation run(scene, files_of(beam(2)));
    run.start();
    test_support::randomise(run, 3, 0.3, 0.5);
    evaluate(run.model(), run.state(), run.workspace.now);
    const MatrixXd exact = test_support::dense_matrix(run, {{0.0, 0.0, 1.0}, TangentKind::exact, {}});
    const MatrixXd difference = test_support::residual_difference(run, test_support::Argument::position, 1e-6);
    const Eigen::Index n = run.model().sizes.boundary;
    EXPECT_LT(test_support::relative_difference(exact.topLeftCorner(n, n), difference.topLeftCorner(n, n)), 1e-6);
  }
}

// The balance of a swinging cantilever closes as the square of the step does.
TEST(PartLoad, WorkIsInTheBalanceOfEnergy) {
  for (const bool second_order : {false, true}) {
    const auto balance = [&](double step) {
      formats::Scene scene = one_body(second_order);
      scene.integrator.step = step;
      scene.integrator.end = 2.0;
      scene.gravity = {0, -1, -2};
      scene.joints.push_back(joint("hinge", JointKind::spherical, "ground", "beam/n0", Vector3d::Zero(), z));
      scene.part_loads.push_back(part_load("across", formats::TimeExpression{"4*sin(3*t)", {}, "test"}));
      scene.part_loads.push_back(part_load("down", 0.5));
      Simulation run(scene, files_of(beam(4)));
      run.start();
      run.run(2.0);
      EXPECT_GT(std::abs(run.state().work()), 10.0);
      return run.energy().total() - run.state().initial_energy() - run.state().work() + run.state().dissipated();
    };
    const double coarse = balance(0.01), fine = balance(0.005);
    EXPECT_LT(std::abs(fine), 0.05);
    EXPECT_NEAR(coarse / fine, 4.0, 1.0);
  }
}

/// What the clamp receives.
VectorXd reaction(formats::Scene scene, const BodyFiles& files) {
  Simulation run(std::move(scene), files);
  solve(run);
  return run.state().lambda();
}

// Small deflections: the clamp feels the resultant, of a rigid body exactly, of a flexible one to the order of them.
TEST(PartLoad, RigidBodyTakesTheResultant) {
  formats::Scene scene = clamped(false);
  body_of(scene).start.pose.orientation = Eigen::Quaterniond(exp_so3<double>(Vector3d(0.4, -1.1, 2.0)));
  for (const char* name : {"across", "aside", "down"}) scene.part_loads.push_back(part_load(name, 1e-6));
  const BodyFiles files = files_of(beam(6));
  const VectorXd flexible = reaction(scene, files);
  body_of(scene).rigid = true;
  const VectorXd rigid = reaction(scene, files);
  EXPECT_GT(rigid.norm(), 1e-5);
  EXPECT_LT((flexible - rigid).norm(), 1e-5 * rigid.norm());
}

/// Least eigenvalue of the stiffness of a clamped column under the load q against its axis.
double least_stiffness(const BodyFiles& files, double q) {
  formats::Scene scene = clamped(true);
  body_of(scene).frame = formats::FrameKind::node;
  body_of(scene).frame_node = "n0";
  scene.part_loads.push_back(part_load("down", q));
  Simulation run(scene, files);
  solve(run);
  const Linearisation l = linearise(run.model(), run.state(), Vector3d::Zero(), run.workspace.now);
  const MatrixXd Z = null_space(run.model(), l.B), K = Z.transpose() * l.K * Z;
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(0.5 * (K + K.transpose())).eigenvalues()[0];
}

// Greenhill (1881): a column buckles under its own weight at q L³/(EI) = 7.8373. The frame stands on the clamped node,
// so that the load keeps its direction.
TEST(PartLoad, ColumnBucklesUnderItsWeight) {
  for (const int modes : {4, 8}) {
    const BodyFiles files = files_of(beam(modes));
    double below = 0.0, above = 20.0;
    while (above - below > 1e-4) {
      const double middle = 0.5 * (below + above);
      (least_stiffness(files, middle * EI / std::pow(length, 3)) > 0.0 ? below : above) = middle;
    }
    EXPECT_NEAR(below / 7.8373, 1.0, 0.01);
  }
}

// In the mirror y -> −y the load case along y points along −y, and that along z as before; in millimetres deflections
// are a thousand times as many.
TEST(PartLoad, MirrorAndUnits) {
  const auto tip = [](const Vector3d& mirror, double millimetres) {
    formats::Scene scene = clamped(true);
    body_of(scene).mirror = mirror;
    scene.units.length.factor = 1.0 / millimetres;
    scene.part_loads.push_back(part_load("aside", 1e-3));
    scene.part_loads.push_back(part_load("across", 2e-3));
    Simulation run(scene, files_of(beam(6)));
    solve(run);
    return Vector3d(run.position("beam/n16"));
  };
  const Vector3d as_is = tip({1, 1, 1}, 1), mirrored = tip({1, -1, 1}, 1), scaled = tip({1, 1, 1}, 1000);
  EXPECT_GT(as_is.y(), 1e-3);
  EXPECT_LT((mirrored - Vector3d(as_is.x(), -as_is.y(), as_is.z())).norm(), 1e-10 * length);
  EXPECT_LT((scaled - 1000.0 * as_is).norm(), 1e-7 * length);
}

TEST(PartLoad, BadLoadCases) {
  formats::Scene scene = one_body(false);
  scene.part_loads.push_back(part_load("wind", 1.0));
  const BodyFiles files = files_of(beam(2));
  EXPECT_THAT(
      test_support::error_of([&] { build_model(scene, files); }),
      HasSubstr("test.yaml:9:3: load 'load_wind': body 'beam' has no load case 'wind' in beam.companion.h5; its "
                "load cases are across, aside, down, push"));
  BodyFiles none = files;
  none.companions.clear();
  EXPECT_THAT(test_support::error_of([&] { build_model(scene, none); }),
              HasSubstr("load 'load_wind': body 'beam' has no load case 'wind': there is no file "
                        "beam.companion.h5; write load cases with `load_cases` in the part file"));
  BodyFiles empty = files;
  empty.companions["beam"].load_cases.clear();
  EXPECT_THAT(test_support::error_of([&] { build_model(scene, empty); }),
              HasSubstr("beam.companion.h5 has no load cases"));
}

// A file that holds load cases alone serves linear bodies.
TEST(PartLoad, LoadCasesAlone) {
  BodyFiles files = files_of(beam(6)), alone = files;
  formats::Companion& companion = alone.companions["beam"];
  std::vector<formats::LoadCase> cases = companion.load_cases;
  formats::Companion bare;
  bare.content_id = companion.content_id;
  bare.units = companion.units;
  bare.weights = companion.weights;
  bare.reference_point = companion.reference_point;
  for (formats::LoadCase& load : cases) load.stiffness.resize(0, 0);
  bare.load_cases = cases;
  companion = bare;
  formats::Scene scene = clamped(false);
  scene.part_loads.push_back(part_load("across", 1e-6));
  Simulation with_all(scene, files), with_cases(scene, alone);
  solve(with_all);
  solve(with_cases);
  EXPECT_NEAR(with_cases.position("beam/n16").z() / with_all.position("beam/n16").z(), 1.0, 1e-9);
}

}  // namespace
}  // namespace tisserand::mechanism::part_load_test
