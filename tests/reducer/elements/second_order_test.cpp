// SPDX-License-Identifier: GPL-3.0-or-later
// Second-order strain of every kind of element: known answers, invariance under a superposed rotation, no stress in
// rigid motions, exact energies of springs that turn.
#include "reducer/elements/second_order.hpp"

#include <cmath>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "common/math/rotation.hpp"
#include "formats/sections/shapes.hpp"
#include "reducer/elements/beam/beam.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/spring.hpp"
#include "reducer/properties/beam_taper.hpp"
#include "tests/reducer/elements/shell_cases.hpp"
#include "tests/support/bodies/superelement_known_answers.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::reducer::second_order_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// One element of any kind: stiffness, second order, positions of its nodes, coordinates per node.
struct Case {
  std::string name;
  MatrixXd S;
  SecondOrderRows rows;
  Eigen::Matrix3Xd position;
  int components = 6;
};

template <class Element>
Case make_case(const std::string& name, const Mesh& mesh, const Element& element, int components) {
  Case c;
  c.name = name;
  ElementMatrices matrices;
  element_matrices(mesh, element, matrices);
  c.S = matrices.S;
  second_order(mesh, element, c.rows);
  c.components = components;
  c.position = mesh.position;
  return c;
}

BeamElementData beam_data() {
  BeamElementData data;
  data.section = {"s", 2e-3, 3e-6, 8e-6, 6e-8, 11e-6, 1.1e-3, 0.9e-3, ""};
  data.material = {"m", 2.1e11, 0.3, 7850.0, ""};
  return data;
}

Mesh beam_mesh(const BeamElementData& data) {
  Mesh mesh;
  mesh.position.resize(3, 2);
  mesh.position << 0.2, 0.9, -0.1, 0.5, 0.4, 0.7;
  mesh.beam_properties = {{data, "beam"}};
  BeamElement beam;
  beam.second = 1;
  mesh.beams = {beam};
  return mesh;
}

/// Axes for the ends as they are.
void orient(Mesh& mesh) {
  BeamElement& beam = mesh.beams[0];
  const Vector3d axis = mesh.position.col(1) + beam.second_offset - mesh.position.col(0) - beam.first_offset;
  beam.R_PE = *beam_axes(axis, Vector3d(0.3, -0.2, 1.0));
}

Case beam_case(const std::string& name, const BeamElementData& data, std::uint16_t released, const Vector3d& offset) {
  Mesh mesh = beam_mesh(data);
  mesh.beams[0].released = released;
  mesh.beams[0].first_offset = offset;
  mesh.beams[0].second_offset = 0.5 * Vector3d(offset.y(), offset.z(), -offset.x());
  orient(mesh);
  return make_case(name, mesh, mesh.beams[0], 6);
}

std::vector<Case> beam_cases() {
  const BeamElementData plain = beam_data();
  BeamElementData bernoulli = plain, odd = plain, tapered = plain, rod = plain;
  bernoulli.theory = formats::BeamTheory::euler_bernoulli;
  odd.section.second_moment_yz = -2e-6;
  odd.section.centroid_y = 0.01;
  odd.section.shear_center_z = 0.015;
  odd.section.shear_center_y = -0.03;
  odd.section.shear_coupling = 120.0;
  tapered.stations = {plain.section, plain.section};
  tapered.stations[1].area *= 0.3;
  tapered.stations[1].second_moment_y *= 0.2;
  tapered.stations[1].second_moment_z *= 0.4;
  rod.section.second_moment_y = rod.section.second_moment_z = 0.0;
  const Vector3d none = Vector3d::Zero(), arm(0.1, -0.05, 0.2);
  return {beam_case("Timoshenko", plain, 0, none),
          beam_case("Euler-Bernoulli", bernoulli, 0, none),
          beam_case("odd section", odd, 0, none),
          beam_case("tapered", tapered, 0, none),
          beam_case("offset", odd, 0, arm),
          beam_case("hinge", plain, 1 << 5, none),
          beam_case("slide and hinges, offset", plain, 1 << 1 | 1 << 10 | 1 << 11, arm),
          beam_case("rod", rod, 0, none)};
}

std::vector<Case> shell_cases() {
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, const Eigen::Matrix3Xd& X, const ShellSection& section, double offset) {
    Mesh mesh = one_shell(somewhere(X), section);
    mesh.shells[0].offset = offset;
    cases.push_back(make_case(name, mesh, mesh.shells[0], 6));
  };
  add("square", square(), steel(0.05), 0.0);
  add("distorted, offset", distorted_quad(), steel(0.01), 0.1);
  add("warped laminate", warped_quad(), skew_laminate(), -0.03);
  add("triangle", triangle(), steel(0.02), 0.0);
  add("triangular laminate, offset", triangle(), skew_laminate(), 0.05);
  return cases;
}

std::vector<Case> solid_cases() {
  std::vector<Case> cases;
  SolidProperty property;
  property.material = isotropic_solid(2.1e11, 0.3, 7850.0);
  for (const SolidShape shape : all_solid_shapes) {
    Eigen::Matrix3Xd X = natural_nodes(shape);
    for (Eigen::Index i = 0; i < X.cols(); ++i)  // nothing straight or parallel
      X.col(i) += 0.1 * Vector3d(std::sin(1.0 + 3.0 * i), std::sin(2.0 + 5.0 * i), std::sin(0.5 + 7.0 * i));
    const Mesh mesh = one_solid(shape, somewhere(X), property);
    cases.push_back(make_case(solid_name(shape), mesh, mesh.solids[0], 3));
  }
  return cases;
}

Case spring_case(const std::string& name, const Eigen::Matrix<double, 12, 12>& K, const Vector3d& arm) {
  Mesh mesh;
  mesh.position.resize(3, 2);
  mesh.position << Vector3d(0.3, -0.2, 0.5), Vector3d(0.3, -0.2, 0.5) + arm;
  Spring spring;
  spring.second = 1;
  spring.stiffness = K;
  mesh.springs = {spring};
  return make_case(name, mesh, mesh.springs[0], 6);
}

Eigen::Matrix<double, 6, 6> full_bushing() {
  Eigen::Matrix<double, 6, 6> K = Eigen::Matrix<double, 6, 6>::NullaryExpr(
      [](Eigen::Index i, Eigen::Index j) { return std::sin(1.0 + i * j + i + j); });
  return K * K.transpose() + Eigen::Matrix<double, 6, 6>::Identity();
}

std::vector<Case> spring_cases() {
  const Vector3d arm(0.4, 0.3, -0.2);
  BushingPlace place{0.3 * arm, -0.7 * arm, exp_so3<double>(Vector3d(0.5, 0.2, -0.4))};
  return {spring_case("axial spring", *axial_spring(3.0, arm), arm),
          spring_case("bushing between distant nodes", bushing(full_bushing(), place), arm),
          spring_case("bushing at one point", bushing(full_bushing(), {}), Vector3d::Zero())};
}

std::vector<Case> all_cases() {
  std::vector<Case> cases = beam_cases();
  for (const auto& more : {shell_cases(), solid_cases(), spring_cases()})
    cases.insert(cases.end(), more.begin(), more.end());
  return cases;
}

VectorXd some_displacements(const Case& c, double phase) {
  VectorXd d(c.S.rows());
  for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = std::sin(phase + 2.7 * static_cast<double>(i * i + 1));
  return d;
}

/// Displacements of a rigid rotation θ about the origin.
VectorXd turn(const Case& c, const Vector3d& theta) {
  VectorXd d(c.S.rows());
  for (Eigen::Index i = 0; i < c.position.cols(); ++i) {
    d.segment<3>(c.components * i) = theta.cross(Vector3d(c.position.col(i)));
    if (c.components == 6) d.segment<3>(6 * i + 3) = theta;
  }
  return d;
}

/// What a rotation θ after the displacements d adds at second order: θ × u, ½ θ × ψ.
VectorXd turned(const Case& c, const Vector3d& theta, const VectorXd& d) {
  VectorXd result(d.size());
  for (Eigen::Index i = 0; i < c.position.cols(); ++i) {
    result.segment<3>(c.components * i) = theta.cross(Vector3d(d.segment<3>(c.components * i)));
    if (c.components == 6) result.segment<3>(6 * i + 3) = 0.5 * theta.cross(Vector3d(d.segment<3>(6 * i + 3)));
  }
  return result;
}

// The energy ½ dᵀ S d + V3(d; d) of displacements that are turned by θ is the same up to θ²: with the stress of any w,
// dᵀ K_G[w] (θ × X) + (S w) · (θ × u, ½ θ × ψ) = 0.
TEST(SecondOrder, EnergyDoesNotChangeWhenAnElementTurns) {
  const Vector3d theta(0.3, -0.7, 0.5);
  for (const Case& c : all_cases()) {
    const VectorXd w = some_displacements(c, 0.2), d = some_displacements(c, 1.4);
    const MatrixXd K = geometric_stiffness(c.rows, w);
    const double stressed = turn(c, theta).dot(K * d), linear = (c.S * w).dot(turned(c, theta, d));
    const double size = (c.S * w).cwiseAbs().dot(turned(c, theta, d).cwiseAbs());
    EXPECT_GT(std::abs(linear), 1e-4 * size) << c.name;  // there is something to cancel
    EXPECT_NEAR(stressed, -linear, 1e-11 * size) << c.name;
  }
}

TEST(SecondOrder, GeometricStiffnessIsSymmetricAndRigidMotionsHaveNoStress) {
  for (const Case& c : all_cases()) {
    const MatrixXd K = geometric_stiffness(c.rows, some_displacements(c, 0.7));
    const double size = K.cwiseAbs().maxCoeff();
    EXPECT_EQ((K - K.transpose()).cwiseAbs().maxCoeff(), 0.0) << c.name;
    VectorXd rigid = turn(c, Vector3d(0.3, -0.7, 0.5));
    for (Eigen::Index i = 0; i < c.position.cols(); ++i) rigid.segment<3>(c.components * i) += Vector3d(0.5, 0.9, -0.4);
    EXPECT_LT(geometric_stiffness(c.rows, rigid).cwiseAbs().maxCoeff(), 1e-12 * size) << c.name;
    // A translation works nowhere.
    VectorXd shift = VectorXd::Zero(c.S.rows());
    for (Eigen::Index i = 0; i < c.position.cols(); ++i) shift.segment<3>(c.components * i) = Vector3d(0.5, 0.9, -0.4);
    EXPECT_LT((K * shift).cwiseAbs().maxCoeff(), 1e-12 * size) << c.name;
  }
}

// Stiffness, mass and geometric stiffness of one beam, with every stress and with the axial force alone (which the
// full one contains): computed by an independent prototype with four Gauss points, of a section without polar moment.
TEST(SecondOrder, BeamHasTheKnownAnswer) {
  std::ifstream file(std::string(TISSERAND_REFERENCES) + "/second_order_known_answers.json");
  const nlohmann::json entry = nlohmann::json::parse(file).at("element"), section = entry["section"];
  BeamElementData data;
  // E = G = 1: the constants are the products of the section; ρ = 1e-4 times EI is the rotary inertia.
  data.material = {"m", 1.0, -0.5, 1e-4, ""};
  data.section.area = section["EA"];
  data.section.second_moment_y = section["EI2"];
  data.section.second_moment_z = section["EI3"];
  data.section.torsion_constant = section["GJ"];
  data.section.shear_area_y = data.section.shear_area_z = section["GA"];
  data.added_mass.first = data.added_mass.second = section["rA"].get<double>() - 1e-4 * data.section.area;
  data.added_mass.inertia = section["rJ"];
  Mesh mesh = beam_mesh(data);
  mesh.position << 0.0, entry["length"].get<double>(), 0.0, 0.0, 0.0, 0.0;
  mesh.beams[0].R_PE.setIdentity();
  const Case c = make_case("known", mesh, mesh.beams[0], 6);
  const MatrixXd K = test_support::to_matrix(entry["K"]), K_G = test_support::to_matrix(entry["KG"]);
  EXPECT_LE((c.S - K).cwiseAbs().maxCoeff(), 1e-11 * K.cwiseAbs().maxCoeff());
  const VectorXd w = test_support::to_vector(entry["w"]);
  EXPECT_LE((geometric_stiffness(c.rows, w) - K_G).cwiseAbs().maxCoeff(), 1e-11 * K_G.cwiseAbs().maxCoeff());
  ElementMatrices matrices;
  element_matrices(mesh, mesh.beams[0], matrices);
  const MatrixXd M = test_support::to_matrix(entry["M"]);
  EXPECT_LE((matrices.M - M).cwiseAbs().maxCoeff(), 1e-11 * M.cwiseAbs().maxCoeff());
  // The stretch of w alone has its axial force and nothing else.
  VectorXd stretch = VectorXd::Zero(12);
  stretch[6] = entry["w"][6].get<double>() - entry["w"][0].get<double>();
  const MatrixXd axial = test_support::to_matrix(entry["KG_N_only"]);
  EXPECT_LE((geometric_stiffness(c.rows, stretch) - axial).cwiseAbs().maxCoeff(), 1e-11 * axial.cwiseAbs().maxCoeff());
  // With a polar moment I_p: N (I_p/A)/L [1 −1; −1 1] on the twist, and nothing else (Wagner).
  mesh.beam_properties[0].data.section.polar_moment = 3.0;
  const Case twisted = make_case("with Wagner's term", mesh, mesh.beams[0], 6);
  const double wagner = (w[6] - w[0]) / entry["length"].get<double>() * 3.0 / entry["length"].get<double>();
  MatrixXd expected = K_G;
  expected(3, 3) += wagner, expected(9, 9) += wagner;
  expected(3, 9) -= wagner, expected(9, 3) -= wagner;
  EXPECT_LE((geometric_stiffness(twisted.rows, w) - expected).cwiseAbs().maxCoeff(), 1e-11 * K_G.cwiseAbs().maxCoeff());
}

/// ½ fᵀ S f of what is left of d when the rotation exp(ω), ω = turn d, is taken out exactly.
double corotated_energy(const Case& c, const Eigen::Matrix<double, 3, Eigen::Dynamic>& turn_rows, const VectorXd& d) {
  const Vector3d omega = turn_rows * d;
  const Matrix3d back = exp_so3<double>(Vector3d(-omega));
  VectorXd left(d.size());
  for (int i = 0; i < 2; ++i) {
    const Vector3d X = c.position.col(i) - c.position.col(0), u = d.segment<3>(6 * i) - d.head<3>();
    left.segment<3>(6 * i) = back * (X + u) - X;
    left.segment<3>(6 * i + 3) = log_so3<double>(Matrix3d(back * exp_so3<double>(Vector3d(d.segment<3>(6 * i + 3)))));
  }
  return 0.5 * left.dot(c.S * left);
}

// The cubic part of the exact energy of two nodes whose rotation is taken out, by differences of order 4.
TEST(SecondOrder, SpringsHaveTheThirdOrderOfTheExactEnergy) {
  for (const Case& c : spring_cases()) {
    const auto rows = turn_of_pair(c.position.col(1) - c.position.col(0));
    const VectorXd d = some_displacements(c, 0.9);
    const auto odd = [&](double h) {
      return (corotated_energy(c, rows, h * d) - corotated_energy(c, rows, -h * d)) / (2.0 * h * h * h);
    };
    const double cubic = (4.0 * odd(0.01) - odd(0.02)) / 3.0;  // of h⁵ nothing is left
    const double expected = 0.5 * d.dot(geometric_stiffness(c.rows, d) * d);
    EXPECT_NEAR(cubic, expected, 1e-5 * std::abs(expected)) << c.name;
  }
}

// An axial spring with the force F has (F/l)(1 − e eᵀ) at each of its ends (textbook).
TEST(SecondOrder, StretchedSpringIsAString) {
  const Vector3d arm(0.4, 0.3, -0.2);
  const Case c = spring_cases()[0];
  VectorXd w = VectorXd::Zero(12);
  w.segment<3>(6) = 0.01 * arm;
  const double force = 3.0 * 0.01 * arm.norm();
  const Vector3d e = arm.normalized();
  MatrixXd expected = MatrixXd::Zero(12, 12);
  const Matrix3d block = force / arm.norm() * (Matrix3d::Identity() - e * e.transpose());
  expected.block<3, 3>(0, 0) = expected.block<3, 3>(6, 6) = block;
  expected.block<3, 3>(0, 6) = expected.block<3, 3>(6, 0) = -block;
  EXPECT_LE((geometric_stiffness(c.rows, w) - expected).cwiseAbs().maxCoeff(), 1e-14 * force / arm.norm());
}

}  // namespace
}  // namespace tisserand::reducer::second_order_test
