// SPDX-License-Identifier: GPL-3.0-or-later
// The car of examples/vehicle on its rigid and its flexible chassis: loads, frequencies, symmetry, and agreement
// between the ways to model chassis and hinges.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/scene/scene.hpp"
#include "mechanism/analyses/kinematics.hpp"
#include "mechanism/analyses/modes.hpp"
#include "mechanism/analyses/statics.hpp"
#include "mechanism/equations/mobility.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::car_test {
namespace {

using Eigen::Vector3d;
using test_support::Simulation;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;
using Settings = std::vector<std::string>;

constexpr double g = 9.81;
const std::string example = TISSERAND_SOURCE_DIR "/examples/vehicle";
const Settings bump_right{
    "roads.road={type: profile, right: {shape: cosine, start: 3, length: 1, height: $bump}, transition: 0.4}"};
const Settings bump_both{"roads.road={type: profile, height: {shape: cosine, start: 3, length: 1, height: $bump}}"};

formats::Scene car_scene(const std::string& folder, const Settings& settings) {
  std::vector<formats::Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(formats::parse_override(setting));
  const formats::Scene scene = formats::read_scene(folder + "/car.scene.yaml", overrides);
  return formats::scene_of(scene, scene.analyses.back());
}

/// A car in equilibrium, then at the speed that its scene gives it.
struct Car {
  Simulation run;
  std::vector<TyreTerms> loads;  ///< at rest: front left, front right, rear left, rear right

  explicit Car(const formats::Scene& scene) : run(scene, read_body_files(scene)) {
    run.start();
    const StaticsReport report = solve_statics(run.model(), run.scene.statics, {}, run.state(), run.workspace);
    EXPECT_EQ(report.outcome, StepOutcome::accepted) << report.explanation;
    loads = tyres();
    run.started = mechanism::start(run.scene, StartFrom::rest, run.built, run.workspace);
  }
  explicit Car(const Settings& settings = {}) : Car(car_scene(example, settings)) {}

  std::vector<TyreTerms> tyres() {
    evaluate(run.model(), run.state(), run.workspace.now);
    return run.workspace.now.tyres;
  }
  Eigen::Matrix3d turn(const std::string& node) { return run.rotation(node).toRotationMatrix(); }
};

// 196 and 294 kg per wheel: 1922.8 N and 2884.1 N (lever law with the positions of the drawing; the car settles by
// millimetres, 1e-3 of the wheelbase). 102 coordinates, 88 + 2 equations of which 2 repeat others: mobility 14.
TEST(VehicleExample, StandsWithTheLoadsOfItsMasses) {
  formats::Scene scene = car_scene(example, {});
  scene.initial.clear();
  Car car(scene);
  EXPECT_EQ(car.run.model().sizes.constraints, 90);
  EXPECT_EQ(static_cast<int>(car.run.workspace.now.active.sum()), 88);
  double sum = 0.0;
  for (const TyreTerms& tyre : car.loads) sum += tyre.force.z();
  EXPECT_NEAR(sum, 980.0 * g, 1e-5);
  EXPECT_NEAR(car.loads[0].force.z(), 1922.8, 5.0);
  EXPECT_NEAR(car.loads[2].force.z(), 2884.1, 5.0);
  EXPECT_NEAR(car.loads[0].force.z(), car.loads[1].force.z(), 1e-6);
  EXPECT_NEAR(car.loads[2].force.z(), car.loads[3].force.z(), 1e-6);
  const Vector3d at = car.run.position("chassis");
  car.run.run(2.0);
  EXPECT_LT((car.run.position("chassis") - at).norm(), 1e-7);
}

// Without damping, heave and pitch of a plane model with four degrees of freedom and the same wheel rates: 1.435
// and 1.582 Hz; the arms turn, which takes 5 %. Wheel hop √((k + k_t)/m)/2π with a third of the mass of each arm, which
// turns about its hinge, and none of the strut, which hardly moves: 12.9 Hz in front, 13.1 behind. Rolling, since a
// standing tyre creeps and damps what scrubs.
TEST(VehicleExample, HasTheFrequenciesOfHeavePitchAndHop) {
  formats::Scene scene = car_scene(example, {});
  scene.analysis = formats::AnalysisKind::modes;
  for (formats::SpringSpec& spring : scene.springs) spring.damping = 0.0;
  for (formats::TyreSpec& tyre : scene.tyres) tyre.damping = 0.0;
  Car car(scene);
  const ModesReport report = solve_modes(car.run.model(), car.run.state(), {}, car.run.workspace.now);
  const auto nearest = [&](double frequency) {
    double best = 0.0;
    for (const Mode& mode : report.modes)
      if (std::abs(mode.damping_ratio()) < 0.05 && std::abs(mode.frequency() - frequency) < std::abs(best - frequency))
        best = mode.frequency();
    return best;
  };
  const double front = std::sqrt((13405.0 + 190e3) / (29.0 + 5.5 / 3.0)) / (2.0 * std::numbers::pi);
  const double rear = std::sqrt((27515.0 + 190e3) / (31.0 + 4.0 / 3.0)) / (2.0 * std::numbers::pi);
  for (const double expected : {1.435, 1.582, front, rear}) EXPECT_NEAR(nearest(expected), expected, 0.05 * expected);
}

// Dropped by 20 mm the car only loses energy, to dampers and tyres, at every step; what it loses is booked as
// dissipated (trapezoidal rule at steps of 1 ms: within 1 %).
TEST(VehicleExample, LosesEnergyAtEveryStepWhenItIsDropped) {
  formats::Scene scene = car_scene(example, {"roads.road.pose={position: [0, 0, -0.02]}"});
  scene.initial.clear();
  Simulation run(scene, {});
  run.start();
  const double before = run.energy().total();
  double last = before, most = 0.0;
  run.run(0.6, [&] {
    const double now = run.energy().total();
    most = std::max(most, now - last);
    last = now;
  });
  EXPECT_LT(most, 1e-6 * (before - last));
  EXPECT_GT(before - last, 50.0);
  EXPECT_NEAR(run.state().dissipated(), before - last, 0.01 * (before - last));
}

TEST(VehicleExample, StartsAtSpeedWithRollingWheels) {
  Car car;
  EXPECT_LT((car.run.velocity("chassis") - Vector3d(16.6667, 0, 0)).norm(), 1e-9);
  const std::vector<TyreTerms> tyres = car.tyres();
  for (const TyreTerms& tyre : tyres) EXPECT_NEAR(tyre.slip, 0.0, 3e-4);  // rolling radii to four digits
  // The arms settle by millimetres from where they are drawn, which toes the wheels a little, both sides alike.
  for (const int axle : {0, 2}) {
    EXPECT_LT(std::abs(tyres[axle].slip_angle), 2e-3);
    EXPECT_NEAR(tyres[axle].slip_angle, -tyres[axle + 1].slip_angle, 1e-8);
  }
  // It goes on: slips settle, and it stays straight.
  car.run.run(0.15);
  EXPECT_NEAR(car.run.velocity("chassis").x(), 16.6667, 0.01);
  EXPECT_LT(std::abs(car.run.position("chassis").y()), 1e-9);
}

/// How far one body is from the mirror image of another, in place and orientation.
double asymmetry(Car& left, const std::string& a, Car& right, const std::string& b) {
  const Eigen::Matrix3d S = Vector3d(1, -1, 1).asDiagonal();
  return (S * left.run.position(a) - right.run.position(b)).norm() + (S * left.turn(a) * S - right.turn(b)).norm();
}

/// The bump under both sides until `end`: both sides move alike to round-off (Newton's tolerance, 1e-8 of the forces,
/// over hundreds of steps), so that there is neither roll nor yaw.
void expect_straight(Car car, double end) {
  double lift = 0.0, difference = 0.0;
  car.run.run(end, [&] {
    lift = std::max(lift, car.run.position("front_left/wheel").z());
    for (const std::string body : {"front_left/lower_arm", "front_left/knuckle"})
      difference = std::max(difference, asymmetry(car, body, car, "front_right" + body.substr(10)));
    difference = std::max(difference, asymmetry(car, "rear_left/hub", car, "rear_right/hub"));
  });
  EXPECT_GT(lift, 0.35);
  EXPECT_LT(difference, 1e-8);
}

/// Mirrored: the bump on the right turns the car as that on the left does, the other way round.
void expect_mirrored(Car left, Car right, double end) {
  left.run.run(end);
  right.run.run(end);
  EXPECT_GT(asymmetry(left, "rear_left/hub", left, "rear_right/hub"), 1e-3);
  EXPECT_LT(asymmetry(left, "rear_left/hub", right, "rear_right/hub"), 1e-7);
  EXPECT_LT(asymmetry(left, "front_left/wheel", right, "front_right/wheel"), 1e-7);
}

// With a rule that counted steps the run had 4557 factorisations of four times the entries of the matrix.
TEST(VehicleExample, SeldomFactorsOverTheBumpAndWithLittleFill) {
  Car car;
  car.run.run(2.0);
  EXPECT_EQ(car.run.steps, 2000);
  EXPECT_LT(car.run.factorisations, 1000);
  EXPECT_LT(car.run.workspace.matrix.health().fill, 3.0);
}

TEST(VehicleExample, GoesStraightOverABumpUnderBothSides) { expect_straight(Car(bump_both), 0.7); }

TEST(VehicleExample, IsItsOwnMirrorImage) { expect_mirrored(Car(), Car(bump_right), 0.5); }

// Its rear corners move because their hinges are parallel, its front wheels do not steer for their tie rods; each is
// told.
TEST(VehicleExample, TellsLockedCornersAndFreeSteering) {
  const auto freedoms = [](formats::Scene scene) {
    scene.initial.clear();
    Car car(scene);
    Mobility mobility = count_mobility(car.run.model(), car.run.state(), car.run.workspace.now);
    find_freedoms(car.run.model(), car.run.state(), car.run.workspace.now, mobility);
    return mobility;
  };
  const formats::Scene car = car_scene(example, {});
  const Mobility good = freedoms(car);
  EXPECT_THAT(good.locked, IsEmpty());
  EXPECT_EQ(good.free.size(), 9u) << ::testing::PrintToString(good.free);  // four bounces, four spins, the whole
  EXPECT_EQ(good.free.back(), "'chassis' in 6 directions");

  formats::Scene crossed = car;
  for (formats::JointSpec& joint : crossed.joints)
    if (joint.name == "rear_left/arm_hinge/pin") joint.axis = Vector3d(1.0, 0.1, 0.0);
  EXPECT_THAT(freedoms(crossed).locked,
              UnorderedElementsAre("'rear_left/slide'", "'rear_left/ball'", "'rear_left/arm_hinge/pin'",
                                   "'rear_left/strut_hinge/pin'"));

  formats::Scene loose = car;
  std::erase_if(loose.joints, [](const formats::JointSpec& joint) { return joint.name == "front_left/tie_rod"; });
  const Mobility steering = freedoms(loose);
  EXPECT_EQ(steering.free.size(), 10u);
  EXPECT_TRUE(std::ranges::any_of(steering.free, [](const std::string& name) {
    return name == "a rotation in 'front_left/upper_ball'" || name == "a rotation in 'front_left/lower_ball'";
  })) << ::testing::PrintToString(steering.free);
}

// ---- flexible ---------------------------------------------------------------------------------------------------

/// Cars on the chassis of examples/chassis, reduced into a folder beside the scenes of the car.
class FlexibleCar : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(TISSERAND_BINARY_DIR "/bin/reducer")) GTEST_SKIP() << "built without the reducer";
    for (const auto& entry : std::filesystem::directory_iterator(example))
      if (entry.path().extension() == ".yaml")
        std::filesystem::copy_file(entry.path(), folder_.path() / entry.path().filename());
  }

  void reduce(const std::string& settings) const {
    const std::string command = TISSERAND_BINARY_DIR "/bin/reducer run " TISSERAND_SOURCE_DIR
                                                     "/examples/chassis/chassis.part.yaml --set second_order=no -o " +
                                folder_.file("chassis.superelement.h5") + settings + " > " + folder_.file("log") +
                                " 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }

  static std::string ten_modes(int modes = 10) {
    return " --set 'modal_body={reference: center, modes: " + std::to_string(modes) + "}'";
  }

  Car car(const std::string& chassis, Settings settings = {}) const {
    settings.push_back("include=chassis_" + chassis + ".yaml");
    return Car(car_scene(folder_.path().string(), settings));
  }

  /// Where wheels and hinges are at `end`, one column each.
  static Eigen::Matrix3Xd places(Car car, double end) {
    car.run.run(end);
    const std::vector<std::string> nodes{"front_left/wheel", "front_right/wheel",    "rear_left/wheel",
                                         "rear_right/wheel", "front_left/lower_arm", "rear_left/strut"};
    Eigen::Matrix3Xd x(3, 6);
    for (Eigen::Index k = 0; k < 6; ++k) x.col(k) = car.run.position(nodes[k]);
    return x;
  }

  static double largest(const Eigen::Matrix3Xd& difference) { return difference.colwise().norm().maxCoeff(); }

  test_support::TemporaryFolder folder_;
};

TEST_F(FlexibleCar, IsSymmetric) {
  reduce(ten_modes());
  expect_straight(car("modal", bump_both), 0.3);
  expect_mirrored(car("modal"), car("modal", bump_right), 0.3);
}

// Direct joints, virtual bodies kept and eliminated: the same motion, to what Newton's tolerance leaves.
TEST_F(FlexibleCar, VirtualBodiesChangeNothing) {
  reduce(ten_modes());
  const std::string tight = "integrator.tolerance=1e-11", virtual_bodies = "assemblies.hinge=hinge_virtual.yaml";
  for (const std::string chassis : {"modal", "superelement"}) {
    const Eigen::Matrix3Xd direct = places(car(chassis, {tight}), 0.2);
    EXPECT_LT(largest(places(car(chassis, {tight, virtual_bodies, "virtual_bodies=keep"}), 0.2) - direct), 1e-9)
        << chassis;
    EXPECT_LT(largest(places(car(chassis, {tight, virtual_bodies}), 0.2) - direct), 1e-9) << chassis;
  }
}

// Two sphericals hold what a revolute joint holds. Statics leaves the yaw of a car on flat ground open, here to 1e-6
// rad, and with it the direction in which it sets off.
TEST_F(FlexibleCar, TwoSphericalsAreARevoluteJoint) {
  reduce(ten_modes());
  EXPECT_LT(largest(places(car("modal", {"assemblies.hinge=hinge_sphericals.yaml"}), 0.2) - places(car("modal"), 0.2)),
            1e-5);
}

// With E times 1e4 the chassis is rigid to 1e-3 of what its flexibility changes; deflections fall with 1/E.
TEST_F(FlexibleCar, StiffChassisIsTheRigidOne) {
  reduce("");
  const Eigen::Matrix3Xd rigid = places(car("part_rigid"), 0.25);
  const double soft = largest(places(car("superelement"), 0.25) - rigid);
  EXPECT_GT(soft, 1e-4);
  reduce(" --set materials.steel.E=2.1e15 --set materials.aluminium.E=7e14");
  EXPECT_LT(largest(places(car("superelement"), 0.25) - rigid), 1e-3 * soft);
}

// The superelement keeps eight attachments and 20 modes, consistent masses; the modal body lumped masses and no static
// deflections. What is left between them after 40 modes is what the superelement leaves out and what lumping does.
TEST_F(FlexibleCar, ModalBodyComesToTheSuperelementAsItsModesGrow) {
  reduce(ten_modes(40));
  const Eigen::Matrix3Xd superelement = places(car("superelement"), 0.25);
  const double flexible = largest(places(car("part_rigid"), 0.25) - superelement);
  const auto error = [&](int modes) {
    return largest(places(car("modal", {"bodies.chassis.modes=" + std::to_string(modes)}), 0.25) - superelement) /
           flexible;
  };
  const double few = error(10), many = error(40);
  EXPECT_LT(few, 0.3);
  EXPECT_LT(many, 0.12);
  EXPECT_LT(many, 0.5 * few);
}

// ---- examples/manoeuvres ----------------------------------------------------------------------------------------

formats::Scene manoeuvre(const std::string& name) {
  const formats::Scene scene =
      formats::read_scene(TISSERAND_SOURCE_DIR "/examples/manoeuvres/" + name + ".scene.yaml", {});
  return scene.analyses.empty() ? scene : formats::scene_of(scene, scene.analyses.back());
}

class Manoeuvres : public ::testing::TestWithParam<const char*> {};

// 980 kg stand on four tyres by a file, left and right alike (but for the 8e-7 m that the rack of `steady_circle` is
// off its middle, and the friction of `split_braking`), and start at speed with rolling wheels: slips are those of the
// rolling radius that the scene writes with three digits.
TEST_P(Manoeuvres, StartFromTheStandingCar) {
  Car car(manoeuvre(GetParam()));
  double sum = 0.0;
  for (const TyreTerms& tyre : car.loads) sum += tyre.force.z();
  EXPECT_NEAR(sum, 980.0 * g, 1e-5);
  EXPECT_NEAR(car.loads[0].force.z(), car.loads[1].force.z(), 0.01);
  EXPECT_NEAR(car.loads[2].force.z(), car.loads[3].force.z(), 0.01);
  car.run.run(0.1);
  for (const TyreTerms& tyre : car.tyres()) {
    EXPECT_LT(std::abs(tyre.slip), 5e-3);
    EXPECT_LT(std::abs(tyre.slip_angle), 2e-3);  // toe that the travel of the wheel makes
  }
  EXPECT_LT(std::abs(car.run.position("chassis").y()), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Every, Manoeuvres,
                         ::testing::Values("step_steer", "steady_circle", "lane_change", "split_braking"));

// Steady cornering is that of the linear bicycle, r = V δ/(L + K V²), within its understeer gradient: K = m_f/C_f −
// m_r/C_r = −5.6e-4 rad s²/m by the cornering stiffness of the file at the static loads, −2.2e-4 with the aligning
// moments; at 4 m/s² load transfer and camber take some per cent.
TEST(ManoeuvresExample, StepSteerTurnsAsTheBicycle) {
  formats::Scene scene = manoeuvre("step_steer");
  scene.integrator.step = 0.005;
  Car car(scene);
  car.run.run(3.5);
  const auto heading = [&](const char* node) {
    const Eigen::Matrix3d R = car.turn(node);
    return std::atan2(R(1, 0), R(0, 0));
  };
  const double steer = 0.5 * (heading("front_left/knuckle") + heading("front_right/knuckle")) - heading("chassis");
  const double V = car.run.velocity("chassis").norm();
  const double rate = (car.turn("chassis") * car.run.Omega("chassis")).z();
  EXPECT_GT(rate, 0.15);
  EXPECT_NEAR(rate, V * steer / (2.18 - 3.9e-4 * V * V), 0.08 * rate);
}

// The strut of the rear corner in the plane y, z: the arm turns about A, the axis of the strut passes the top T, and
// the hub slides on it with B at the end of the arm: the angle of the axis is that of TB less asin(e/|TB|) with the
// constant distance e of B from it.
TEST(ManoeuvresExample, RearSuspensionMovesAsItsPlaneMechanism) {
  using Eigen::Vector2d;
  const Vector2d T(0.54, 0.72), A(0.25, 0.175), B0(0.64, 0.16), W0(0.73, 0.3), S(0.625, 0.33);
  const auto cross = [](const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  const auto angle = [](const Vector2d& a) { return std::atan2(a.y(), a.x()); };
  const double e = cross((S - T).normalized(), B0 - T);
  const auto axis_angle = [&](const Vector2d& B) { return angle(B - T) - std::asin(e / (B - T).norm()); };
  const auto wheel_at = [&](double arm, double& turn) {
    const Vector2d B = A + Eigen::Rotation2Dd(arm) * (B0 - A);
    turn = axis_angle(B) - axis_angle(B0);
    return Vector2d(B + Eigen::Rotation2Dd(turn) * (W0 - B0));
  };
  Simulation rig(manoeuvre("suspension"), {});
  rig.start();
  double highest = 0.0;
  for (int i = 1; i <= 30; ++i) {
    const StepReport step =
        move_along(rig.model(), rig.scene.integrator, {0.0125 * i, 0.0125 * i}, rig.state(), rig.workspace);
    ASSERT_EQ(step.outcome, StepOutcome::accepted);
    const Vector3d wheel = rig.position("rear/wheel");
    double low = -0.3, high = 0.3, turn = 0.0;  // of the arm, at whose ends the wheel is 0.1 m lower and higher
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (wheel_at(middle, turn).y() < wheel.z() ? low : high) = middle;
    }
    const Vector2d expected = wheel_at(low, turn);
    EXPECT_NEAR(wheel.y(), expected.x(), 1e-10);
    const Eigen::Matrix3d R = rig.rotation("rear/hub").toRotationMatrix();
    EXPECT_NEAR(std::atan2(R(2, 1), R(1, 1)), turn, 1e-10);
    highest = std::max(highest, wheel.z() - 0.3);
  }
  EXPECT_GT(highest, 0.079);
}

}  // namespace
}  // namespace tisserand::mechanism::car_test
