// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of single beam elements: forces are gradients, tangents are derivatives, rigid motions are free of strain.
#include <complex>

#include <gtest/gtest.h>

#include "common/error.hpp"
#include "tests/support/bodies/beam_states.hpp"

namespace tisserand::mechanism::beam_element_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::perturbed;
using test::random_state;
using test::random_vector;

template <class T>
struct BeamElementTest : ::testing::Test {
  using Residual = Eigen::Matrix<double, 6 * T::value, 1>;
  using Tangent = Eigen::Matrix<double, 6 * T::value, 6 * T::value>;
  BeamElement<T::value> general = test::general_element<T::value>();
  std::mt19937 generator{11};
  Vector3d gravity = {0.3, -0.7, 1.1};
};
using Sizes = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(BeamElementTest, Sizes);

// Deformations from rounding over every series switch (|ψ| = 0.5, φ = 1) to relative rotations near 2.
constexpr double sizes[] = {0.0, 1e-9, 1e-4, 0.02, 0.1, 0.2, 0.4, 0.8, 1.2};

TYPED_TEST(BeamElementTest, ForceIsTheGradientOfTheEnergy) {
  constexpr int N = TypeParam::value;
  for (const double size : sizes) {  // stiffnesses and lengths are of size one: tolerance 100 times rounding
    std::vector<NodeMotion> nodes = random_state<N>(this->generator, size);
    for (NodeMotion& n : nodes) n.xd = n.Omega = n.xdd = n.Omegad = Vector3d::Zero();
    typename TestFixture::Residual r;
    residual(this->general, nodes, Vector3d::Zero(), r);
    for (int dof = 0; dof < 6 * N; ++dof) {
      using C = std::complex<double>;
      const auto moved = perturbed<C, N>(nodes, dof, C(0, 1e-30), C(0), C(0));
      const C W = beam::strain_energy(this->general, test::configuration<C, N>(moved));
      EXPECT_NEAR(r[dof], W.imag() / 1e-30, 1e-13) << "dof " << dof << ", size " << size;
    }
  }
}

TYPED_TEST(BeamElementTest, GravityIsTheGradientOfItsPotential) {
  constexpr int N = TypeParam::value;
  std::vector<NodeMotion> nodes = random_state<N>(this->generator, 0.3);
  for (NodeMotion& n : nodes) n.xd = n.Omega = n.xdd = n.Omegad = Vector3d::Zero();
  typename TestFixture::Residual with, without;
  residual(this->general, nodes, this->gravity, with);
  residual(this->general, nodes, Vector3d::Zero(), without);
  for (int i = 0; i < N; ++i)
    for (int k = 0; k < 3; ++k) {
      const auto moved = [&](double distance) {
        std::vector<NodeMotion> other = nodes;
        other[i].x[k] += distance;
        return energy(this->general, other, this->gravity).potential;
      };
      // the potential is of second degree: its central difference is exact
      EXPECT_NEAR((with - without)[6 * i + k], (moved(1.0) - moved(-1.0)) / 2.0, 1e-14 * 10.0);
      const auto turned = [&](double angle) {
        std::vector<NodeMotion> other = nodes;
        other[i].R = other[i].R * exp_so3<double>(angle * Vector3d::Unit(k));
        return energy(this->general, other, this->gravity).potential;
      };
      // central difference, error h² of size one
      EXPECT_NEAR((with - without)[6 * i + 3 + k], (turned(1e-4) - turned(-1e-4)) / 2e-4, 1e-7);
    }
}

// A = c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q is the directional derivative with δq = c_k, δv = c_c, δv̇ = c_m.
TYPED_TEST(BeamElementTest, TangentEqualsComplexStepAndDual) {
  constexpr int N = TypeParam::value;
  const TangentCoefficients c{.mass = 0.7, .damping = 1.3, .stiffness = 0.9};
  for (const double size : sizes) {
    const std::vector<NodeMotion> nodes = random_state<N>(this->generator, size);
    typename TestFixture::Residual r, only;
    typename TestFixture::Tangent A;
    residual(this->general, nodes, this->gravity, only);
    residual_and_tangent(this->general, nodes, this->gravity, c, r, A);
    EXPECT_EQ(r, only);
    for (int dof = 0; dof < 6 * N; ++dof) {
      using C = std::complex<double>;
      constexpr double h = 1e-30;
      const auto moved = perturbed<C, N>(nodes, dof, C(0, h * c.stiffness), C(0, h * c.damping), C(0, h * c.mass));
      const Eigen::Matrix<C, 6 * N, 1> rc = test::scalar_residual<C, N>(this->general, moved, this->gravity);
      const auto dual = perturbed<Dual, N>(nodes, dof, Dual(0, c.stiffness), Dual(0, c.damping), Dual(0, c.mass));
      const Eigen::Matrix<Dual, 6 * N, 1> rd = test::scalar_residual<Dual, N>(this->general, dual, this->gravity);
      for (int i = 0; i < 6 * N; ++i) {
        // Closed forms of e' next to the switch at |ψ| = 0.5 lose (1/ψ²)² = 16 of rounding: 1e-13 of the scale.
        EXPECT_NEAR(A(i, dof), rc[i].imag() / h, 2e-13 * (1.0 + r.norm())) << i << ' ' << dof << ' ' << size;
        EXPECT_NEAR(A(i, dof), rd[i].derivative, 2e-13 * (1.0 + r.norm())) << i << ' ' << dof << ' ' << size;
        EXPECT_NEAR(r[i], rd[i].value, 1e-14 * (1.0 + r.norm()));
      }
    }
  }
}

// Independent of the templates: central differences of the compiled residual, error h² r'''/6 + rounding/h = 1e-10.
TYPED_TEST(BeamElementTest, TangentEqualsCentralDifferences) {
  constexpr int N = TypeParam::value;
  const TangentCoefficients c{.mass = 0.0, .damping = 0.0, .stiffness = 1.0};
  const std::vector<NodeMotion> nodes = random_state<N>(this->generator, 0.4);
  typename TestFixture::Residual r, plus, minus;
  typename TestFixture::Tangent A;
  residual_and_tangent(this->general, nodes, this->gravity, c, r, A);
  for (int dof = 0; dof < 6 * N; ++dof) {
    const double h = 1e-5;
    std::vector<NodeMotion> moved = nodes;
    NodeMotion& n = moved[dof / 6];
    const Vector3d step = h * Vector3d::Unit(dof % 3);
    const NodeMotion start = n;
    if (dof % 6 < 3)
      n.x = start.x + step;
    else
      n.R = start.R * exp_so3<double>(step);
    residual(this->general, moved, this->gravity, plus);
    if (dof % 6 < 3)
      n.x = start.x - step;
    else
      n.R = start.R * exp_so3<double>(-step);
    residual(this->general, moved, this->gravity, minus);
    EXPECT_LT(((plus - minus) / (2 * h) - A.col(dof)).cwiseAbs().maxCoeff(), 1e-9) << dof;
  }
}

TYPED_TEST(BeamElementTest, ReferenceIsFreeOfStressUnderAnyRigidMotion) {
  constexpr int N = TypeParam::value;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<NodeMotion> nodes(N);
    const Matrix3d turn = exp_so3<double>(random_vector(this->generator, 1.8));
    const Vector3d shift = random_vector(this->generator, 10.0);
    for (int i = 0; i < N; ++i) {
      const double s = static_cast<double>(i) / (N - 1);
      nodes[i].x = shift + turn * Vector3d(s, 0.2 * s * s, -0.1 * s);
      nodes[i].R = turn;
    }
    typename TestFixture::Residual r;
    residual(this->general, nodes, Vector3d::Zero(), r);
    // Positions near 17 are rounded by 2e-15, differentiated with slopes up to 4 and multiplied by stiffnesses below 2.
    EXPECT_LT(r.cwiseAbs().maxCoeff(), 5e-14);
    for (const BeamSectionForces& p : section_forces(this->general, nodes)) {
      EXPECT_LT(p.gamma.norm(), 5e-14);
      EXPECT_LT(p.kappa.norm(), 1e-14);
    }
  }
}

TYPED_TEST(BeamElementTest, RigidMotionOfADeformedElementLeavesStrainsEnergyAndMaterialForces) {
  constexpr int N = TypeParam::value;
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<NodeMotion> nodes = random_state<N>(this->generator, 0.5);
    std::vector<NodeMotion> turned = nodes;
    const Matrix3d Q = exp_so3<double>(random_vector(this->generator, 1.8));
    const Vector3d shift = random_vector(this->generator, 10.0);
    for (NodeMotion& n : turned) {
      n.x = shift + Q * n.x;
      n.R = Q * n.R;
      n.xd = Q * n.xd;
      n.xdd = Q * n.xdd;
    }
    typename TestFixture::Residual r, r_turned;
    residual(this->general, nodes, this->gravity, r);
    residual(this->general, turned, Q * this->gravity, r_turned);
    for (int i = 0; i < N; ++i) {
      EXPECT_LT((Q * r.template segment<3>(6 * i) - r_turned.template segment<3>(6 * i)).norm(), 2e-14);
      EXPECT_LT((r.template segment<3>(6 * i + 3) - r_turned.template segment<3>(6 * i + 3)).norm(), 2e-14);
    }
    const BeamEnergy e = energy(this->general, nodes, this->gravity);
    const BeamEnergy e_turned = energy(this->general, turned, Q * this->gravity);
    EXPECT_NEAR(e.strain, e_turned.strain, 2e-14);
    EXPECT_NEAR(e.kinetic, e_turned.kinetic, 2e-14);
  }
}

// The whole element is in equilibrium: internal forces have no resultant and no moment about the origin.
TYPED_TEST(BeamElementTest, InternalForcesAreInEquilibrium) {
  constexpr int N = TypeParam::value;
  for (const double size : sizes) {
    std::vector<NodeMotion> nodes = random_state<N>(this->generator, size);
    for (NodeMotion& n : nodes) n.xd = n.Omega = n.xdd = n.Omegad = Vector3d::Zero();
    typename TestFixture::Residual r;
    residual(this->general, nodes, Vector3d::Zero(), r);
    Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
    for (int i = 0; i < N; ++i) {
      force += r.template segment<3>(6 * i);
      moment += nodes[i].x.cross(r.template segment<3>(6 * i)) + nodes[i].R * r.template segment<3>(6 * i + 3);
    }
    EXPECT_LT(force.norm(), 1e-14);
    EXPECT_LT(moment.norm(), 1e-13);  // arms of length 5
  }
}

// Work of the inertia forces along the motion is the rate of the kinetic energy (central difference in time, error h²
// of size one; the mass matrix of two nodes turns with them).
TYPED_TEST(BeamElementTest, InertiaForcesDoTheWorkOfTheKineticEnergy) {
  constexpr int N = TypeParam::value;
  const std::vector<NodeMotion> nodes = random_state<N>(this->generator, 0.4);
  std::vector<NodeMotion> at_rest = nodes;
  for (NodeMotion& n : at_rest) n.xd = n.Omega = n.xdd = n.Omegad = Vector3d::Zero();
  typename TestFixture::Residual r, static_part;
  residual(this->general, nodes, Vector3d::Zero(), r);
  residual(this->general, at_rest, Vector3d::Zero(), static_part);
  double power = 0.0;
  for (int i = 0; i < N; ++i)
    power += (r - static_part).template segment<3>(6 * i).dot(nodes[i].xd) +
             (r - static_part).template segment<3>(6 * i + 3).dot(nodes[i].Omega);
  const auto kinetic = [&](double t) {
    std::vector<NodeMotion> moved = nodes;
    for (NodeMotion& n : moved) {
      n.x += t * n.xd + 0.5 * t * t * n.xdd;
      n.R = n.R * exp_so3<double>(t * n.Omega + 0.5 * t * t * n.Omegad);
      n.xd += t * n.xdd;
      n.Omega += t * n.Omegad;
    }
    return energy(this->general, moved, Vector3d::Zero()).kinetic;
  };
  EXPECT_NEAR(power, (kinetic(1e-4) - kinetic(-1e-4)) / 2e-4, 1e-7);
}

TYPED_TEST(BeamElementTest, RotatingStraightRodHasTheMomentumOfTheContinuum) {
  constexpr int N = TypeParam::value;
  BeamReference<N> reference;
  reference.length = 2.0;
  std::vector<NodeMotion> nodes(N);
  const Vector3d omega(0.4, -0.3, 1.2), domega(0.5, 0.1, -0.6);
  for (int i = 0; i < N; ++i) {
    reference.nodes[i] = i;
    reference.position[i] = {2.0 * i / (N - 1), 0, 0};
    reference.section[i].setIdentity();
    nodes[i].x = reference.position[i];
    nodes[i].Omega = omega;
    nodes[i].Omegad = domega;
    nodes[i].xd = omega.cross(nodes[i].x);
    nodes[i].xdd = domega.cross(nodes[i].x) + omega.cross(omega.cross(nodes[i].x));
  }
  const formats::Section section = test::rectangle(0.3, 0.2, 0.001, 0.8);
  const BeamElement<N> element = make_beam_element<N>(reference, section, test::material(2.0, 0.3, 3.0));
  typename TestFixture::Residual r;
  residual(element, nodes, Vector3d::Zero(), r);
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
  for (int i = 0; i < N; ++i) {
    force += r.template segment<3>(6 * i);
    moment += nodes[i].x.cross(r.template segment<3>(6 * i)) + r.template segment<3>(6 * i + 3);
  }
  const double m = 3.0 * section.area * 2.0, I = m * 4.0 / 3.0;
  const Vector3d J(6.0 * section.polar_moment, 6.0 * section.second_moment_y + I, 6.0 * section.second_moment_z + I);
  const Vector3d center(1, 0, 0);
  const Vector3d expected = J.cwiseProduct(domega) + omega.cross(J.cwiseProduct(omega));
  EXPECT_LT((force - m * (domega.cross(center) + omega.cross(omega.cross(center)))).norm(), 1e-14);
  EXPECT_LT((moment - expected).norm(), 1e-14);
  EXPECT_NEAR(energy(element, nodes, Vector3d::Zero()).kinetic, 0.5 * omega.dot(J.cwiseProduct(omega)), 1e-14);
}

// EA, GA, EI, GJ, mass and rotary inertia per length instead of shape and material: the same element to rounding.
TYPED_TEST(BeamElementTest, SectionByStiffnessIsTheSameElement) {
  constexpr int N = TypeParam::value;
  BeamReference<N> reference;
  reference.length = 2.0;
  for (int i = 0; i < N; ++i) {
    reference.nodes[i] = i;
    reference.position[i] = {2.0 * i / (N - 1), 0, 0};
    reference.section[i].setIdentity();
  }
  const formats::Section shape = test::rectangle(0.3, 0.2, 0.001, 0.8);
  const formats::Material material = test::material(2.0, 0.3, 3.0);
  formats::Section stiffness;
  const double E = 2.0, G = material.shear_modulus(), rho = 3.0;
  stiffness.by_stiffness = true;
  stiffness.area = E * shape.area;
  stiffness.second_moment_y = E * shape.second_moment_y;
  stiffness.second_moment_z = E * shape.second_moment_z;
  stiffness.torsion_constant = G * shape.torsion_constant;
  stiffness.shear_area_y = G * shape.shear_area_y;
  stiffness.shear_area_z = G * shape.shear_area_z;
  stiffness.mass_per_length = rho * shape.area;
  stiffness.rotary_inertia_y = rho * shape.second_moment_y;
  stiffness.rotary_inertia_z = rho * shape.second_moment_z;
  const auto a = make_beam_element<N>(reference, shape, material);
  const auto b = make_beam_element<N>(reference, stiffness, formats::unit_material(""));
  EXPECT_LT((a.force_stiffness - b.force_stiffness).norm(), 1e-15);
  EXPECT_LT((a.moment_stiffness - b.moment_stiffness).norm(), 1e-15);
  EXPECT_NEAR(a.mass, b.mass, 1e-15);
  for (int i = 0; i < N; ++i) EXPECT_LT((a.inertia[i] - b.inertia[i]).norm(), 1e-15);
}

// Torsion between nodes that keep their distance: fibres at r from the axis lengthen by r²κ²/2, so that N = E A ρ²κ²/2
// and the torque is G J κ + N ρ² κ (Wagner), whatever the angle below π. ρ² = (0.3² + 0.2²)/12.
TYPED_TEST(BeamElementTest, ConstantTwistGivesItsTorque) {
  constexpr int N = TypeParam::value;
  BeamReference<N> reference;
  reference.length = 2.0;
  std::vector<NodeMotion> nodes(N);
  for (int i = 0; i < N; ++i) {
    reference.nodes[i] = i;
    reference.position[i] = {2.0 * i / (N - 1), 0, 0};
    reference.section[i].setIdentity();
    nodes[i].x = reference.position[i];
    nodes[i].R = exp_so3<double>(Vector3d(2.5 * i / (N - 1), 0, 0));
  }
  const formats::Section section = test::rectangle(0.3, 0.2, 0.001, 0.8);
  const BeamElement<N> element = make_beam_element<N>(reference, section, test::material(2.0, 0.25, 3.0));
  for (const BeamSectionForces& p : section_forces(element, nodes)) {
    const double kappa = 2.5 / 2.0, square = 0.13 / 12.0, N_force = 2.0 * 0.06 * square * kappa * kappa / 2.0;
    EXPECT_NEAR(p.moment.x(), (2.0 / 2.5 * 0.001 + N_force * square) * kappa, 1e-16);  // G = E/2.5
    EXPECT_NEAR(p.force.x(), N_force, 1e-16);
    EXPECT_LT(p.force.tail<2>().norm() + p.moment.tail<2>().norm(), 1e-15);
  }
}

// Series and closed forms against the series in long double (60 terms, exact to its rounding for u below 12).
TEST(BeamElement, FunctionsOfTheAngleAcrossTheSeriesSwitches) {
  using beam::CurvatureFunctions;
  const auto series = [](long double u, int first, int order) {
    long double sum = 0.0L;
    for (int k = 60; k >= 0; --k) {
      long double value = (k + order) % 2 == 0 ? 1.0L : -1.0L;
      for (int i = 2; i <= 2 * (k + order) + first; ++i) value /= i;
      for (int i = 0; i < order; ++i) value *= 2.0L * (k + order - i);
      sum = sum * u + value;
    }
    return sum;
  };
  for (double u = 1e-8; u < 11.0; u *= 1.07) {
    const CurvatureFunctions<double> f(u);
    const auto expect = [&](double value, int first, int order, double tolerance) {
      const double expected = static_cast<double>(series(static_cast<long double>(u), first, order));
      EXPECT_NEAR(value, expected, tolerance) << "u = " << u << ", order " << order;
    };
    expect(f.c, 2, 0, 1e-15);
    expect(f.d, 3, 0, 1e-15);
    expect(f.c1, 2, 1, 2e-15);  // closed forms subtract numbers of size one above u = 1
    expect(f.d1, 3, 1, 2e-15);
    expect(f.c2(u), 2, 2, 1e-14);
    expect(f.d2(u), 3, 2, 1e-14);
  }
}

TEST(BeamElement, LogarithmAcrossTheSeriesSwitch) {
  const Vector3d axis = Vector3d(2, -3, 6) / 7.0;
  for (double a = 1e-9; a < 3.14; a *= 1.05) {
    const beam::Logarithm<double> log(exp_so3<double>(a * axis));
    // exp() rounds entries by 2e-16, which the logarithm amplifies by 1/sin(a/2)·a/2 at most (π/2).
    EXPECT_LT((log.psi - a * axis).norm(), 1e-15 * (1.0 + a)) << a;
    const long double half = 0.5L * static_cast<long double>(a);
    EXPECT_LT((log.w - static_cast<double>(std::tan(0.5L * half)) * axis).norm(), 1e-15) << a;
    if (a < 0.05) continue;  // below, the closed form loses digits in long double
    EXPECT_NEAR(log.e, static_cast<double>((1.0L - half / std::tan(half)) / (4.0L * half * half)), 2e-15) << a;
  }
  EXPECT_NEAR(beam::Logarithm<double>(Matrix3d::Identity()).e, 1.0 / 12.0, 1e-17);
}

TEST(BeamElement, SectionWithoutShearAreasIsAnErrorWithRemedy) {
  BeamReference<2> reference;
  reference.position[1] = {1, 0, 0};
  reference.section = {Matrix3d::Identity(), Matrix3d::Identity()};
  reference.length = 1.0;
  formats::Section section = test::rectangle(0.1, 0.1, 1e-5, 0.0);
  section.where = "scene.yaml:7:5";
  try {
    make_beam_element<2>(reference, section, test::material(1, 0.3, 1));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "scene.yaml:7:5");
    EXPECT_NE(error.message().find("shear_area_y = 0"), std::string::npos) << error.what();
    EXPECT_NE(error.remedy().find("shear areas"), std::string::npos) << error.what();
  }
}

TEST(BeamElement, NonPhysicalDataAreErrors) {
  BeamReference<2> reference;
  reference.position[1] = {1, 0, 0};
  reference.section = {Matrix3d::Identity(), Matrix3d::Identity()};
  reference.length = 1.0;
  const formats::Section good = test::rectangle(0.1, 0.1, 1e-5, 0.8);
  formats::Section section = good;
  section.area = -1.0;
  EXPECT_THROW(make_beam_element<2>(reference, section, test::material(1, 0.3, 1)), Error);
  section = good;
  section.torsion_constant = 0.0;
  EXPECT_THROW(make_beam_element<2>(reference, section, test::material(1, 0.3, 1)), Error);
  EXPECT_THROW(make_beam_element<2>(reference, good, test::material(1, 0.3, -1)), Error);
  EXPECT_THROW(make_beam_element<2>(reference, good, test::material(0, 0.3, 1)), Error);
  reference.length = 0.0;
  EXPECT_THROW(make_beam_element<2>(reference, good, test::material(1, 0.3, 1)), Error);
}

}  // namespace
}  // namespace tisserand::mechanism::beam_element_test
