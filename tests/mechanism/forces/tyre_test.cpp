// SPDX-License-Identifier: GPL-3.0-or-later
// Tyres at one instant, of every law: contact of the disc, tangents by differences, power, relaxation, and limits
// without jumps.
#include "mechanism/tyres/tyre.hpp"

#include <cmath>
#include <random>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "formats/tyres/tyre_property_file.hpp"
#include "mechanism/tyres/contact.hpp"
#include "tests/support/bodies/superelement_cases.hpp"

namespace tisserand::mechanism::tyre_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using formats::RoadPieceShape;
using test_support::random_vector;

formats::RoadSpec plane() { return {}; }

/// A bump on the left, a trapezoid on the right, on a road that is turned and moved.
formats::RoadSpec bumpy() {
  formats::RoadSpec road;
  road.kind = formats::RoadKind::profile;
  road.pose.position = {0.2, -0.1, 0.3};
  road.pose.orientation = Eigen::Quaterniond(exp_so3<double>(Vector3d(0.1, -0.15, 0.4)));
  road.transition = 0.3;
  road.left = {{RoadPieceShape::cosine, -0.5, 1.0, 0.1, 0.0, {}}, {RoadPieceShape::cosine, 0.0, 3.0, 0.02, 0.0, {}}};
  road.right = {{RoadPieceShape::trapezoid, -1.0, 3.0, 0.05, 0.4, {}}};
  return road;
}

Tyre car_tyre() {
  Tyre tyre;
  tyre.radius = 0.3101;
  tyre.stiffness = 190e3;
  tyre.damping = 500.0;
  tyre.law = ComprehensiveSlip{80e3, 60e3, 3e3, 1.0, 0.75};
  tyre.rolling_resistance = 0.015;
  tyre.low_speed = 0.1;
  return tyre;
}

/// A tyre by the file, of the size of the one above.
Tyre file_tyre(const std::string& file) {
  Tyre tyre = car_tyre();
  MagicFormulaLaw law;
  law.p = formats::read_tyre_property_file(std::string(TISSERAND_REFERENCES) + "/magic_formula/" + file + ".tir",
                                           Units::si())
              .coefficients;
  tyre.law = law;
  tyre.progressive = 100e3;
  tyre.rolling_resistance = 0.0;
  return tyre;
}

/// Both laws, both versions of the Magic Formula, with and without relaxation.
std::vector<Tyre> all_tyres() {
  std::vector<Tyre> tyres{car_tyre(), file_tyre("book_205_60R15"), file_tyre("synthetic_pac2002_all")};
  for (int i = 0; i < 3; ++i) {
    tyres.push_back(tyres[i]);
    tyres.back().relaxation = 0.4;
    tyres.back().lag = 0;
  }
  return tyres;
}

struct Wheel {
  Tyre tyre = car_tyre();
  Tread tread;
  Road road{plane(), Vector3d::Zero()};
  NodeMotion node;

  TyreTerms terms() const {
    TyreTerms terms;
    evaluate(tyre, road, node, tread, terms);
    return terms;
  }
  double dissipated() const { return dissipated_power(tyre, road, node, terms()); }
  /// Force on the wheel and its moment about the origin of the world, world axes.
  Vector6d wrench() const {
    const TyreTerms at = terms();
    Vector6d w;
    w.head<3>() = -at.residual.head<3>();
    w.tail<3>() = -node.R * at.residual.tail<3>() - node.x.cross(at.residual.head<3>());
    return w;
  }
  Wheel moved(const Vector6d& d) const {
    Wheel w = *this;
    w.node.x += d.head<3>();
    w.node.R = (node.R * exp_so3<double>(Vector3d(d.tail<3>()))).eval();
    return w;
  }
  Wheel faster(const Vector6d& d) const {
    Wheel w = *this;
    w.node.xd += d.head<3>();
    w.node.Omega += d.tail<3>();
    return w;
  }
  Wheel deflected(const Eigen::Vector2d& dw, const Eigen::Vector2d& dwd) const {
    Wheel w = *this;
    w.tread.w += dw;
    w.tread.wd += dwd;
    return w;
  }
  Vector8d residual() const {
    const TyreTerms at = terms();
    Vector8d r;
    r << at.residual, at.lag;
    return r;
  }
};

/// Upright on the plane z = 0, 10 mm deep, forward at V, turning at Omega.
Wheel rolling(double V, double Omega, double depth = 0.01) {
  Wheel wheel;
  wheel.node.x = {0.0, 0.0, wheel.tyre.radius - depth};
  wheel.node.xd = {V, 0.0, 0.0};
  wheel.node.Omega = {0.0, Omega, 0.0};
  return wheel;
}

/// In touch with the road, up to 0.3 rad inclined, with offsets and any motion; `speed` of its size.
Wheel random_wheel(unsigned seed, bool on_plane, double speed, const Tyre& tyre = car_tyre()) {
  std::mt19937 random(seed);
  Wheel wheel;
  wheel.tyre = tyre;
  wheel.road = Road(on_plane ? plane() : bumpy(), Vector3d::Zero());
  wheel.tyre.wheel.p = random_vector(random, 0.3);
  wheel.tyre.wheel.R = exp_so3<double>(random_vector(random, 1.0));
  const Matrix3d R_WD = wheel.road.R * exp_so3<double>(random_vector(random, 0.3));  // axes of the disc
  wheel.node.R = R_WD * wheel.tyre.wheel.R.transpose();
  const Vector3d at = random_vector(random, 0.4);
  const Vector3d center(at.x(), at.y(), wheel.road.at(at.x(), at.y()).value + wheel.tyre.radius - 0.03);
  wheel.node.x = wheel.road.p + wheel.road.R * center - wheel.node.R * wheel.tyre.wheel.p;
  wheel.node.xd = random_vector(random, speed);
  wheel.node.Omega = random_vector(random, speed);
  if (tyre.relaxes()) {
    wheel.tread.w = 0.02 * random_vector(random, 1.0).head<2>();
    wheel.tread.wd = random_vector(random, speed).head<2>();
  }
  return wheel;
}

// A disc on a plane in closed form: distance d of the centre, camber γ: penetration R₀ cos γ − d, loaded radius
// d/cos γ; x = e × n/|e × n| across the axle in the plane, for every inclination of the plane.
TEST(DiscContact, IsExactOnPlanesOfAnyInclination) {
  std::mt19937 random(5);
  for (int i = 0; i < 50; ++i) {
    formats::RoadSpec spec;
    spec.pose.position = random_vector(random, 2.0);
    spec.pose.orientation = Eigen::Quaterniond(exp_so3<double>(random_vector(random, 3.0)));
    const Road road(spec, Vector3d::Zero());
    const Matrix3d tilt = exp_so3<double>(random_vector(random, 0.4));
    const Vector3d e = road.R * tilt.col(1), n = road.R.col(2);
    const double d = 0.28;
    const Vector3d center = road.p + road.R * Vector3d(random_vector(random, 1.0).x(), 2.0, d);
    const DiscContact<double> c = find_contact<double>(road, 0.31, {center, e, Vector3d::Zero(), Vector3d::Zero()});
    const double camber = std::asin(e.dot(n));
    ASSERT_TRUE(c.exists);
    EXPECT_NEAR(c.penetration, 0.31 * std::cos(camber) - d, 1e-14);
    EXPECT_NEAR(c.radius, d / std::cos(camber), 1e-14);
    EXPECT_LT((c.n - n).norm(), 1e-14);
    EXPECT_LT((c.x - e.cross(n).normalized()).norm(), 1e-14);
    EXPECT_LT((c.y - c.n.cross(c.x)).norm(), 1e-14);
    EXPECT_NEAR((c.point - road.p).dot(n), 0.0, 1e-14);
    EXPECT_NEAR((c.point - center).dot(e), 0.0, 1e-14);
  }
}

TEST(Road, HeightsAreThoseOfTheirFormulasAndSlopesTheirDerivatives) {
  const Road road(bumpy(), Vector3d::Zero());
  EXPECT_NEAR(road.at(0.0, 5.0).value, 0.1, 1e-15);                 // top of the first cosine
  EXPECT_NEAR(road.at(1.5, 5.0).value, 0.02, 1e-15);                // top of the second
  EXPECT_NEAR(road.at(-0.8, -5.0).value, 0.05 * 0.2 / 0.4, 1e-15);  // half of a ramp
  EXPECT_NEAR(road.at(0.0, -5.0).value, 0.05, 1e-15);               // top of the trapezoid
  EXPECT_NEAR(road.at(0.0, 0.0).value, 0.5 * (0.1 + 0.05), 1e-15);  // halfway between the tracks
  EXPECT_EQ(road.at(-5.0, 1.0).value, 0.0);
  for (double x = -1.03; x < 3.0; x += 0.1)
    for (const double y : {-1.0, -0.1, 0.03, 0.12, 1.0}) {
      constexpr double h = 1e-6;
      const RoadHeight at = road.at(x, y);
      EXPECT_NEAR(at.by_x, (road.at(x + h, y).value - road.at(x - h, y).value) / (2 * h), 1e-8) << x;
      EXPECT_NEAR(at.by_y, (road.at(x, y + h).value - road.at(x, y - h).value) / (2 * h), 1e-8) << y;
    }
}

// A straight table is a plane; it ends where its points end, and goes on level there.
TEST(Road, CurvesEndTheRoad) {
  formats::RoadSpec spec;
  spec.left = {{RoadPieceShape::curve, 0, 0, 0, 0, {formats::Interpolation::linear, {-2.0, 3.0}, {0.0, 0.5}}}};
  const Road road(spec, Vector3d::Zero());
  EXPECT_EQ(road.begin, -2.0);
  EXPECT_EQ(road.end, 3.0);
  EXPECT_NEAR(road.at(1.0, 7.0).value, 0.3, 1e-15);
  EXPECT_NEAR(road.at(1.0, 7.0).by_x, 0.1, 1e-15);
  EXPECT_EQ(road.at(4.0, 0.0).value, 0.5);
  EXPECT_EQ(road.at(4.0, 0.0).by_x, 0.0);
}

// Forces are of size 1e4 with second derivatives of up to 1e9 (friction over √slip at low speed): differences with
// 1e-7 err by less than 1e-3 of the largest derivative, 1e6 to 1e7.
TEST(Tyre, TangentIsTheDerivativeOfTheForce) {
  constexpr double h = 1e-7;
  const std::vector<Tyre> tyres = all_tyres();
  int touching = 0;
  for (unsigned seed = 0; seed < 120; ++seed) {
    const Wheel wheel = random_wheel(seed, seed % 3 == 0, seed % 2 == 0 ? 5.0 : 0.05, tyres[seed % tyres.size()]);
    if (wheel.terms().penetration <= 0.0) continue;
    ++touching;
    const auto matrix = [&](const TangentCoefficients& c) {
      return tangent(wheel.tyre, wheel.road, wheel.node, wheel.tread, c);
    };
    const Matrix8d K = matrix({0, 0, 1}), C = matrix({0, 1, 0}), M = matrix({1, 0, 0});
    EXPECT_LT((matrix({0.7, 0.3, 2.0}) - 0.3 * C - 2.0 * K - 0.7 * M).cwiseAbs().maxCoeff(),
              1e-9 * (K.norm() + C.norm() + M.norm()));
    const double mass = wheel.tyre.relaxes() ? lag_mass(wheel.tyre) : 0.0;
    EXPECT_LT((M.bottomRightCorner<2, 2>() - mass * Eigen::Matrix2d::Identity()).norm(), 1e-12 * (1.0 + mass));
    // Rows of the wheel and those of the tread are of different size.
    const auto check = [&](const Vector8d& column, const Vector8d& difference, const Matrix8d& all, int j) {
      EXPECT_LT((column - difference).head<6>().cwiseAbs().maxCoeff(), 1e-4 * all.topRows<6>().cwiseAbs().maxCoeff())
          << seed << " " << j;
      EXPECT_LE((column - difference).tail<2>().cwiseAbs().maxCoeff(), 1e-4 * all.bottomRows<2>().cwiseAbs().maxCoeff())
          << seed << " " << j;
    };
    for (int j = 0; j < 6; ++j) {
      const Vector6d d = h * Vector6d::Unit(j);
      check(K.col(j), (wheel.moved(d).residual() - wheel.moved(-d).residual()) / (2 * h), K, j);
      check(C.col(j), (wheel.faster(d).residual() - wheel.faster(-d).residual()) / (2 * h), C, j);
    }
    const Eigen::Vector2d none = Eigen::Vector2d::Zero();
    for (int j = 0; wheel.tyre.relaxes() && j < 2; ++j) {
      const Eigen::Vector2d d = h * Eigen::Vector2d::Unit(j);
      check(K.col(6 + j), (wheel.deflected(d, none).residual() - wheel.deflected(-d, none).residual()) / (2 * h), K,
            6 + j);
      check(C.col(6 + j), (wheel.deflected(none, d).residual() - wheel.deflected(none, -d).residual()) / (2 * h), C,
            6 + j);
    }
  }
  EXPECT_GT(touching, 80);
}

// What the tyre takes from the wheel is the growth of its energy and what it dissipates, on any road.
TEST(Tyre, PowerIsAccountedFor) {
  constexpr double h = 1e-6;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Wheel wheel = random_wheel(seed, seed % 2 == 0, 2.0, all_tyres()[seed % 6]);
    const TyreTerms at = wheel.terms();
    Vector6d v;
    v << wheel.node.xd, wheel.node.Omega;
    const double rate = (wheel.moved(h * v).terms().energy - wheel.moved(-h * v).terms().energy) / (2 * h);
    EXPECT_NEAR(at.residual.dot(v), rate + wheel.dissipated(), 1e-5 * (std::abs(rate) + at.residual.norm())) << seed;
  }
}

// An upright wheel on a plane that does not steer: slip, damper and rolling resistance only take energy.
TEST(Tyre, OnlyTakesEnergyOnPlanes) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> speed(-20, 20), spin(-80, 80), depth(-0.01, 0.06);
  double largest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    Wheel wheel = rolling(speed(random), spin(random), depth(random));
    wheel.node.xd += Vector3d(0.0, speed(random), 0.1 * speed(random));
    EXPECT_GE(wheel.dissipated(), -1e-9);
    largest = std::max(largest, wheel.dissipated());
  }
  EXPECT_GT(largest, 1e4);
}

// The same tyre on the same wheel, carried by a node elsewhere on it: one wrench.
TEST(Tyre, WrenchDoesNotDependOnThePointOfReduction) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Wheel wheel = random_wheel(seed, false, 3.0, all_tyres()[seed % 6]);
    Wheel other = wheel;
    const Vector3d shift(0.3, -0.2, 0.5);
    other.tyre.wheel.p += shift;
    other.node.x -= wheel.node.R * shift;
    other.node.xd -= wheel.node.R * wheel.node.Omega.cross(shift);
    EXPECT_LT((wheel.wrench() - other.wrench()).norm(), 1e-9 * (1.0 + wheel.wrench().norm()));
    EXPECT_NEAR(wheel.dissipated(), other.dissipated(), 1e-9 * (1.0 + std::abs(wheel.dissipated())));
    // Force and moment in tyre axes, moved from the contact centre, are that wrench.
    const TyreTerms at = wheel.terms();
    if (at.penetration <= 0.0) continue;
    const Vector3d axle = wheel.node.R * wheel.tyre.wheel.R.col(1);
    Matrix3d R;
    R.col(0) = axle.cross(at.normal).normalized();
    R.col(2) = at.normal;
    R.col(1) = R.col(2).cross(R.col(0));
    const Vector3d force = R * at.force;
    EXPECT_LT((wheel.wrench().head<3>() - force).norm(), 1e-9 * force.norm());
    EXPECT_LT((wheel.wrench().tail<3>() - R * at.moment - at.contact.cross(force)).norm(), 1e-9 * force.norm());
  }
}

// Mirrored at the plane y = 0, a wheel (its axle is an axial vector) feels the mirrored wrench.
TEST(Tyre, LeftAndRightAreMirrorImages) {
  const Matrix3d S = Vector3d(1, -1, 1).asDiagonal();
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Wheel left = random_wheel(seed, true, 3.0, all_tyres()[seed % 6]);
    Wheel right = left;
    if (auto* law = std::get_if<MagicFormulaLaw>(&right.tyre.law)) law->mirrored = true;
    right.tread.w.y() = -left.tread.w.y();
    right.tyre.wheel.p = S * left.tyre.wheel.p;
    right.tyre.wheel.R = S * left.tyre.wheel.R * S;
    right.node.x = S * left.node.x;
    right.node.R = S * left.node.R * S;
    right.node.xd = S * left.node.xd;
    right.node.Omega = -S * left.node.Omega;
    const Vector6d a = left.wrench(), b = right.wrench();
    EXPECT_LT((S * a.head<3>() - b.head<3>()).norm(), 1e-10 * (1.0 + a.norm()));
    EXPECT_LT((-S * a.tail<3>() - b.tail<3>()).norm(), 1e-10 * (1.0 + a.norm()));
    EXPECT_NEAR(left.terms().slip_angle, -right.terms().slip_angle, 1e-12);
    EXPECT_NEAR(left.terms().slip, right.terms().slip, 1e-12);
  }
}

// Rolling freely: V = Ω R with R = R₀ − δ/3 makes no force along the wheel but the resistance to rolling.
TEST(Tyre, RollsFreelyWithItsRollingRadius) {
  const double R = 0.3101 - 0.01 / 3.0;
  for (const double sign : {1.0, -1.0}) {
    const Wheel wheel = rolling(sign * 10.0, sign * 10.0 / R);
    const TyreTerms at = wheel.terms();
    EXPECT_NEAR(at.rolling_radius, R, 1e-15);
    EXPECT_NEAR(at.slip, 0.0, 1e-14);
    EXPECT_NEAR(at.force.x(), 0.0, 1e-8);
    EXPECT_NEAR(at.force.z(), 1900.0, 1e-9);
    EXPECT_NEAR(at.moment.y(), -sign * 0.015 * 1900.0 * R, 1e-8);
    EXPECT_NEAR(wheel.dissipated(), 0.015 * 1900.0 * 10.0, 1e-6);
    EXPECT_EQ(at.adhesion, 1.0);
  }
}

TEST(Tyre, LockedWheelSlidesBothWays) {
  for (const double sign : {1.0, -1.0}) {
    const TyreTerms at = rolling(sign * 10.0, 0.0).terms();
    EXPECT_NEAR(at.force.x(), -sign * 0.75 * 1900.0, 1e-9);
    EXPECT_EQ(at.slip, -sign);
    EXPECT_EQ(at.adhesion, 0.0);
  }
}

// Signs of ISO 8855: a positive slip angle (to the left) makes a force to the right and a moment that reduces the
// angle; a wheel that leans to its right (positive inclination) is pushed to the right. All turn with the direction of
// rolling but the thrust.
TEST(Tyre, SideForcesHaveTheSignsOfIso) {
  const double R = 0.3101 - 0.01 / 3.0;
  for (const double sign : {1.0, -1.0}) {
    Wheel wheel = rolling(sign * 10.0, sign * 10.0 / R);
    wheel.tyre.rolling_resistance = 0.0;
    wheel.node.xd.y() = 0.2;
    const TyreTerms at = wheel.terms();
    EXPECT_NEAR(at.slip_angle, std::atan(0.02), 1e-12);
    EXPECT_LT(at.force.y(), -900.0);
    EXPECT_GT(sign * at.moment.z(), 1.0);
    wheel.node.xd.y() = 0.0;
    wheel.node.R = exp_so3<double>(Vector3d(0.05, 0.0, 0.0));
    EXPECT_NEAR(wheel.terms().camber, 0.05, 1e-12);
    EXPECT_LT(wheel.terms().force.y(), -100.0);
  }
}

// Landing at any rate: the load begins at zero, is never negative, and follows the penetration without a jump.
TEST(Tyre, LandsAndLiftsWithoutJump) {
  for (const double rate : {-5.0, -0.5, 0.0, 0.5, 5.0}) {
    double last = 0.0;
    for (double depth = -0.001; depth < 0.02; depth += 1e-6) {
      Wheel wheel = rolling(10.0, 20.0, depth);
      wheel.node.xd.z() = rate;
      const TyreTerms at = wheel.terms();
      ASSERT_GE(at.force.z(), 0.0);
      // Slope: k + c |rate| 1.5/(0.01 R₀) < 1.5e6 N/m.
      ASSERT_LT(std::abs(at.force.z() - last), 1.5) << depth;
      ASSERT_TRUE(depth >= 0.0 || at.residual.isZero(0.0));
      last = at.force.z();
    }
  }
}

// From rolling forward to rolling backward through standstill, also with lateral motion and locked: no jump, and
// exactly zero velocities give no force along the road. C_s/(v₀/2) is the largest slope over velocity.
TEST(Tyre, PassesStandstillWithoutJump) {
  const double slope = 3.0 * 80e3 / 0.05;
  for (const bool locked : {false, true})
    for (const double side : {0.0, 0.01, 1.0}) {
      Vector3d last = Vector3d::Zero();
      bool first = true;
      constexpr double dV = 1e-5;
      for (double V = -0.2; V < 0.2; V += dV) {
        Wheel wheel = rolling(V, locked ? 0.0 : 1.02 * V / 0.307);
        wheel.node.xd.y() = side;
        const TyreTerms at = wheel.terms();
        ASSERT_TRUE(at.residual.allFinite());
        ASSERT_TRUE(first || (at.force - last).norm() < slope * dV) << V;
        last = at.force;
        first = false;
      }
    }
  const TyreTerms at = rolling(0.0, 0.0).terms();
  EXPECT_EQ(at.force.x(), 0.0);
  EXPECT_EQ(at.force.y(), 0.0);
  EXPECT_EQ(at.moment.norm(), 0.0);
  EXPECT_NEAR(at.force.z(), 1900.0, 1e-9);
  EXPECT_TRUE(
      tangent(car_tyre(), Road(plane(), Vector3d::Zero()), rolling(0.0, 0.0).node, Tread{}, {0, 1, 1}).allFinite());
}

// The same with the tread's deflections in equilibrium or at rest, for all tyres: all is finite and without jumps, and
// a standing tyre holds by its deflection: C_s u/σ_x along.
TEST(Tyre, RelaxesThroughStandstillLiftAndLock) {
  const std::vector<Tyre> tyres = all_tyres();
  for (const Tyre& tyre : tyres)
    for (const double spin : {0.0, 1.0, -3.0}) {
      Vector8d last = Vector8d::Zero();
      bool first = true;
      constexpr double dV = 1e-5;
      for (double V = -0.3; V < 0.3; V += dV) {
        Wheel wheel = rolling(V, spin * V / 0.307, 0.01 + 0.05 * V);
        wheel.tyre = tyre;
        wheel.node.x.z() += tyre.radius - 0.3101;
        if (tyre.relaxes()) wheel.tread.w = {1e-3, -2e-3};
        const Vector8d r = wheel.residual();
        ASSERT_TRUE(r.allFinite());
        ASSERT_TRUE(first || (r - last).head<6>().norm() < 1e7 * dV) << V;
        last = r;
        first = false;
      }
    }
  Wheel standing = rolling(0.0, 0.0);
  standing.tyre = tyres[3];
  standing.tread.w = {1e-3, 0.0};
  const double S = 1e-3 / 0.4, l_n = 1.0 - 80e3 * S / (3.0 * (1.0 - 0.25 * S) * 1900.0);
  const double slid = (1.0 - 0.25 * S) * 1900.0 * (1.0 - 3.0 * l_n * l_n + 2.0 * l_n * l_n * l_n);
  EXPECT_NEAR(standing.terms().force.x(), -(80e3 * S * l_n * l_n + slid), 1e-9);
  EXPECT_EQ(settled_rates(standing.tyre, standing.road, standing.node, standing.tread.w).norm(), 0.0);
}

// Steady: deflections that do not change give the slips of a tyre without relaxation, above the speeds at which either
// is regularised.
TEST(Tyre, SettlesAtTheSlipsOfTheWheel) {
  const std::vector<Tyre> tyres = all_tyres();
  for (int i = 0; i < 3; ++i) {
    Wheel wheel = rolling(10.0, 10.4 / 0.306);
    wheel.node.xd.y() = 0.3;
    wheel.tyre = tyres[i];
    const TyreTerms steady = wheel.terms();
    wheel.tyre = tyres[i + 3];
    for (int k = 0; k < 2000; ++k)  // ẇ = 0 by small steps of the first-order law
      wheel.tread.w += 2e-3 * settled_rates(wheel.tyre, wheel.road, wheel.node, wheel.tread.w);
    const TyreTerms relaxed = wheel.terms();
    EXPECT_LT((relaxed.force - steady.force).norm(), 1e-9 * steady.force.norm()) << i;
    EXPECT_LT((relaxed.moment - steady.moment).norm(), 1e-9 * steady.force.norm()) << i;
    EXPECT_NEAR(relaxed.slip, steady.slip, 1e-12);
    EXPECT_NEAR(relaxed.slip_angle, steady.slip_angle, 1e-12);
  }
}

// A wheel that falls on its side loses the road without a jump: no force beyond a camber of 78.5 degrees.
TEST(Tyre, LosesTheRoadOnItsSide) {
  double last = 0.0;
  for (double tilt = 0.0; tilt < 1.57; tilt += 1e-5) {
    Wheel wheel = rolling(5.0, 15.0);
    wheel.node.R = exp_so3<double>(Vector3d(tilt, 0.0, 0.0));
    wheel.node.x.z() = wheel.tyre.radius * std::cos(tilt) - 0.01;
    const TyreTerms at = wheel.terms();
    ASSERT_TRUE(at.residual.allFinite());
    ASSERT_TRUE(tilt == 0.0 || std::abs(at.force.z() - last) < 1.0) << tilt;
    ASSERT_TRUE(tilt < 1.38 || at.residual.isZero(0.0));
    last = at.force.z();
  }
}

// Over the edges of a trapezoid the plane of four points turns continuously: 45 degree ramps change the load by no more
// than the stiffness allows.
TEST(Tyre, RollsOverEdgesWithoutJump) {
  formats::RoadSpec spec;
  spec.kind = formats::RoadKind::profile;
  spec.left = spec.right = {{RoadPieceShape::trapezoid, 0.0, 1.0, 0.1, 0.1, {}}};
  const Road road(spec, Vector3d::Zero());
  Vector3d last = Vector3d::Zero();
  for (double x = -0.5; x < 1.5; x += 1e-5) {
    Wheel wheel = rolling(10.0, 30.0);
    wheel.road = road;
    wheel.node.x.x() = x;
    const TyreTerms at = wheel.terms();
    ASSERT_TRUE(at.residual.allFinite());
    // Slopes over x: k times a slope of up to 2 and the turn of the plane over 0.1 R₀, times the depth of 0.11 m.
    ASSERT_TRUE(x < -0.5 + 1e-9 || (at.force - last).norm() < 1e-5 * 190e3 * (2.0 + 0.11 / 0.031) * 2.0) << x;
    last = at.force;
  }
}

}  // namespace
}  // namespace tisserand::mechanism::tyre_test
