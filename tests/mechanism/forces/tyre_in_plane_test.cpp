// SPDX-License-Identifier: GPL-3.0-or-later
// Tyres of planar models against those of space where axle, road and motion lie in the plane: terms, tangent, power.
#include <random>

#include <gtest/gtest.h>

#include "formats/tyres/tyre_property_file.hpp"
#include "mechanism/tyres/tyre.hpp"

namespace tisserand::mechanism::tyre_in_plane_test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

/// Both laws, with and without relaxation.
std::vector<Tyre> tyres() {
  Tyre plain;
  plain.radius = 0.31;
  plain.stiffness = 190e3;
  plain.progressive = 100e3;
  plain.damping = 500.0;
  plain.law = ComprehensiveSlip{80e3, 60e3, 3e3, 1.0, 0.75};
  plain.rolling_resistance = 0.015;
  plain.low_speed = 0.5;
  Tyre filed = plain;
  MagicFormulaLaw law;
  law.p = formats::read_tyre_property_file(
              std::string(TISSERAND_REFERENCES) + "/magic_formula/synthetic_pac2002_all.tir", Units::si())
              .coefficients;
  for (double* sideways : {&law.p.LHY, &law.p.LVY, &law.p.LVYKA, &law.p.LVMX, &law.p.LRES, &law.p.LS}) *sideways = 0.0;
  filed.law = law;
  filed.rolling_resistance = 0.0;
  std::vector<Tyre> list{plain, filed};
  for (int i = 0; i < 2; ++i) {
    list.push_back(list[i]);
    list.back().relaxation = 0.4;
    list.back().lag = 0;
  }
  return list;
}

/// A wheel in the x-y plane of its model, whose road has the height of a curve over an x that points anywhere in it;
/// its axle points to either side, as does y of the road.
struct Wheel {
  Tyre tyre;
  Road road{formats::RoadSpec{}, Vector3d::Zero()};
  NodeMotion node;
  Tread tread;
};

Wheel random_wheel(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Wheel w;
  w.tyre = tyres()[seed % 4];
  const bool left = any(random) > 0.0, turned = any(random) > 0.0;
  // z of the road to y of the plane, then a turn in it.
  const Eigen::Matrix3d up =
      (AngleAxisd(turned ? M_PI : 0.0, Vector3d::UnitY()) * AngleAxisd(-M_PI / 2.0, Vector3d::UnitX()))
          .toRotationMatrix();
  w.road.R = AngleAxisd(3.0 * any(random), Vector3d::UnitZ()).toRotationMatrix() * up;
  w.road.p = {any(random), any(random), any(random)};
  RoadPiece bump;
  bump.start = -1.0;
  bump.length = 2.0;
  bump.height = 0.1;
  w.road.left = {bump};
  w.road.friction = 0.9;
  w.tyre.wheel.R =
      (AngleAxisd(any(random), Vector3d::UnitZ()) * AngleAxisd(left ? M_PI / 2.0 : -M_PI / 2.0, Vector3d::UnitX()))
          .toRotationMatrix();
  w.tyre.wheel.p = {0.2 * any(random), 0.2 * any(random), 0.0};
  w.node.R = AngleAxisd(3.0 * any(random), Vector3d::UnitZ()).toRotationMatrix();
  const double along = any(random), height = w.road.at(along, 0.0).value;
  const Vector3d center = w.road.p + w.road.R * Vector3d(along, 0.0, height + 0.31 - 0.02 * any(random));
  w.node.x = center - w.node.R * w.tyre.wheel.p;
  w.node.xd = {10.0 * any(random), 10.0 * any(random), 0.0};
  w.node.Omega = {0.0, 0.0, 40.0 * any(random)};
  if (w.tyre.relaxes()) {
    w.tread.w = {0.02 * any(random), 0.0};
    w.tread.wd = {any(random), 0.0};
    w.tread.wdd = {any(random), 0.0};
  }
  return w;
}

TEST(TyreInPlane, IsThatOfSpace) {
  int touching = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    Wheel w = random_wheel(seed);
    TyreTerms space, plane;
    evaluate(w.tyre, w.road, w.node, w.tread, space);
    const TangentCoefficients coefficients{0.3, 1.7, 40.0};
    const Matrix8d in_space = tangent(w.tyre, w.road, w.node, w.tread, coefficients);
    const double power = dissipated_power(w.tyre, w.road, w.node, space);
    w.tyre.planar = true;
    evaluate(w.tyre, w.road, w.node, w.tread, plane);
    const Matrix8d in_plane = tangent(w.tyre, w.road, w.node, w.tread, coefficients);
    const double force = 1.0 + space.residual.norm();
    EXPECT_LT((plane.residual - space.residual).norm(), 1e-11 * force) << seed;
    EXPECT_LT((plane.lag - space.lag).norm(), 1e-11 * (1.0 + space.lag.norm())) << seed;
    EXPECT_LT((plane.force - space.force).norm(), 1e-11 * force) << seed;
    EXPECT_LT((plane.moment - space.moment).norm(), 1e-11 * force) << seed;
    EXPECT_LT((plane.contact - space.contact).norm(), 1e-12) << seed;
    EXPECT_LT((plane.normal - space.normal).norm(), 1e-12) << seed;
    for (double TyreTerms::*term : {&TyreTerms::slip, &TyreTerms::slip_angle, &TyreTerms::camber,
                                    &TyreTerms::penetration, &TyreTerms::rolling_radius, &TyreTerms::adhesion})
      EXPECT_NEAR(plane.*term, space.*term, 1e-11 * (1.0 + std::abs(space.*term))) << seed;
    EXPECT_NEAR(plane.energy, space.energy, 1e-11 * (1.0 + space.energy)) << seed;
    EXPECT_NEAR(dissipated_power(w.tyre, w.road, w.node, plane), power, 1e-10 * (force + std::abs(power))) << seed;
    for (const int i : {0, 1, 5, 6, 7})
      for (const int j : {0, 1, 5, 6, 7}) {
        const double size = 1.0 + in_space.middleRows(i < 6 ? 0 : 6, i < 6 ? 6 : 2).cwiseAbs().maxCoeff();
        EXPECT_NEAR(in_plane(i, j), in_space(i, j), 1e-10 * size) << seed << " " << i << " " << j;
      }
    if (space.penetration > 0.0) ++touching;
  }
  EXPECT_GT(touching, 60);
  EXPECT_LT(touching, 190);
}

}  // namespace
}  // namespace tisserand::mechanism::tyre_in_plane_test
