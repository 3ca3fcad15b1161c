// SPDX-License-Identifier: GPL-3.0-or-later
// Linearised modes against closed formulas and published frequencies: pendulums, tops, cantilevers at rest and turning.
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "mechanism/analyses/linearise.hpp"
#include "mechanism/analyses/modes.hpp"
#include "mechanism/analyses/statics.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::modes_test {
namespace {

using Eigen::Vector3d;
using formats::JointKind;
using test_support::empty_scene;
using test_support::joint;
using test_support::rigid_body;
using test_support::Simulation;

const Vector3d z = Vector3d::UnitZ();

ModesReport modes_of(Simulation& run, const formats::ModesSpec& spec) {
  solve_accelerations(run.model(), 1e-3, "test", run.state(), run.workspace);
  return solve_modes(run.model(), run.state(), spec, run.workspace.now);
}

/// Modes of the scene at its start.
ModesReport modes_of(const formats::Scene& scene, const SuperelementFiles& files) {
  Simulation run(scene, files);
  run.start();
  return modes_of(run, {});
}

std::vector<double> angular_frequencies(const ModesReport& report) {
  std::vector<double> list;
  for (const Mode& mode : report.modes) list.push_back(std::abs(mode.eigenvalue));
  return list;
}

/// Scene of a body that hangs (1) or stands (−1) on a hinge about z in gravity along −y.
formats::Scene hanging(double side) {
  formats::Scene scene = empty_scene(1e-3, 1.0);
  scene.gravity = {0, -9.81, 0};
  scene.bodies.push_back(rigid_body("arm", 1.5, {0, -0.8 * side, 0}, {0.05, 0.2, 0.2}));
  scene.joints.push_back(joint("hinge", JointKind::revolute, "ground", "arm", Vector3d::Zero(), z));
  return scene;
}

formats::SpringSpec spring_along(const std::string& joint, double stiffness, double damping = 0.0) {
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.coordinate = formats::CoordinateRef{joint, ""};
  spring.stiffness = stiffness;
  spring.damping = damping;
  return spring;
}

// ω² = m g a / (J + m a²).
const double pendulum_frequency = std::sqrt(1.5 * 9.81 * 0.8 / (0.2 + 1.5 * 0.64));

TEST(Modes, OfAPendulum) {
  const ModesReport report = modes_of(hanging(1.0), {});
  ASSERT_EQ(report.modes.size(), 1u);
  EXPECT_EQ(report.degrees_of_freedom, 1);
  EXPECT_NEAR(std::abs(report.modes[0].eigenvalue), pendulum_frequency, 1e-10 * pendulum_frequency);
  EXPECT_NEAR(report.modes[0].damping_ratio(), 0.0, 1e-9);
  EXPECT_FALSE(report.modes[0].unstable);
  EXPECT_LT(report.largest_acceleration, 1e-12);
}

TEST(Modes, OfAStandingPendulumGrow) {
  const ModesReport report = modes_of(hanging(-1.0), {});
  ASSERT_EQ(report.modes.size(), 2u);
  for (const Mode& mode : report.modes) {
    EXPECT_NEAR(std::abs(mode.eigenvalue.real()), pendulum_frequency, 1e-9 * pendulum_frequency);
    EXPECT_EQ(mode.unstable, mode.eigenvalue.real() > 0.0);
  }
  EXPECT_NE(report.modes[0].unstable, report.modes[1].unstable);
}

// J θ'' + c θ' + (k + m g a) θ = 0.
TEST(Modes, SeeSpringsAndDampers) {
  formats::Scene scene = hanging(1.0);
  scene.springs.push_back(spring_along("hinge", 30.0, 1.7));
  const ModesReport report = modes_of(scene, {});
  ASSERT_EQ(report.modes.size(), 1u);
  const double J = 0.2 + 1.5 * 0.64, k = 30.0 + 1.5 * 9.81 * 0.8, omega = std::sqrt(k / J);
  EXPECT_NEAR(std::abs(report.modes[0].eigenvalue), omega, 1e-9 * omega);
  EXPECT_NEAR(report.modes[0].damping_ratio(), 1.7 / (2.0 * std::sqrt(k * J)), 1e-9);
}

// Two equal uniform rods of length a: ω² = (3 ∓ 6/√7) g/a.
TEST(Modes, OfADoublePendulumOfRods) {
  formats::Scene scene = empty_scene(1e-3, 1.0);
  scene.gravity = {0, -9.81, 0};
  for (int i = 0; i < 2; ++i) {
    formats::RigidBodySpec rod = rigid_body("rod" + std::to_string(i), 2.0, {0, -0.5, 0}, {1.0 / 6, 1e-3, 1.0 / 6});
    rod.start.pose.position = {0, -1.0 * i, 0};
    scene.bodies.push_back(rod);
  }
  scene.joints.push_back(joint("top", JointKind::revolute, "ground", "rod0", Vector3d::Zero(), z));
  scene.joints.push_back(joint("knee", JointKind::revolute, "rod0", "rod1", {0, -1, 0}, z));
  const std::vector<double> omega = angular_frequencies(modes_of(scene, {}));
  ASSERT_EQ(omega.size(), 2u);
  EXPECT_NEAR(omega[0], std::sqrt((3.0 - 6.0 / std::sqrt(7.0)) * 9.81), 1e-9);
  EXPECT_NEAR(omega[1], std::sqrt((3.0 + 6.0 / std::sqrt(7.0)) * 9.81), 1e-9);
}

// ---- sleeping top: A ζ'' − i C n ζ' − m g l ζ = 0 for the complex tilt ζ -------------------------------------------

struct Top {
  static constexpr double mass = 2.0, arm = 0.3, J = 0.05, C = 0.08, g = 9.81;
  static double A() { return J + mass * arm * arm; }
  /// C n ± √(C² n² − 4 A m g l) over 2 A.
  static double root(double n) { return std::sqrt(C * C * n * n - 4.0 * A() * mass * g * arm); }
  static double least_spin() { return std::sqrt(4.0 * A() * mass * g * arm) / C; }

  static formats::Scene scene(double spin) {
    formats::Scene scene = empty_scene(1e-3, 1.0);
    scene.gravity = {0, 0, -g};
    formats::RigidBodySpec top = rigid_body("top", mass, {0, 0, arm}, {J, J, C});
    top.start.angular_velocity = {0, 0, spin};
    scene.bodies.push_back(top);
    scene.joints.push_back(joint("pivot", JointKind::spherical, "ground", "top", Vector3d::Zero(), z));
    return scene;
  }
};

TEST(Modes, OfASleepingTopInAxesAtRest) {
  const double n = 1.5 * Top::least_spin();
  const ModesReport report = modes_of(Top::scene(n), {});
  ASSERT_EQ(report.modes.size(), 3u);
  EXPECT_EQ(report.rigid, 1);  // the spin
  const double slow = (Top::C * n - Top::root(n)) / (2.0 * Top::A()),
               fast = (Top::C * n + Top::root(n)) / (2.0 * Top::A());
  EXPECT_NEAR(std::abs(report.modes[1].eigenvalue), slow, 1e-8 * fast);
  EXPECT_NEAR(std::abs(report.modes[2].eigenvalue), fast, 1e-8 * fast);
  for (const Mode& mode : report.modes) EXPECT_FALSE(mode.unstable);
}

// In axes that turn with the top every frequency ω becomes |ω − n|.
TEST(Modes, OfASleepingTopInAxesThatTurnWithIt) {
  const double n = 1.5 * Top::least_spin();
  Simulation run(Top::scene(n), {});
  run.start();
  formats::ModesSpec spec;
  spec.rotation = Vector3d(0, 0, n);
  std::vector<double> omega = angular_frequencies(modes_of(run, spec));
  ASSERT_EQ(omega.size(), 3u);
  std::vector<double> expected{std::abs((Top::C * n - Top::root(n)) / (2.0 * Top::A()) - n),
                               std::abs((Top::C * n + Top::root(n)) / (2.0 * Top::A()) - n)};
  std::sort(expected.begin(), expected.end());
  EXPECT_NEAR(omega[1], expected[0], 1e-8 * n);
  EXPECT_NEAR(omega[2], expected[1], 1e-8 * n);
}

TEST(Modes, OfATopThatSpinsTooSlowlyGrow) {
  const double n = 0.5 * Top::least_spin();
  const ModesReport report = modes_of(Top::scene(n), {});
  // λ = i C n/2A ± √(4 A m g l − C² n²)/2A
  const double growth =
      std::sqrt(4.0 * Top::A() * Top::mass * Top::g * Top::arm - Top::C * Top::C * n * n) / (2.0 * Top::A());
  double largest = 0.0;
  for (const Mode& mode : report.modes)
    if (mode.unstable) largest = std::max(largest, mode.eigenvalue.real());
  EXPECT_NEAR(largest, growth, 1e-8 * growth);
}

// ---- damping by ratios of the free modes --------------------------------------------------------------------------

/// A steel bar of unequal bending stiffnesses, in four elements reduced with `modes` internal modes (0: Guyan).
ModesReport damped_bar(int modes, const formats::Damping& damping, std::optional<JointKind> at_base) {
  formats::Scene scene = empty_scene(1e-3, 1.0);
  formats::SuperelementBodySpec body = test_support::superelement_body("bar", "bar");
  body.damping = damping;
  scene.bodies.push_back(body);
  if (at_base) scene.joints.push_back(joint("base", *at_base, "ground", "bar/base", Vector3d::Zero(), z));
  SuperelementFiles files;
  test_support::add_file("bar", test_support::craig_bampton_beam({}, modes), files);
  Simulation run(scene, files);
  run.start();
  formats::ModesSpec spec;
  spec.count = 40;
  return modes_of(run, spec);
}

// D = M Phi diag(2 zeta omega) Phi^T M: each elastic mode of the free body, lowest first, has its ratio, and each rigid
// motion none. LAPACK's eigenvalues are good to round-off times the square of the spread of frequencies, 1e4 here.
TEST(Modes, RatiosAreThoseOfTheElasticModesOfTheFreeBody) {
  for (const int modes : {0, 4}) {
    formats::Damping damping;
    damping.ratio = 0.01;
    damping.ratios = {0.05, 0.3};
    const ModesReport report = damped_bar(modes, damping, {});
    EXPECT_EQ(report.rigid, 6);
    ASSERT_EQ(report.modes.size(), static_cast<std::size_t>(12 + modes));
    for (std::size_t k = 6; k < report.modes.size(); ++k)
      EXPECT_NEAR(report.modes[k].damping_ratio(), k == 6 ? 0.05 : k == 7 ? 0.3 : 0.01, 1e-7) << modes << ' ' << k;
  }
}

// With A = M^-1 S of the free body, a mode psi of the jointed one (psi' M psi = 1) has zeta <A^(1/2) psi, psi>/omega =
// zeta sum c_k^2 omega_k/omega, c_k its part along the free mode k: at most zeta (Cauchy and Schwarz), and less the
// more of it is rigid motion. Continuous bar, its parts by Simpson's rule over nine free modes (the rest adds 6e-4 at
// most): clamped 0.0719, pinned 0.6625. Internal modes, whose boundary is held, hardly see the first.
TEST(Modes, RatiosOfAJointedBodyAreThePartThatItsShapeHasInTheFreeModes) {
  formats::Damping free, internal;
  free.ratio = internal.ratio_internal = 0.01;
  for (const JointKind kind : {JointKind::fixed, JointKind::revolute}) {
    for (const int modes : {0, 4, 8})
      for (const Mode& mode : damped_bar(modes, free, kind).modes) EXPECT_LE(mode.damping_ratio(), 0.01 * (1.0 + 1e-6));
    const ModesReport fine = damped_bar(8, free, kind), held = damped_bar(8, internal, kind);
    const auto first = static_cast<std::size_t>(fine.rigid);
    EXPECT_NEAR(fine.modes[first].damping_ratio(), 7.22e-4, 1e-5);           // across the free axis: clamped
    const double second = kind == JointKind::revolute ? 6.625e-3 : 7.22e-4;  // pinned in the other plane
    EXPECT_NEAR(fine.modes[first + 1].damping_ratio(), second, 1e-2 * second);
    EXPECT_LT(held.modes[first].damping_ratio(), 0.05 * fine.modes[first].damping_ratio());
  }
}

// ---- cantilevers ---------------------------------------------------------------------------------------------------

/// Slender square bar of unit length: EA L²/EI = 1.2e5, so that shear, rotary inertia and stretch stay below 1e-3.
struct Bar {
  static constexpr double side = 0.01, young = 2e11, density = 8000.0;
  static double area() { return side * side; }
  static double inertia() { return side * side * side * side / 12.0; }
  /// √(EI/ρA)/L²: the unit of the frequencies.
  static double unit() { return std::sqrt(young * inertia() / (density * area())); }

  static formats::BeamBodySpec beam(int elements) {
    formats::BeamBodySpec beam;
    beam.name = "bar";
    beam.to = {1, 0, 0};
    beam.elements = elements;
    beam.nodes_per_element = 3;
    beam.section.area = area();
    beam.section.second_moment_y = beam.section.second_moment_z = inertia();
    beam.section.polar_moment = 2.0 * inertia();
    beam.section.torsion_constant = 1.69 * inertia();
    beam.section.shear_area_y = beam.section.shear_area_z = area() / 1.2;
    beam.material.youngs_modulus = young;
    beam.material.poisson_ratio = 0.3;
    beam.material.density = density;
    return beam;
  }

  /// A piece of 1/count of the length, with internal modes.
  static formats::Superelement piece(int count) {
    test_support::BeamData data;
    data.length = 1.0 / count;
    data.young = young;
    data.shear_modulus = young / 2.6;
    data.density = density;
    data.area = area();
    data.Iy = data.Iz = inertia();
    data.J = 1.69 * inertia();
    return test_support::craig_bampton_beam(data, 4);
  }

  static void add_pieces(int count, formats::Scene& scene, SuperelementFiles& files) {
    test_support::add_file("piece", piece(count), files);
    for (int i = 0; i < count; ++i) {
      formats::SuperelementBodySpec body = test_support::superelement_body("p" + std::to_string(i), "piece");
      body.start.pose.position = {i * (1.0 / count), 0, 0};
      scene.bodies.push_back(body);
      if (i > 0)
        scene.joints.push_back(joint("weld" + std::to_string(i), JointKind::fixed, "p" + std::to_string(i - 1) + "/tip",
                                     "p" + std::to_string(i) + "/base", {i * (1.0 / count), 0, 0}, z));
    }
  }
};

// β² = 3.51602, 22.0345, 61.6972 (Euler-Bernoulli), each twice for the square section.
TEST(Modes, OfACantileverOfNonlinearBeams) {
  formats::Scene scene = empty_scene(1e-3, 1.0);
  scene.bodies.push_back(Bar::beam(10));
  scene.joints.push_back(joint("wall", JointKind::fixed, "ground", "bar/start", Vector3d::Zero(), z));
  const std::vector<double> omega = angular_frequencies(modes_of(scene, {}));
  ASSERT_GE(omega.size(), 4u);
  // Shear and rotary inertia lower the second by 22² (1 + 2.6 · 1.2) 8.3e-6 / 2 = 8e-4; ten quadratic elements less.
  for (const int k : {0, 1}) EXPECT_NEAR(omega[k] / Bar::unit(), 3.516015, 3.516015 * 5e-4);
  for (const int k : {2, 3}) EXPECT_NEAR(omega[k] / Bar::unit(), 22.034492, 22.034492 * 2e-3);
}

TEST(Modes, OfACantileverOfOneSuperelement) {
  formats::Scene scene = empty_scene(1e-3, 1.0);
  SuperelementFiles files;
  Bar::add_pieces(1, scene, files);
  scene.joints.push_back(joint("wall", JointKind::fixed, "ground", "p0/base", Vector3d::Zero(), z));
  const std::vector<double> omega = angular_frequencies(modes_of(scene, files));
  ASSERT_GE(omega.size(), 4u);
  // Ritz: from above. The mesh of four cubic elements has 1e-4 in the second frequency, four modes (two a plane) 1e-3.
  for (const int k : {0, 1}) EXPECT_NEAR(omega[k] / Bar::unit(), 3.516015, 3.516015 * 5e-4);
  for (const int k : {2, 3}) EXPECT_NEAR(omega[k] / Bar::unit(), 22.034492, 22.034492 * 5e-3);
}

/// Scene of two stiff bars in a row on a hinge, with a hinge between them.
formats::Scene hinged_bars() {
  formats::Scene scene = empty_scene(1e-3, 1.0);
  for (int i = 0; i < 2; ++i) {
    formats::BeamBodySpec bar = Bar::beam(2);
    bar.name = "bar" + std::to_string(i);
    bar.section.area *= 6.0;  // stiff along its axis
    bar.start.pose.position = {1.0 * i, 0, 0};
    bar.start.pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * i, z));
    scene.bodies.push_back(bar);
  }
  scene.joints.push_back(joint("main", JointKind::revolute, "ground", "bar0/start", Vector3d::Zero(), z));
  scene.joints.push_back(joint("knee", JointKind::revolute, "bar0/end", "bar1/start", {1, 0, 0}, z));
  return scene;
}

// A soft spring holds the first bar, and nothing holds the second: frequencies from 0 to 1e5 Hz. At rest and undamped
// they are those of K φ = ω² M φ, solved here as a symmetric problem (LAPACK's error: round-off of the largest ω²). In
// a basis that is not graded, the lower ω² erred by 2 to 5 %, and the rigid motion had a frequency.
TEST(Modes, OfStiffBarsBelowASoftSpringAreThoseOfTheSymmetricProblem) {
  formats::Scene scene = hinged_bars();
  scene.springs.push_back(spring_along("main", 8.0));
  Simulation run(scene, SuperelementFiles{});
  run.start();
  formats::ModesSpec all;
  all.count = 1000;
  const ModesReport report = modes_of(run, all);
  const Linearisation l = linearise(run.model(), run.state(), Vector3d::Zero(), run.workspace.now);
  const Eigen::MatrixXd Z = null_space(run.model(), l.B);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> symmetric(Z.transpose() * l.K * Z,
                                                                            Z.transpose() * l.M * Z);
  ASSERT_EQ(static_cast<Eigen::Index>(report.modes.size()), symmetric.eigenvalues().size());
  EXPECT_EQ(report.rigid, 1);
  const double largest = symmetric.eigenvalues().maxCoeff();
  for (std::size_t k = 0; k < report.modes.size(); ++k) {
    const double square = symmetric.eigenvalues()[static_cast<Eigen::Index>(k)],
                 omega = std::abs(report.modes[k].eigenvalue);
    EXPECT_NEAR(omega * omega, square, 1e-7 * square + 1e-14 * largest) << k;
    EXPECT_FALSE(report.modes[k].unstable) << k;
    EXPECT_LT(std::abs(report.modes[k].eigenvalue.real()), 1e-7 * omega + 1e-12) << k;  // growth_tolerance
  }
}

// Round-off of the bars, 1e-15 of 1e8 N/m, must not hide a gram on 1e-8 N/m, which no joint ties to them: ω = √(k/m).
TEST(Modes, OfASoftMassBesideStiffBarsAreItsOwn) {
  formats::Scene scene = hinged_bars();
  scene.bodies.push_back(rigid_body("mote", 1e-3, {0, 0, 0}, {1e-6, 1e-6, 1e-6}));
  scene.joints.push_back(joint("guide", JointKind::prismatic, "ground", "mote", {0, 0, 0}, z));
  scene.springs.push_back(spring_along("guide", 1e-8));
  const ModesReport report = modes_of(scene, {});
  EXPECT_EQ(report.rigid, 2);  // of the bars
  const double omega = std::sqrt(1e-8 / 1e-3);
  EXPECT_THAT(angular_frequencies(report), ::testing::Contains(::testing::DoubleNear(omega, 1e-6 * omega)));
}

// A block slides in an inclined plane under a load and its weight, which the joint bears in part. Its stiffness is
// round-off alone, which made growing motions or frequencies of two rigid ones.
TEST(Modes, OfABlockThatSlidesFreelyAreRigid) {
  for (const double degrees : {30.0, 120.0, 200.0}) {
    formats::Scene scene = empty_scene(1e-3, 1.0);
    scene.gravity = {3.1, 6.3, -7.0};
    formats::RigidBodySpec block = rigid_body("block", 1.9, {0, 0, 0}, {0.057, 0.095, 0.071});
    block.start.pose.orientation =
        Eigen::Quaterniond(Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vector3d(2, 3, 6) / 7.0));
    formats::RigidNodeSpec tip;
    tip.name = "tip";
    tip.pose.position = {0.1, 0.4, 0};
    block.nodes.push_back(tip);
    scene.bodies.push_back(block);
    formats::JointSpec guide =
        joint("guide", JointKind::generic, "ground", "block", Vector3d::Zero(), {0.74, 0.31, 0.60});
    guide.x_axis = Vector3d(-0.45, 0.89, 0.1);
    guide.hold = {false, false, true, true, true, true};
    scene.joints.push_back(guide);
    scene.loads.push_back(test_support::constant_load("push", formats::LoadKind::force, "block/tip", {-1.4, 1.1, 1.2}));
    const ModesReport report = modes_of(scene, {});
    EXPECT_EQ(report.modes.size(), 2u) << degrees;
    EXPECT_EQ(report.rigid, 2) << degrees;
  }
}

/// Frequencies [Bar::unit()] of the first chordwise and two flap modes of the bar in steady rotation about z with γ.
struct Turning {
  double chord = 0.0, flap = 0.0, second_flap = 0.0;
};

Turning turning_bar(double gamma, formats::Scene scene, const SuperelementFiles& files, const std::string& root) {
  const double rate = gamma * Bar::unit();
  scene.analysis = formats::AnalysisKind::statics;
  scene.joints.push_back(joint("hub", JointKind::revolute, "ground", root, Vector3d::Zero(), z));
  scene.motions.push_back(test_support::drive("hub", fmt::format("{:.17g} * t", rate)));
  scene.statics.rotation = formats::RotationSpec{Vector3d(0, 0, rate), Vector3d::Zero()};
  Simulation run(scene, files);
  run.start();
  const StaticsReport statics = solve_statics(run.model(), scene.statics, {}, run.state(), run.workspace);
  EXPECT_EQ(statics.outcome, StepOutcome::accepted) << statics.explanation;
  formats::ModesSpec spec;
  spec.rotation = Vector3d(0, 0, rate);
  const ModesReport report = modes_of(run, spec);
  EXPECT_LT(report.largest_acceleration, 1e-5 * rate * rate);
  Turning result;
  for (const Mode& mode : report.modes) {
    const Node& tip = run.model().nodes.back();
    const Eigen::Vector3cd shape = mode.shape.segment<3>(tip.translation);
    const bool flapping = std::abs(shape.z()) > std::abs(shape.y());
    const double omega = std::abs(mode.eigenvalue) / Bar::unit();
    double& wanted = !flapping ? result.chord : result.flap == 0.0 ? result.flap : result.second_flap;
    if (wanted == 0.0) wanted = omega;
  }
  return result;
}

/// Published frequencies. The rows of the file are γ = 0, 1, 2, ...
Turning reference_at(int gamma) {
  const std::vector<double> row =
      test_support::reference_rows("rotating_cantilever_frequencies.csv").at(static_cast<std::size_t>(gamma));
  return {row.at(4), row.at(1), row.at(2)};
}

// Wright et al. 1982, Yoo and Shin 1998, recomputed (references/README.md): inextensible Euler-Bernoulli beam.
TEST(TurningCantilever, OfNonlinearBeamsHasThePublishedFrequencies) {
  formats::Scene scene = empty_scene(1e-3, 1.0);
  scene.bodies.push_back(Bar::beam(10));
  const Turning found = turning_bar(6.0, scene, {}, "bar/start"), published = reference_at(6);
  EXPECT_NEAR(found.flap, published.flap, 1e-3 * published.flap);
  EXPECT_NEAR(found.chord, published.chord, 1e-3 * published.chord);
  EXPECT_NEAR(found.second_flap, published.second_flap, 2e-3 * published.second_flap);
}

/// Relative error of flap 1 at γ = 5. At γ = 6, where 12 EI/L³ = ω² m/3, one linear body is unstable in the plane.
double flap_error(int pieces) {
  formats::Scene scene = empty_scene(1e-3, 1.0);
  SuperelementFiles files;
  Bar::add_pieces(pieces, scene, files);
  return turning_bar(5.0, scene, files, "p0/base").flap / reference_at(5).flap - 1.0;
}

// One linear body lacks the stiffening by its tension. N bodies have it by the rotation of each, with an error ~ 1/N².
TEST(TurningCantilever, NeedsSeveralSuperelements) {
  const double one = flap_error(1), two = flap_error(2), four = flap_error(4), eight = flap_error(8);
  EXPECT_LT(one, -0.05);
  EXPECT_LT(std::abs(four), 0.02);
  const double order = std::log2(four / eight);
  EXPECT_GT(order, 1.5);
  EXPECT_LT(order, 2.5);
  EXPECT_LT(std::abs(two), std::abs(one));
}

}  // namespace
}  // namespace tisserand::mechanism::modes_test
