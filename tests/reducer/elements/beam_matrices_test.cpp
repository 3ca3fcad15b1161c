// SPDX-License-Identifier: GPL-3.0-or-later
// Beams of a mesh: rigid arms, released ends, faults, and published or exact frequencies of assembled beams.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "common/math/rotation.hpp"
#include "formats/sections/shapes.hpp"
#include "reducer/elements/beam/ends.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "tests/support/meshes/small_model.hpp"

namespace tisserand::reducer::beam_matrices_test {
namespace {

using Eigen::Vector3d;
using formats::BeamTheory;
using formats::Section;

constexpr double pi = std::numbers::pi, E = 200e9, G = E / 2.6, rho = 8000.0;
constexpr Components ux = 1, uy = 2, uz = 4, rx = 8, ry = 16, rz = 32;
constexpr std::uint16_t release(int end, int component) {
  return static_cast<std::uint16_t>(1 << (6 * end + component));
}

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

/// Eccentric pull: the node stands e above the axis, so that a force P at it also bends: PL/EA + Pe²L/EI along the
/// force, PeL²/2EI aside.
TEST(BeamOffsets, EccentricPull) {
  const double L = 2.0, e = 0.3, P = 1e4;
  const Section s = formats::rectangle_section(0.05, 0.1);
  Mesh mesh = line_mesh(property(s, BeamTheory::euler_bernoulli), L, 1);
  mesh.position.row(2).setConstant(e);
  mesh.beams[0].first_offset = mesh.beams[0].second_offset = Vector3d(0, 0, -e);
  SmallModel model(mesh);
  model.hold(0, all_components);
  model.load[6] = P;
  const Eigen::VectorXd u = solve_small(model);
  const double EI = E * s.second_moment_y;
  EXPECT_NEAR(u[6] / (P * L / (E * s.area) + P * e * e * L / EI), 1.0, 1e-12);
  EXPECT_NEAR(u[8] / (-P * e * L * L / (2 * EI)), 1.0, 1e-12);
  ShapeFindings findings;
  check_shape(mesh, mesh.beams[0], findings);
  EXPECT_TRUE(findings.errors.empty());
}

/// Arms that differ at both ends turn and shorten the axis; rigid motions of the nodes still cost nothing, and the mass
/// is that of the beam where it is.
TEST(BeamOffsets, RigidMotionsAndMass) {
  Mesh mesh = line_mesh(property(formats::rectangle_section(0.05, 0.1), BeamTheory::timoshenko), 2.0, 1);
  BeamElement& beam = mesh.beams[0];
  beam.first_offset = Vector3d(0.2, 0.1, -0.3);
  beam.second_offset = Vector3d(-0.1, 0.4, 0.2);
  const Vector3d first = mesh.position.col(0) + beam.first_offset, second = mesh.position.col(1) + beam.second_offset;
  beam.R_PE = *beam_axes(second - first, Vector3d(0.1, 1.0, 0.3));
  beam.released = release(0, 5) | release(1, 4);
  ElementMatrices element;
  element_matrices(mesh, beam, element);
  Eigen::Matrix<double, 12, 6> R = Eigen::Matrix<double, 12, 6>::Zero();
  for (int node = 0; node < 2; ++node) {
    R.block<6, 6>(6 * node, 0).setIdentity();
    R.block<3, 3>(6 * node, 3) = -skew<double>(Vector3d(mesh.position.col(node)));
  }
  EXPECT_LT((element.S * R).cwiseAbs().maxCoeff(), 1e-12 * element.S.cwiseAbs().maxCoeff());
  EXPECT_EQ((element.S - element.S.transpose()).cwiseAbs().maxCoeff(), 0.0);
  const Eigen::MatrixXd M = R.transpose() * element.M * R;
  const double mass = rho * 0.005 * (second - first).norm();
  EXPECT_NEAR(M(0, 0), mass, 1e-12 * mass);
  const Vector3d center = 0.5 * (first + second);
  EXPECT_LT((M.block<3, 3>(0, 3) + mass * skew<double>(center)).cwiseAbs().maxCoeff(), 1e-12 * mass);
}

/// Hinge at end 2 of a cantilever: 3EI/L³, and 33/140 of its mass at the tip (deflection (3ξ² − ξ³)/2, in every
/// textbook).
TEST(BeamReleases, HingeLeavesTheProppedShape) {
  const double L = 2.0;
  const Section s = formats::rectangle_section(0.05, 0.1);
  BeamProperty beam = property(s, BeamTheory::euler_bernoulli);
  beam.data.rotary_inertia = RotaryInertia::without;
  Mesh mesh = line_mesh(beam, L, 1);
  mesh.beams[0].released = release(1, 5);
  ElementMatrices element;
  element_matrices(mesh, mesh.beams[0], element);
  EXPECT_NEAR(element.S(7, 7) / (3 * E * s.second_moment_z / (L * L * L)), 1.0, 1e-12);
  EXPECT_NEAR(element.M(7, 7) / (rho * s.area * L * 33.0 / 140.0), 1.0, 1e-12);
  EXPECT_EQ(element.S.row(11).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(element.M.row(11).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_NEAR(element.S(8, 8) / (12 * E * s.second_moment_y / (L * L * L)), 1.0, 1e-12) << "the other plane is whole";
}

/// Clamped nodes, hinged ends: the pinned beam, ω = (nπ/L)² √(EI/ρA); error of Hermite elements (nπh/L)⁴/1440.
TEST(BeamReleases, HingedEndsMakeAPinnedBeam) {
  const double L = 3.0;
  const int n = 12;
  const Section s = formats::rectangle_section(0.05, 0.1);
  BeamProperty beam = property(s, BeamTheory::euler_bernoulli);
  beam.data.rotary_inertia = RotaryInertia::without;
  Mesh mesh = line_mesh(beam, L, n);
  mesh.beams.front().released = release(0, 5);
  mesh.beams.back().released = release(1, 5);
  SmallModel model(mesh);
  for (int i = 0; i <= n; ++i) model.hold(i, i == 0 || i == n ? all_components : ux | uz | rx | ry);
  const SmallModes modes = modes_small(model, 3, 0.0);
  for (int k = 1; k <= 3; ++k) {
    const double exact = std::pow(k * pi / L, 4) * E * s.second_moment_z / (rho * s.area);
    const double error = modes.omega2[k - 1] / exact - 1.0, bound = std::pow(k * pi / n, 4) / 720.0;
    EXPECT_GT(error, -1e-9);
    EXPECT_LT(error, 2.0 * bound + 1e-9) << k;
  }
}

std::string errors_of(std::uint16_t released) {
  Mesh mesh = line_mesh(property(formats::rectangle_section(0.05, 0.1), BeamTheory::timoshenko), 1.0, 1);
  mesh.beams[0].released = released;
  ShapeFindings findings;
  check_shape(mesh, mesh.beams[0], findings);
  return findings.errors.empty() ? "" : findings.errors[0];
}

TEST(BeamReleases, LooseOnesAreErrors) {
  EXPECT_EQ(errors_of(release(0, 4) | release(1, 4) | release(0, 5) | release(1, 5) | release(0, 3)), "");
  EXPECT_EQ(errors_of(release(0, 1) | release(0, 5)), "");
  EXPECT_EQ(errors_of(release(0, 3) | release(1, 3)),
            "its released end forces (Mx at end 1, Mx at end 2) make it a mechanism: the element can move between its "
            "nodes without any stiffness");
  EXPECT_NE(errors_of(release(0, 0) | release(1, 0)), "");
  EXPECT_NE(errors_of(release(0, 1) | release(0, 5) | release(1, 5)), "");
}

TEST(BeamShape, FaultsAreNamed) {
  Mesh mesh = line_mesh(property(formats::rectangle_section(0.05, 0.1), BeamTheory::timoshenko), 1.0, 1);
  const auto findings_of = [&mesh] {
    ShapeFindings findings;
    check_shape(mesh, mesh.beams[0], findings);
    return findings;
  };
  mesh.beams[0].first_offset = Vector3d(1, 0, 0);
  EXPECT_EQ(findings_of().errors.at(0), "its ends are at the same place (length 0)");
  mesh.beams[0].first_offset = Vector3d(0, 0.1, 0);
  EXPECT_EQ(findings_of().errors.at(0), "its axes are not aligned with the line between its ends");
  mesh.beams[0].first_offset = Vector3d(0.999, 0, 0);
  EXPECT_TRUE(findings_of().errors.empty());
  EXPECT_EQ(findings_of().warnings.at(0), "its length 0.001 is less than 1/50 of the depth 0.1 of its section");
  mesh.beams[0].first_offset.setZero();
  mesh.beam_properties[0].data.section.second_moment_yz = 1.0;
  EXPECT_NE(findings_of().errors.at(0).find("principal second moment"), std::string::npos);
}

/// Beam with fork supports whose centroid lies e above its line of shear centres: bending aside and torsion move
/// together. With v, θ ~ sin kx, k = nπ/L (Gere and Lin, Coupled vibrations of thin-walled beams of open cross section,
/// J. Appl. Mech. 25 (1958) 373, without warping): det[EIz k⁴ − mω², meω²; meω², GJk² − (ρIp + me²)ω²] = 0.
TEST(BeamBenchmarks, CoupledBendingAndTorsion) {
  const double L = 4.0, e = 0.08;
  Section s{"s", 2e-3, 3e-6, 2e-6, 6e-8, 5e-6, 1.1e-3, 0.9e-3, ""};
  s.centroid_z = e;
  s.shear_center_z = -e;
  BeamProperty beam = property(s, BeamTheory::euler_bernoulli);
  beam.data.rotary_inertia = RotaryInertia::without;
  Eigen::VectorXd omega2[2];
  for (int i = 0; i < 2; ++i) {
    const int n = 20 << i;
    SmallModel model(line_mesh(beam, L, n));
    for (int k = 0; k <= n; ++k) model.hold(k, ux | uz | ry);
    for (const int end : {0, n}) model.hold(end, uy | rx);
    omega2[i] = modes_small(model, 6, 0.0).omega2;
  }
  std::vector<double> exact;
  const double m = rho * s.area, inertia = rho * s.polar_moment + m * e * e;
  for (int n = 1; n <= 6; ++n) {
    const double k2 = std::pow(n * pi / L, 2), a = E * s.second_moment_z * k2 * k2, b = G * s.torsion_constant * k2;
    const double A = m * inertia - m * m * e * e, B = a * inertia + b * m, C = a * b;
    exact.push_back((B - std::sqrt(B * B - 4 * A * C)) / (2 * A));
    exact.push_back((B + std::sqrt(B * B - 4 * A * C)) / (2 * A));
  }
  std::sort(exact.begin(), exact.end());
  for (int k = 0; k < 6; ++k) {
    EXPECT_NEAR(omega2[1][k] / exact[k], 1.0, 0.03) << k;
    const double richardson = (4.0 * omega2[1][k] - omega2[0][k]) / 3.0;  // torsion: linear, order 2
    EXPECT_NEAR(richardson / exact[k], 1.0, 3e-4) << k;
  }
  EXPECT_GT(E * s.second_moment_z * std::pow(pi / L, 4) / m / exact[0], 1.05) << "the coupling counts";
}

}  // namespace
}  // namespace tisserand::reducer::beam_matrices_test
