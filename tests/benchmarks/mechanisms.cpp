// SPDX-License-Identifier: GPL-3.0-or-later
// Chains and slider-cranks written in code.
#include "tests/benchmarks/mechanisms.hpp"

#include <cmath>

#include <fmt/format.h>

#include "tests/support/scenes/scenes.hpp"

namespace tisserand::benchmarks {
namespace {

using Eigen::Vector3d;
using formats::JointKind;

constexpr double crank_length = 0.1524, rod_length = 0.3048, rate = 124.8;
constexpr double area = 3.16e-5, young = 2.068e11, density = 7820.0, nu = 0.3, shear_factor = 0.9;

/// Solid round section.
double second_moment() { return area * area / (4.0 * M_PI); }

formats::InitialMotion rod_start() {
  formats::InitialMotion start;
  start.pose.position = {crank_length, 0.0, 0.0};
  start.velocity = {0.0, crank_length * rate, 0.0};
  start.angular_velocity = {0.0, 0.0, -crank_length * rate / rod_length};
  return start;
}

/// Crank, drive and joints around the rod `rod` with the nodes `from` and `to`.
Case slider_crank(const std::string& from, const std::string& to, double end) {
  Case input{test_support::empty_scene(1e-4, end), {}};
  formats::Scene& scene = input.scene;
  formats::RigidBodySpec crank =
      test_support::rigid_body("crank", 10.0, {0.5 * crank_length, 0.0, 0.0}, Vector3d(0.01, 0.02, 0.02));
  crank.nodes.push_back({"pin", {Vector3d(crank_length, 0.0, 0.0), Eigen::Quaterniond::Identity()}});
  crank.start.angular_velocity = {0.0, 0.0, rate};
  scene.bodies.push_back(crank);
  const Vector3d z = Vector3d::UnitZ(), x = Vector3d::UnitX();
  scene.joints.push_back(test_support::joint("main", JointKind::revolute, "ground", "crank", Vector3d::Zero(), z));
  scene.joints.push_back(
      test_support::joint("pin", JointKind::revolute, "crank/pin", from, {crank_length, 0.0, 0.0}, z));
  scene.joints.push_back(
      test_support::joint("slide", JointKind::point_on_line, "ground", to, {crank_length + rod_length, 0.0, 0.0}, x));
  scene.motions.push_back(test_support::drive("main", fmt::format("{} * t", rate)));
  scene.output.every = 10;
  return input;
}

}  // namespace

Case rigid_chain(int links, int steps) {
  const double step = 1e-3;
  Case input{test_support::empty_scene(step, steps * step), {}};
  formats::Scene& scene = input.scene;
  scene.gravity = {0.0, 0.0, -9.81};
  scene.output.every = 10;
  for (int i = 0; i < links; ++i) {
    const std::string name = fmt::format("link{}", i);
    formats::RigidBodySpec body = test_support::rigid_body(name, 1.0, {0.5, 0.0, 0.0}, Vector3d(0.01, 0.1, 0.1));
    body.nodes.push_back({"tip", {Vector3d::UnitX(), Eigen::Quaterniond::Identity()}});
    body.start.pose.position = {i * 1.0, 0.0, 0.0};
    scene.bodies.push_back(body);
    scene.joints.push_back(test_support::joint(fmt::format("joint{}", i), JointKind::spherical,
                                               i == 0 ? "ground" : fmt::format("link{}/tip", i - 1), name,
                                               {i * 1.0, 0.0, 0.0}, Vector3d::UnitZ()));
  }
  return input;
}

Case slider_crank_of_beams(int elements, double end) {
  Case input = slider_crank("rod/start", "rod/end", end);
  const double I = second_moment();
  formats::BeamBodySpec rod;
  rod.name = "rod";
  rod.to = {rod_length, 0.0, 0.0};
  rod.elements = elements;
  rod.section = {"round", area, I, I, 2.0 * I, 2.0 * I, shear_factor * area, shear_factor * area, ""};
  rod.material = {"steel", young, nu, density, ""};
  rod.start = rod_start();
  input.scene.bodies.push_back(rod);
  return input;
}

Case slider_crank_reduced(int modes, double end) {
  Case input = slider_crank("rod/base", "rod/tip", end);
  const double I = second_moment();
  test_support::BeamData beam;
  beam.length = rod_length;
  beam.young = young;
  beam.shear_modulus = young / (2.0 * (1.0 + nu));
  beam.density = density;
  beam.area = area;
  beam.Iy = beam.Iz = I;
  beam.J = 2.0 * I;
  test_support::add_file("rod", reduced_beam(beam, 8, modes), input.files);
  formats::SuperelementBodySpec rod = test_support::superelement_body("rod", "rod");
  rod.start = rod_start();
  input.scene.bodies.push_back(rod);
  return input;
}

}  // namespace tisserand::benchmarks
