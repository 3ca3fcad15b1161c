// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry, supports and exact solutions of the published frequencies of beams.
#include "tests/problems/beam_vibration.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "formats/sections/shapes.hpp"
#include "reducer/elements/beam/beam.hpp"
#include "tests/support/meshes/small_model.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::BeamTheory;
using formats::Section;

constexpr double pi = std::numbers::pi, E = 200e9, G = E / 2.6, rho = 8000.0;
constexpr Components ux = 1, uy = 2, uz = 4, rx = 8, ry = 16;

BeamProperty property(const Section& section, BeamTheory theory) {
  BeamProperty result;
  result.data.section = section;
  result.data.material = {"m", E, 0.3, rho, ""};
  result.data.theory = theory;
  return result;
}

/// Nodes on a line of length L along x, `count` equal elements of one property.
Mesh line_mesh(const BeamProperty& beam, double L, int count) {
  Mesh mesh;
  mesh.position = Eigen::Matrix3Xd::Zero(3, count + 1);
  for (int i = 0; i <= count; ++i) mesh.position(0, i) = L * i / count;
  mesh.beam_properties.push_back(beam);
  for (int i = 0; i < count; ++i) mesh.beams.push_back({i, i + 1});
  return mesh;
}

/// ω of the n-th sine wave of a pinned beam: the smaller root of
/// (ρ²r²/κG) ω⁴ - (ρ + ρq²r² + ρEr²q²/κG) ω² + Er²q⁴ = 0, q = nπ/L, r² = I/A.
double timoshenko_omega(double L, double r2, double kappa, int n) {
  const double q2 = std::pow(n * pi / L, 2), kG = kappa * G;
  const double a = rho * rho * r2 / kG, b = rho * (1.0 + q2 * r2 + E * r2 * q2 / kG), c = E * r2 * q2 * q2;
  return std::sqrt(2.0 * c / (b + std::sqrt(b * b - 4.0 * a * c)));
}

Section deep_section(DeepBeamTorsion torsion) {
  Section section = formats::rectangle_section(2.0, 2.0);
  if (torsion == DeepBeamTorsion::polar_moment) section.torsion_constant = section.polar_moment;
  return section;
}

}  // namespace

VectorXd free_square_frame(int n) {
  Mesh mesh;
  mesh.position = Eigen::Matrix3Xd::Zero(3, 4 * n);
  mesh.beam_properties.push_back(property(formats::rectangle_section(0.25, 0.25), BeamTheory::euler_bernoulli));
  const Vector3d corner[] = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}, {0, 0, 0}};
  for (int i = 0; i < 4 * n; ++i) {
    const double xi = static_cast<double>(i % n) / n;
    mesh.position.col(i) = (1.0 - xi) * corner[i / n] + xi * corner[i / n + 1];
    BeamElement beam{i, (i + 1) % (4 * n)};
    beam.R_PE = *beam_axes(corner[i / n + 1] - corner[i / n], Vector3d::UnitZ());
    mesh.beams.push_back(beam);
  }
  SmallModel model(mesh);
  for (int i = 0; i < 4 * n; ++i) model.hold(i, uz | rx | ry);
  return modes_small(model, 11, 400.0).hertz();
}

VectorXd deep_beam(DeepBeamTorsion torsion, int elements) {
  SmallModel model(line_mesh(property(deep_section(torsion), BeamTheory::timoshenko), 10.0, elements));
  model.hold(0, ux | uy | uz | rx);
  model.hold(elements, uy | uz);
  return modes_small(model, 9, 0.0).hertz();
}

VectorXd deep_beam_exact(DeepBeamTorsion torsion) {
  const Section section = deep_section(torsion);
  const double twist = std::sqrt(G / rho * section.torsion_constant / section.polar_moment) / 40.0;
  VectorXd hertz(9);
  hertz << twist, 3.0 * twist, std::sqrt(E / rho) / 40.0, VectorXd::Zero(6);
  for (int n = 1; n <= 3; ++n)
    hertz[2 * n + 1] = hertz[2 * n + 2] = timoshenko_omega(10.0, 1.0 / 3.0, 5.0 / 6.0, n) / (2.0 * pi);
  std::sort(hertz.begin(), hertz.end());
  return hertz;
}

VectorXd euler_beam_roots(BeamEnds ends, int elements) {
  const Section section = formats::rectangle_section(0.05, 0.1);
  BeamProperty beam = property(section, BeamTheory::euler_bernoulli);
  beam.data.rotary_inertia = RotaryInertia::without;
  SmallModel model(line_mesh(beam, 1.0, elements));
  for (int i = 0; i <= elements; ++i) model.hold(i, ux | uz | rx | ry);
  if (ends != BeamEnds::free_free) model.hold(0, all_components);
  if (ends == BeamEnds::clamped_clamped) model.hold(elements, all_components);
  const double unit = rho * section.area / (E * section.second_moment_z);
  const double shift = ends == BeamEnds::free_free ? 500.0 / unit : 0.0;  // the first βL is 4.73, its fourth power 500
  const int rigid = ends == BeamEnds::free_free ? 2 : 0;
  const VectorXd omega2 = modes_small(model, rigid + 4, shift).omega2;
  return (unit * omega2.tail(4)).array().sqrt().sqrt();
}

VectorXd pinned_timoshenko_beam(int elements) {
  SmallModel model(line_mesh(property(formats::rectangle_section(0.1, 0.1), BeamTheory::timoshenko), 1.0, elements));
  for (int i = 0; i <= elements; ++i) model.hold(i, ux | uz | rx | ry);
  for (const int end : {0, elements}) model.hold(end, uy);
  return modes_small(model, 3, 0.0).omega2.cwiseSqrt();
}

VectorXd pinned_timoshenko_exact() {
  const Section section = formats::rectangle_section(0.1, 0.1);
  VectorXd omega(3);
  for (int n = 1; n <= 3; ++n)
    omega[n - 1] =
        timoshenko_omega(1.0, section.second_moment_z / section.area, section.shear_area_y / section.area, n);
  return omega;
}

}  // namespace tisserand::reducer
