// SPDX-License-Identifier: GPL-3.0-or-later
// Virtual bodies kept and eliminated are the same mechanism: motion, reactions, and the faults that each finds.
#include "mechanism/build/virtual_bodies.hpp"

#include <map>
#include <numbers>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/andrews.hpp"
#include "tests/support/scenes/virtual_bodies.hpp"

namespace tisserand::mechanism::virtual_bodies_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using formats::VirtualBodies;
using test_support::body_at;
using test_support::expect_equal;
using test_support::fixed_joint;
using test_support::joint;
using test_support::largest;
using test_support::Outcome;
using test_support::precise_scene;
using test_support::run_scene;
using test_support::Simulation;
using test_support::virtual_body;

enum class Rod { rigid, superelement, beam, modal };

const char* const rod_names[] = {"rigid", "superelement", "beam", "modal"};

/// Rubber-like, or steel.
constexpr double soft = 1e9, steel = 2e11;

BodyFiles rod_files(double length, double young) {
  test_support::BeamData beam;
  beam.length = length;
  beam.young = young;
  beam.shear_modulus = 0.4 * young;
  BodyFiles files;
  test_support::add_file("rod", test_support::craig_bampton_beam(beam, 4), files.superelements);
  const test_support::Rod lumped{0.0, length, 4e-4, young, 0.4 * young, 1.3e-8, 7800.0, 8};
  files.modal_bodies["rod"].body =
      test_support::modal_body(test_support::lumped_rod(lumped), test_support::rod_conditions(8), 8);
  return files;
}

struct RodSpec {
  Rod kind = Rod::rigid;
  double young = soft;
  formats::InertiaOption inertia = formats::InertiaOption::B;
};

/// The rod from `from`, turned by `angle` about z; the names of its ends.
std::pair<std::string, std::string> add_rod(const RodSpec& rod, double length, const Vector3d& from, double angle,
                                            formats::Scene& scene) {
  formats::InitialMotion start;
  start.pose.position = from;
  start.pose.orientation = Eigen::AngleAxisd(angle, Vector3d::UnitZ());
  switch (rod.kind) {
    case Rod::rigid: {
      formats::RigidBodySpec body = test_support::rigid_body("rod", 0.9, {length / 2, 0, 0}, {1e-4, 7e-3, 7e-3});
      body.start = start;
      body.nodes = {{"start", {}}, {"end", {{length, 0, 0}, Eigen::Quaterniond::Identity()}}};
      scene.bodies.push_back(body);
      return {"rod/start", "rod/end"};
    }
    case Rod::superelement: {
      formats::SuperelementBodySpec body = test_support::superelement_body("rod", "rod");
      body.start = start;
      body.inertia = rod.inertia;
      scene.bodies.push_back(body);
      return {"rod/base", "rod/tip"};
    }
    case Rod::modal: {
      formats::ModalBodySpec body = test_support::modal_spec("rod", "rod");
      body.start = start;
      scene.bodies.push_back(body);
      return {"rod/n0", "rod/n8"};
    }
    case Rod::beam: {
      formats::BeamBodySpec body;
      body.name = "rod";
      body.start = start;
      body.to = {length, 0, 0};
      body.elements = 3;
      body.section.area = 4e-4;
      body.section.second_moment_y = body.section.second_moment_z = 1.3e-8;
      body.section.torsion_constant = 2.2e-8;
      body.section.polar_moment = 2.6e-8;
      body.section.shear_area_y = body.section.shear_area_z = 3.3e-4;
      body.material.youngs_modulus = rod.young;
      body.material.poisson_ratio = 0.3;
      body.material.density = 7800.0;
      scene.bodies.push_back(body);
      return {"rod/start", "rod/end"};
    }
  }
  return {};
}

/// Crank (0.15) on a virtual body of the ground, driven; rod (0.3) with two virtual bodies in a chain at the crank and
/// one at the slider, on which a spring, a force that follows it and a moment act.
formats::Scene slider_crank(const RodSpec& rod, formats::Formulation formulation, VirtualBodies treatment) {
  formats::Scene scene = precise_scene(formulation);
  scene.virtual_bodies = treatment;
  scene.gravity = {0, -9.81, 0};
  const Vector3d pin(0, 0.15, 0), wrist(std::sqrt(0.3 * 0.3 - 0.15 * 0.15), 0, 0);
  scene.bodies.push_back(body_at("crank", 0.4, 0.5 * pin, {8e-4, 1e-4, 8e-4}));
  const auto [start, end] = add_rod(rod, 0.3, pin, -std::numbers::pi / 6, scene);
  scene.bodies.push_back(body_at("slider", 0.2, wrist, {1e-4, 1e-4, 1e-4}));
  scene.bodies.push_back(virtual_body("bearing", Vector3d::Zero()));
  scene.bodies.push_back(virtual_body("inner", pin + Vector3d(0, 0.01, 0)));
  scene.bodies.push_back(virtual_body("outer", pin));
  formats::VirtualBodySpec last = virtual_body("last", wrist);
  last.start.pose.orientation = Eigen::AngleAxisd(0.3, Vector3d::Ones().normalized());
  last.nodes = {{"horn", {{0.02, 0.03, 0.01}, Eigen::Quaterniond::Identity()}}};
  scene.bodies.push_back(last);
  scene.joints = {fixed_joint("seat", "ground", "bearing"),
                  joint("main", JointKind::revolute, "bearing", "crank", {0, 0, 0}, {0, 0, 1}),
                  fixed_joint("outer_tie", "inner", "outer"),
                  fixed_joint("inner_tie", "inner", start),
                  joint("pin", JointKind::spherical, "crank", "outer", pin, {0, 0, 1}),
                  fixed_joint("last_tie", end, "last"),
                  joint("wrist", JointKind::universal, "last", "slider", wrist, {1, 0, 0}),
                  joint("guide", JointKind::prismatic, "ground", "slider", wrist, {1, 0, 0})};
  scene.joints[6].x_axis = Vector3d::UnitZ();
  scene.motions.push_back(test_support::drive("main", "-60*t*t"));
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.a.node = "ground";
  spring.a.position = Vector3d(0.4, 0.2, 0.1);
  spring.b.node = "last/horn";
  spring.stiffness = 500.0;
  spring.damping = 2.0;
  spring.free = 0.1;
  scene.springs.push_back(spring);
  scene.loads.push_back(test_support::constant_load("push", formats::LoadKind::force, "last/horn", {3, -2, 1}));
  scene.loads.back().axes = formats::LoadAxes::body;
  scene.loads.push_back(test_support::constant_load("twist", formats::LoadKind::moment, "inner", {0.1, -0.2, 0.3}));
  return scene;
}

/// Motion and tied reactions of both treatments after 60 steps.
void expect_equal_treatments(const formats::Scene& scene, const BodyFiles& files) {
  formats::Scene other = scene;
  other.virtual_bodies = VirtualBodies::eliminate;
  Outcome kept = run_scene(scene, files, 0.06), eliminated = run_scene(other, files, 0.06);
  EXPECT_GT(kept.motion.at("crank")[8], -60 * 2 * 0.0601);
  EXPECT_LT(kept.motion.at("crank")[8], -60 * 2 * 0.0599);
  EXPECT_GT(largest(kept.reaction), 5.0);
  for (const char* name : {"seat", "outer_tie", "inner_tie", "last_tie"})
    EXPECT_GT(kept.reaction.at(name).norm(), 0.1) << name;
  // Index 3 does not hold velocities to the constraints: those of a kept virtual body are the integrator's, of order 2.
  if (scene.integrator.formulation == formats::Formulation::index3)
    for (const char* name : {"bearing", "inner", "outer", "last", "last/horn"})
      for (Outcome* outcome : {&kept, &eliminated}) outcome->motion.at(name).segment<6>(3).setZero();
  expect_equal(kept.motion, eliminated.motion, 1e-9);
  expect_equal(kept.reaction, eliminated.reaction, 1e-7);
}

class SliderCrank : public ::testing::TestWithParam<std::tuple<Rod, formats::Formulation>> {};
INSTANTIATE_TEST_SUITE_P(Rods, SliderCrank,
                         ::testing::Combine(::testing::Values(Rod::rigid, Rod::superelement, Rod::beam, Rod::modal),
                                            ::testing::Values(formats::Formulation::index3,
                                                              formats::Formulation::stabilised_index2)),
                         [](const auto& given) {
                           return std::string(rod_names[static_cast<int>(std::get<0>(given.param))]) +
                                  (std::get<1>(given.param) == formats::Formulation::index3 ? "_index3" : "_index2");
                         });

// The virtual bodies have neither mass nor freedom of their own: both treatments are the same equations
// (equations of [GA00] section 4, exact form). Tied reactions included: sum over what hangs on the tie against the
// multipliers of the fixed joint. Multipliers follow from the differences of the accelerations, which are larger.
// Factors live differently long in the two: their age must not show in the correction of positions.
TEST_P(SliderCrank, MovesTheSameWithBodiesKeptAndEliminated) {
  const auto [rod, formulation] = GetParam();
  for (const double young : {soft, steel}) {
    const BodyFiles files = rod_files(0.3, young);
    for (const double rho : {0.0, 0.9})
      for (const formats::InertiaOption inertia :
           {formats::InertiaOption::A, formats::InertiaOption::B, formats::InertiaOption::M}) {
        if (rod != Rod::superelement && inertia != formats::InertiaOption::B) continue;
        SCOPED_TRACE(::testing::Message()
                     << "E " << young << ", rho " << rho << ", inertia " << static_cast<int>(inertia));
        formats::Scene scene = slider_crank({rod, young, inertia}, formulation, VirtualBodies::keep);
        scene.integrator.rho = rho;
        // The wrist of a modal body moves nonlinearly, and a damper would feel the velocities that index 3 leaves.
        if (rod == Rod::modal && formulation == formats::Formulation::index3) scene.springs[0].damping = 0.0;
        expect_equal_treatments(scene, files);
      }
  }
}

// What acts on a virtual body gives it no weight in the correction of positions, else the two would differ by the
// share of its stiffness times h² in the masses.
TEST(StiffSpringOnAVirtualBody, LeavesTheMotionTheSame) {
  for (const Rod rod : {Rod::rigid, Rod::beam}) {
    formats::Scene scene = slider_crank({rod, steel}, formats::Formulation::stabilised_index2, VirtualBodies::keep);
    scene.springs[0].stiffness = 1e6;
    scene.springs[0].free.reset();
    expect_equal_treatments(scene, rod_files(0.3, steel));
  }
}

TEST(EliminatedBodies, CostNoUnknowns) {
  const BodyFiles files = rod_files(0.3, soft);
  const auto scene = [](VirtualBodies treatment) {
    return slider_crank({Rod::superelement, soft}, formats::Formulation::index3, treatment);
  };
  Simulation kept(scene(VirtualBodies::keep), files), eliminated(scene(VirtualBodies::eliminate), files);
  EXPECT_EQ(kept.model().virtual_nodes, 4);
  EXPECT_EQ(eliminated.model().virtual_nodes, 0);
  EXPECT_EQ(eliminated.model().ties.size(), 4u);
  // Four nodes and four fixed joints.
  EXPECT_EQ(kept.model().pattern->size() - eliminated.model().pattern->size(), 4 * 12);
  // crank, two nodes of the rod, slider; 17 equations of the joints and the drive.
  EXPECT_EQ(eliminated.model().pattern->size(), 4 * 6 + 5 + 3 + 4 + 5 + 1);
}

// Two rods in a line, their ends tied through a virtual body: the tie of the second carrier stays a joint, which is the
// same as one fixed joint between the ends.
TEST(TwoCarriers, AreTiedByTheJointThatIsLeft) {
  const BodyFiles files = rod_files(0.5, soft);
  const auto scene = [&](bool direct) {
    formats::Scene s = precise_scene(formats::Formulation::stabilised_index2);
    s.gravity = {0, -9.81, 0};
    for (const std::string name : {"left", "right"}) {
      formats::SuperelementBodySpec body = test_support::superelement_body(name, "rod");
      if (name == "right") body.start.pose.position = {0.5, 0, 0};
      s.bodies.push_back(body);
    }
    s.joints.push_back(joint("hinge", JointKind::revolute, "ground", "left/base", {0, 0, 0}, {0, 0, 1}));
    if (direct) {
      s.joints.push_back(fixed_joint("two", "left/tip", "right/base"));
    } else {
      s.bodies.push_back(virtual_body("hub", {0.5, 0.1, 0}));
      s.joints.push_back(fixed_joint("one", "left/tip", "hub"));
      s.joints.push_back(fixed_joint("two", "hub", "right/base"));
      s.joints.back().position = Vector3d(0.5, 0, 0);
    }
    return s;
  };
  const Outcome direct = run_scene(scene(true), files, 0.05);
  Outcome tied = run_scene(scene(false), files, 0.05);
  tied.motion.erase("hub");
  expect_equal(direct.motion, tied.motion, 1e-9);
  // Both joints carry the same force; the moment of "one", at its own place, is another.
  EXPECT_LT((direct.reaction.at("two") - tied.reaction.at("two")).norm(), 1e-7 * direct.reaction.at("two").norm());
  EXPECT_LT((tied.reaction.at("one") - tied.reaction.at("two")).head<3>().norm(), 1e-7);
}

/// A mass on a lever without mass: two virtual bodies tied together, hinged to the ground, carry it by a ball.
formats::Scene massless_lever(VirtualBodies treatment) {
  formats::Scene scene = precise_scene(formats::Formulation::stabilised_index2);
  scene.virtual_bodies = treatment;
  scene.gravity = {0, -9.81, 0};
  scene.bodies.push_back(body_at("mass", 2.0, {0.8, 0, 0}, {0.1, 0.1, 0.1}));
  scene.bodies.push_back(virtual_body("root", {0, 0, 0}));
  scene.bodies.push_back(virtual_body("end", {0.8, 0, 0}));
  scene.joints = {joint("hinge", JointKind::revolute, "ground", "root", {0, 0, 0}, {0, 0, 1}),
                  fixed_joint("lever", "root", "end"),
                  joint("ball", JointKind::spherical, "end", "mass", {0.8, 0, 0}, {0, 0, 1})};
  return scene;
}

// A group without a carrier stays one node without mass, which its joints move: the mathematical pendulum, for which
// ω² = 2 g |y| / l² holds on the way down.
TEST(GroupWithoutCarrier, IsAMasslessNode) {
  Simulation run(massless_lever(VirtualBodies::eliminate), {});
  EXPECT_EQ(run.model().virtual_nodes, 1);
  EXPECT_EQ(run.model().ties.size(), 1u);
  run.start();
  run.run(0.3);
  const Vector3d x = run.position("mass");
  EXPECT_NEAR(x.norm(), 0.8, 1e-12);
  EXPECT_NEAR(run.velocity("mass").squaredNorm(), 2 * 9.81 * -x.y(), 1e-4);
  const Outcome kept = run_scene(massless_lever(VirtualBodies::keep), {}, 0.3);
  const Outcome eliminated = run_scene(massless_lever(VirtualBodies::eliminate), {}, 0.3);
  expect_equal(kept.motion, eliminated.motion, 1e-9);
  expect_equal(kept.reaction, eliminated.reaction, 1e-7);
}

std::string build_error(const formats::Scene& scene, const SuperelementFiles& files) {
  try {
    build_model(scene, files);
  } catch (const Error& error) {
    EXPECT_FALSE(error.remedy().empty());
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

TEST(LoopOfTies, MustClose) {
  formats::Scene scene = massless_lever(VirtualBodies::eliminate);
  scene.joints.push_back(fixed_joint("again", "root", "end"));
  EXPECT_EQ(build_model(scene, {}).model.ties.size(), 2u);
  scene.joints.back().a.position = Vector3d(0.8, 0.003, 0);
  scene.joints.back().b.position = Vector3d::Zero();
  scene.joints.back().a.orientation = Eigen::Quaterniond::Identity();
  scene.joints.back().b.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.02, Vector3d::UnitY()));
  const std::string text = build_error(scene, {});
  EXPECT_THAT(text, ::testing::HasSubstr("'again' closes stays open by a distance of 0.003 and an angle of 0.02 rad"));
}

TEST(PoseOfAVirtualBody, MustMeetItsTie) {
  formats::Scene scene = massless_lever(VirtualBodies::eliminate);
  scene.joints[1].a.position = Vector3d(0.8, 0.004, 0);
  scene.joints[1].b.position = Vector3d::Zero();
  EXPECT_THAT(
      build_error(scene, {}),
      ::testing::HasSubstr("'end' is at a distance of 0.004 and an angle of 0 rad from the pose that joint 'lever'"));
}

TEST(OrientationOfAGroup, MustBeDetermined) {
  SuperelementFiles files;
  test_support::add_file("frame", test_support::test_superelement("mixed"), files);
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.push_back(test_support::superelement_body("frame", "frame"));
  std::string node;
  const formats::Superelement& element = files.at("frame").superelement;
  std::map<int, int> components;
  for (const int one : element.dof_node) ++components[one];
  for (std::size_t i = 0; i < element.dof_node.size(); ++i)
    if (element.dof_node[i] >= 0 && components[element.dof_node[i]] == 3 && element.dof_component[i] < 3)
      node = "frame/" + element.node_name[element.dof_node[i]];
  scene.bodies.push_back(virtual_body("hub", {0, 0, 0}));
  scene.bodies.push_back(virtual_body("rim", {0, 0, 0}));
  scene.joints = {fixed_joint("one", "hub", node), fixed_joint("two", "hub", "rim")};
  const std::string text = build_error(scene, files);
  EXPECT_THAT(text, ::testing::HasSubstr("nothing determines the orientation of virtual body 'hub'"));
  EXPECT_THAT(text, ::testing::HasSubstr(node));
}

TEST(JointInsideAGroup, IsAnErrorThatSaysWhy) {
  formats::Scene scene = massless_lever(VirtualBodies::eliminate);
  scene.joints.push_back(joint("inside", JointKind::revolute, "root", "end", {0, 0, 0}, {0, 0, 1}));
  const std::string text = build_error(scene, {});
  EXPECT_THAT(text, ::testing::HasSubstr("'inside'"));
  EXPECT_THAT(text, ::testing::HasSubstr("fixed joints already connect these bodies"));
}

}  // namespace
}  // namespace tisserand::mechanism::virtual_bodies_test
