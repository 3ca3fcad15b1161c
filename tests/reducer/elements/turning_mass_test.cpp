// SPDX-License-Identifier: GPL-3.0-or-later
// Inertia of every kind of element in a turning frame: its mass matrix, the momentum of a turned shape, and the energy
// of an element that is turned as a whole.
#include "reducer/elements/turning_mass.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "formats/companion/companion.hpp"
#include "reducer/elements/beam/beam.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "tests/problems/turning_forms.hpp"
#include "tests/reducer/elements/shell_cases.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::reducer::turning_mass_test {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

const Vector3d reference(0.4, -0.7, 0.2);

/// One element of any kind with its mass; `alike`: its mass moves alike in all directions, three coordinates per node.
struct Case {
  std::string name;
  MatrixXd M;
  MatrixXd load;
  TurningForms mass = TurningForms(0);
  Eigen::Matrix3Xd position;
  int components = 6;

  void take(const TurningMass& from) {
    load = from.load;
    mass = testing::turning_forms(from);
  }
};

template <class Element>
Case moving_case(const std::string& name, const Mesh& mesh, const Element& element) {
  Case c;
  c.name = name;
  ElementMatrices matrices;
  element_matrices(mesh, element, matrices);
  c.M = matrices.M;
  c.position = mesh.position;
  TurningMass turning;
  turning_mass(moving_mass(mesh, element), reference, turning);
  c.take(turning);
  return c;
}

BeamElementData beam_data() {
  BeamElementData data;
  data.section = {"s", 2e-3, 3e-6, 8e-6, 6e-8, 11e-6, 1.1e-3, 0.9e-3, ""};
  data.material = {"m", 2.1e11, 0.3, 7850.0, ""};
  return data;
}

Case beam_case(const std::string& name, const BeamElementData& data, std::uint16_t released = 0,
               const Vector3d& offset = Vector3d::Zero()) {
  Mesh mesh;
  mesh.position.resize(3, 2);
  mesh.position << 0.2, 0.9, -0.1, 0.5, 0.4, 0.7;
  mesh.beam_properties = {{data, "beam"}};
  BeamElement beam;
  beam.second = 1;
  beam.released = released;
  beam.first_offset = offset;
  beam.second_offset = 0.5 * Vector3d(offset.y(), offset.z(), -offset.x());
  beam.R_PE = *beam_axes(mesh.position.col(1) + beam.second_offset - mesh.position.col(0) - beam.first_offset,
                         Vector3d(0.3, -0.2, 1.0));
  return moving_case(name, mesh, beam);
}

std::vector<Case> beam_cases() {
  const BeamElementData plain = beam_data();
  BeamElementData bernoulli = plain, stiff = plain, odd = plain, tapered = plain, rod = plain, lumped = plain, without = plain;
  bernoulli.theory = formats::BeamTheory::euler_bernoulli;
  stiff.section.shear_area_y = 0.0;
  odd.section.second_moment_yz = -2e-6;
  odd.section.centroid_y = 0.01;
  odd.section.shear_center_z = 0.015;
  odd.section.shear_coupling = 120.0;
  odd.added_mass = {3.0, 7.0, 0.02, 0.03, -0.05};
  tapered.stations = {plain.section, plain.section};
  tapered.stations[1].area *= 0.3;
  tapered.stations[1].second_moment_y *= 0.2;
  tapered.stations[1].second_moment_z *= 0.4;
  rod.section.second_moment_y = rod.section.second_moment_z = 0.0;
  lumped.mass_matrix = formats::MassMatrix::lumped;
  without.rotary_inertia = RotaryInertia::without;
  BeamElementData lumped_odd = odd;
  lumped_odd.mass_matrix = formats::MassMatrix::lumped;
  const Vector3d arm(0.1, -0.05, 0.2);
  return {beam_case("Timoshenko", plain),
          beam_case("Euler-Bernoulli", bernoulli),
          beam_case("rigid in shear across y", stiff),
          beam_case("odd section, added mass", odd),
          beam_case("tapered", tapered),
          beam_case("lumped", lumped),
          beam_case("lumped, odd, offset", lumped_odd, 0, arm),
          beam_case("without rotary inertia", without),
          beam_case("offset", odd, 0, arm),
          beam_case("hinge", plain, 1 << 5),
          beam_case("slide and hinges, offset", plain, 1 << 1 | 1 << 10 | 1 << 11, arm),
          beam_case("rod", rod)};
}

std::vector<Case> shell_cases() {
  std::vector<Case> cases;
  for (const formats::MassMatrix kind : {formats::MassMatrix::consistent, formats::MassMatrix::lumped}) {
    const auto add = [&](std::string name, const Eigen::Matrix3Xd& X, const ShellSection& section, double offset) {
      Mesh mesh = one_shell(somewhere(X), section);
      mesh.shell_properties[0].mass_matrix = kind;
      mesh.shells[0].offset = offset;
      if (kind == formats::MassMatrix::lumped) name += ", lumped";
      cases.push_back(moving_case(name, mesh, mesh.shells[0]));
    };
    add("square", square(), steel(0.05), 0.0);
    add("distorted, offset", distorted_quad(), steel(0.01), 0.1);
    add("warped laminate", warped_quad(), skew_laminate(), -0.03);
    add("triangle", triangle(), steel(0.02), 0.0);
    add("triangular laminate, offset", triangle(), skew_laminate(), 0.05);
  }
  return cases;
}

std::vector<Case> other_cases() {
  std::vector<Case> cases;
  SolidProperty property;
  property.material = isotropic_solid(2.1e11, 0.3, 7850.0);
  for (const SolidShape shape : all_solid_shapes) {
    const Mesh mesh = one_solid(shape, somewhere(natural_nodes(shape)), property);
    Case c;
    c.name = solid_name(shape);
    c.components = 3;
    c.position = mesh.position;
    ElementMatrices matrices;
    element_matrices(mesh, mesh.solids[0], matrices);
    c.M = matrices.M;
    MatrixXd D(c.M.rows(), 6);
    for (Index i = 0; i < c.position.cols(); ++i)
      D.middleRows<3>(3 * i) << Matrix3d::Identity(), -skew<double>(Vector3d(c.position.col(i) - reference));
    TurningMass turning;
    turning_mass(c.M, D, turning);
    c.take(turning);
    cases.push_back(c);
  }
  Mesh mesh;
  mesh.position = Vector3d(0.3, 0.5, -0.4);
  NodalMass mass;
  mass.mass = 2.0;
  mass.inertia << 0.3, 0.05, -0.02, 0.05, 0.4, 0.01, -0.02, 0.01, 0.5;
  for (const Vector3d& offset : {Vector3d(Vector3d::Zero()), Vector3d(0.2, -0.1, 0.3)}) {
    mass.offset = offset;
    Case c;
    c.name = offset.isZero() ? "point mass" : "point mass, offset";
    c.position = mesh.position;
    c.M = nodal_mass_matrix(mass);
    TurningMass turning;
    turning_mass(moving_mass(mesh, mass), reference, turning);
    c.take(turning);
    cases.push_back(c);
  }
  return cases;
}

std::vector<Case> all_cases() {
  std::vector<Case> cases = beam_cases();
  for (const auto& more : {shell_cases(), other_cases()}) cases.insert(cases.end(), more.begin(), more.end());
  return cases;
}

VectorXd some_displacements(Index n, double phase) {
  return VectorXd::NullaryExpr(n, [phase](Index i) { return std::sin(phase + 2.7 * static_cast<double>(i * i + 1)); });
}

MatrixXd rigid(const Case& c) {
  MatrixXd R = MatrixXd::Zero(c.M.rows(), 6);
  for (Index i = 0; i < c.position.cols(); ++i) {
    R.middleRows<3>(c.components * i) << Matrix3d::Identity(), -skew<double>(Vector3d(c.position.col(i) - reference));
    if (c.components == 6) R.block<3, 3>(6 * i + 3, 3).setIdentity();
  }
  return R;
}

/// Rows of the nodes with what `translation` and `rotation` give of their displacements.
template <class Translation, class Rotation>
VectorXd of_nodes(const Case& c, const VectorXd& d, const Translation& translation, const Rotation& rotation) {
  VectorXd out(d.size());
  for (Index i = 0; i < c.position.cols(); ++i) {
    out.segment<3>(c.components * i) = translation(Vector3d(d.segment<3>(c.components * i)));
    if (c.components == 6) out.segment<3>(6 * i + 3) = rotation(Vector3d(d.segment<3>(6 * i + 3)));
  }
  return out;
}

// The first loads are those of M D: the forms and the mass matrix integrate the same masses.
TEST(TurningMass, LoadsAreThoseOfTheMassMatrix) {
  for (const Case& c : all_cases()) {
    const MatrixXd expected = c.M * rigid(c);
    EXPECT_LT((c.load.leftCols<6>() - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff())
        << c.name;
  }
}

// A turn θ of the displacements d adds θ × u and ½ θ × ψ at nodes; the momentum of the element becomes the turned one:
// gₐ·(θ × u, ½ θ × ψ) + (R θ)ᵀ N_a d = e_a·(θ × Σ m u), and R_Tᵀ C_k d = e_k × Σ m u. Exact for any shape functions.
TEST(TurningMass, MomentumOfATurnedShapeIsTheTurnedMomentum) {
  const Vector3d theta(0.3, -0.7, 0.5);
  for (const Case& c : all_cases()) {
    const VectorXd d = some_displacements(c.M.rows(), 0.4), turn = rigid(c).rightCols<3>() * theta;
    const VectorXd second = of_nodes(
        c, d, [&](const Vector3d& u) { return theta.cross(u); },
        [&](const Vector3d& psi) { return Vector3d(0.5 * theta.cross(psi)); });
    const Vector3d momentum = c.load.leftCols<3>().transpose() * d, turned = theta.cross(momentum);
    for (int a = 0; a < 3; ++a) {
      EXPECT_NEAR(c.load.col(a).dot(second) + turn.dot(c.mass.N[a] * d), turned[a], 1e-12 * momentum.norm())
          << c.name << a;
      const Vector3d spun = rigid(c).leftCols<3>().transpose() * c.mass.C[a] * d;
      EXPECT_LT((spun - Vector3d::Unit(a).cross(momentum)).norm(), 1e-12 * momentum.norm()) << c.name << a;
    }
  }
}

// An element that is turned by θ as a whole has the inertia R J₀ Rᵀ, at second order
// ½ (Ω × θ)·J₀ (Ω × θ) + ½ (J₀ Ω)·(θ × (θ × Ω)); its nodes move by ½ θ × (θ × X) beside R θ. And the moment of its
// momentum under θ̇ and Ω has the terms (Ω × θ)·J₀ θ̇ − ½ Ω·J₀ (θ × θ̇).
TEST(TurningMass, EnergyOfATurnedElement) {
  const Vector3d theta(0.3, -0.7, 0.5), Omega(0.4, 0.9, -0.6), rate(-0.2, 0.5, 0.8);
  for (const Case& c : all_cases()) {
    const MatrixXd R = rigid(c);
    const Matrix3d J0 = R.rightCols<3>().transpose() * c.M * R.rightCols<3>();
    const VectorXd y = R.rightCols<3>() * theta, yd = R.rightCols<3>() * rate;
    VectorXd y2 = VectorXd::Zero(y.size()), yd2 = y2;  // ½ θ × (θ × X), and its rate
    for (Index i = 0; i < c.position.cols(); ++i) {
      const Vector3d X = c.position.col(i) - reference;
      y2.segment<3>(c.components * i) = 0.5 * theta.cross(theta.cross(X));
      yd2.segment<3>(c.components * i) = 0.5 * (rate.cross(theta.cross(X)) + theta.cross(rate.cross(X)));
    }
    double quadratic = 0.0, gyroscopic = Omega.dot(Vector3d(c.load.middleCols<3>(3).transpose() * yd2));
    for (int k = 0; k < 3; ++k) {
      quadratic += Omega[k] * (R.rightCols<3>() * Omega).dot(c.mass.C[k] * y2);
      gyroscopic += Omega[k] * yd.dot((c.mass.C[k] + c.mass.N[3 + k]) * y);
      gyroscopic += Omega[k] * yd.dot(c.mass.W[k] * y);
      for (int j = 0; j < 3; ++j) {
        const int pair = formats::axis_pair(j, k);
        quadratic += 0.5 * Omega[j] * Omega[k] * y.dot((c.mass.E[pair] + c.mass.T[pair]) * y);
      }
    }
    const Vector3d moved = Omega.cross(theta);
    const double size = J0.norm();
    EXPECT_NEAR(quadratic, 0.5 * moved.dot(J0 * moved) + 0.5 * (J0 * Omega).dot(theta.cross(theta.cross(Omega))),
                1e-12 * size)
        << c.name;
    EXPECT_NEAR(gyroscopic, moved.dot(J0 * rate) - 0.5 * (J0 * Omega).dot(theta.cross(rate)), 1e-12 * size) << c.name;
  }
}

}  // namespace
}  // namespace tisserand::reducer::turning_mass_test
