// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas (42) to (54) of docs/THEORY.md, written down once more as they stand there and compared with what the
// program computes of a body with a companion file at a deformed, moving state.
#include <array>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "common/math/dual.hpp"
#include "formats/companion/operations.hpp"
#include "mechanism/bodies/superelement/evaluate.hpp"
#include "tests/support/bodies/second_order_known_answers.hpp"
#include "tests/support/bodies/theory_motion.hpp"
#include "tests/support/bodies/uncondensed_tangent.hpp"

namespace tisserand::mechanism::theory_second_order_test {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::InertiaOption;
using formats::StiffeningOption;
using test_support::relative_difference;
namespace theory = test_support::theory;

constexpr double tolerance = 1e-11;       // as of the known answers: eigenvectors of the rows cost digits
constexpr double of_differences = 1e-10;  // of a difference of larger numbers

template <class S>
using VectorOf = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// η = (v₀, Ω₀), y and ẏ, with derivatives by the time where S is Dual.
template <class S>
struct Arguments {
  Vec3<S> v, Omega;
  VectorOf<S> y, yd;
};

/// What (46) to (50) make of them.
template <class S>
struct Momenta {
  VectorOf<S> xi, p;
  Eigen::Matrix<S, 6, 1> r;
  Vec3<S> sigma, pi_v, pi_O;
  S T;
};

/// The arrays on the coordinates of the body.
struct Arrays {
  theory::Constants part;
  formats::Companion companion;
  MatrixXd J0;

  template <class S>
  S form(const MatrixXd& A, const VectorOf<S>& a, const VectorOf<S>& b) const {
    return (a.transpose() * (A.cast<S>() * b))(0, 0);
  }
  template <class S>
  Mat3<S> pairs(const std::array<MatrixXd, 6>& A, const VectorOf<S>& y, double factor) const {
    Mat3<S> out;
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        out(j, k) = factor * form<S>(A[static_cast<std::size_t>(formats::axis_pair(j, k))], y, y);
    return out;
  }

  template <class S>
  Momenta<S> momenta(const Arguments<S>& at) const {
    Momenta<S> m;
    Vec3<S> nu, sigma_rate, nu_rate, turn;
    for (std::size_t a = 0; a < 3; ++a) {  // (46)
      const auto i = static_cast<Index>(a);
      m.sigma[i] = 0.5 * form<S>(companion.N[a], at.y, at.y);
      nu[i] = 0.5 * form<S>(companion.N[a + 3], at.y, at.y);
      sigma_rate[i] = form<S>(companion.N[a], at.yd, at.y);
      nu_rate[i] = form<S>(companion.N[a + 3], at.yd, at.y);
      turn[i] = form<S>(companion.W[a], at.yd, at.y);
    }
    const Mat3<S> T = pairs<S>(companion.T, at.y, 0.5), J = pairs<S>(companion.E, at.y, 1.0);
    Eigen::Matrix<S, 6, 1> n2, rates;  // (47)
    n2 << sigma_rate + cross<S>(at.Omega, m.sigma), nu_rate + 0.5 * cross<S>(at.Omega, nu) + T * at.Omega + turn;
    rates << at.v, at.Omega;
    const MatrixXd J0_inverse = J0.inverse();
    rates += J0_inverse.cast<S>() * n2;
    m.xi = part.Phi.cast<S>() * rates + at.yd;  // (48)
    m.p = part.M.cast<S>() * m.xi;
    m.T = 0.5 * (m.xi.transpose() * m.p)(0, 0) + 0.5 * dot3<S>(at.Omega, Vec3<S>(J * at.Omega));
    Vec3<S> turned;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Index>(k);
      const VectorOf<S> Cy = companion.C[k].cast<S>() * at.y;
      turned[i] = (m.xi.transpose() * Cy)(0, 0);
      m.p += at.Omega[i] * Cy;
    }
    m.T += dot3<S>(at.Omega, turned);
    const Eigen::Matrix<S, 6, 1> P = part.Phi.transpose().cast<S>() * m.p;
    m.r = J0_inverse.cast<S>() * P;  // (49)
    const Vec3<S> r_v = m.r.template head<3>(), r_O = m.r.template tail<3>();
    m.pi_v = P.template head<3>();  // (50)
    m.pi_O = P.template tail<3>() + turned + J * at.Omega + cross<S>(m.sigma, r_v) + 0.5 * cross<S>(nu, r_O) + T * r_O;
    return m;
  }

  /// (52) without f.
  VectorXd shape_force(const theory::Motion& m, const Momenta<double>& now, const VectorXd& p_rate,
                       const VectorXd& r_rate, const Vector3d& g0) const {
    const Vector3d r_v = now.r.head<3>(), r_O = now.r.tail<3>(), Om = m.Omega0;
    const Vector3d of_v = r_v.cross(Om) + g0, of_O = 0.5 * r_O.cross(Om);
    VectorXd G = p_rate - part.Gamma.transpose() * g0;
    for (Index a = 0; a < 6; ++a) G += r_rate[a] * companion.N[static_cast<std::size_t>(a)] * m.y;
    for (Index i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      G -= Om[i] * companion.C[k].transpose() * now.xi + of_v[i] * companion.N[k] * m.y +
           of_O[i] * companion.N[k + 3] * m.y;
      G += r_rate[3 + i] * companion.W[k] * m.y + 2.0 * r_O[i] * companion.W[k] * m.yd;
      for (Index j = 0; j < 3; ++j) {
        const auto pair = static_cast<std::size_t>(formats::axis_pair(static_cast<int>(j), static_cast<int>(i)));
        G -= Om[j] * Om[i] * companion.E[pair] * m.y + r_O[j] * Om[i] * companion.T[pair] * m.y;
      }
    }
    return G;
  }
};

/// lframe3 of the known answers (three nodes, two modes), with rotary inertia, rows Λ and a load case made up.
class TheorySecondOrder : public ::testing::Test {
 protected:
  void SetUp() override {
    answer_ = test_support::second_order_answer("lframe3");
    const Index n = answer_.element.mass.rows();
    std::mt19937 random(11);
    const auto matrix = [&] {
      MatrixXd A(n, n);
      for (double& a : A.reshaped()) a = std::uniform_real_distribution<double>(-1e-2, 1e-2)(random);
      return A;
    };
    for (MatrixXd& W : answer_.companion.W) {
      const MatrixXd A = matrix();
      W = A - A.transpose();
    }
    for (int b = 0; b < 2; ++b) {
      const MatrixXd A = matrix();
      answer_.companion.Lambda.push_back(A + A.transpose());
    }
    const MatrixXd K = matrix();
    answer_.companion.load_cases = {{"load", matrix().col(0), K + K.transpose()}};
  }

  void take(InertiaOption inertia, StiffeningOption stiffening, double damping = 0.0) {
    SuperelementOptions options;
    options.inertia = inertia;
    options.stiffening = stiffening;
    options.double_curvature = true;
    options.damping.stiffness = damping;
    options.companion = &answer_.companion;
    options.load_cases = {"load"};
    for (std::size_t i = 0; i < answer_.element.node_name.size(); ++i)
      options.position_weights.push_back(
          {answer_.element.node_name[i], answer_.companion.weights[static_cast<Index>(i)]});
    options.rotation_weights = options.position_weights;
    body_ = build_superelement_body(answer_.element, formats::rigid_properties(answer_.element), options);
    state_ = test_support::second_order_state(answer_, body_);
  }

  /// From the file to the coordinates of the body.
  Arrays arrays() const {
    Arrays arrays{theory::Constants(body_), answer_.companion, {}};
    MatrixXd A = MatrixXd::Identity(arrays.part.size, arrays.part.size);
    A.bottomLeftCorner(body_.modes, body_.boundary_size) = body_.file.static_part;
    A.bottomRightCorner(body_.modes, body_.modes) = body_.file.modal_part;
    formats::congruence(arrays.companion, A);
    formats::galilean_step(arrays.companion, arrays.part.M, arrays.part.Phi);
    arrays.J0 = arrays.part.Phi.transpose() * arrays.part.M * arrays.part.Phi;
    return arrays;
  }
  theory::Motion motion(const test_support::BodyState& state) const { return {body_, state, state.nodes[0].R}; }
  test_support::BodyState resting() const {
    test_support::BodyState rest = state_;
    for (NodeMotion& node : rest.nodes) node.xd = node.Omega = node.xdd = node.Omegad = Vector3d::Zero();
    rest.yd.setZero();
    rest.ydd.setZero();
    return rest;
  }
  VectorXd computed(const test_support::BodyState& state, const Vector3d& gravity, double load = 0.0) const {
    SuperelementScratch scratch = make_scratch(body_);
    scratch.forces.loads.factors[0] = load;
    test_support::evaluate(body_, state, gravity, scratch);
    VectorXd r(body_.boundary_size + body_.modes);
    r << scratch.forces.r_B, scratch.forces.r_I;
    return r;
  }
  MatrixXd tangent_of(const test_support::BodyState& state, const TangentCoefficients& c, TangentKind kind) const {
    SuperelementScratch scratch = make_scratch(body_);
    test_support::evaluate(body_, state, Vector3d::Zero(), scratch);
    MatrixXd A;
    test_support::uncondensed_tangent(body_, scratch, test_support::in_order(state.nodes), Vector3d::Zero(), c, kind,
                                      A);
    return A;
  }

  test_support::SecondOrderAnswer answer_;
  SuperelementBody body_;
  test_support::BodyState state_;
};

/// Rows l_a and matrices Γ_a of a body.
struct Rows {
  MatrixXd L;
  std::vector<MatrixXd> Gamma;

  explicit Rows(const Stiffening& stiffening) : L(stiffening.L) {
    const Index n = L.cols();
    Gamma.assign(static_cast<std::size_t>(L.rows()), MatrixXd(n, n));
    FormRows<double> products(L.rows(), n);
    for (Index k = 0; k < n; ++k) {
      apply_forms<double>(stiffening.Gamma, VectorXd(VectorXd::Unit(n, k)), products);
      for (Index a = 0; a < L.rows(); ++a) Gamma[static_cast<std::size_t>(a)].col(k) = products.row(a);
    }
  }
  VectorXd h(Index a, const VectorXd& y) const { return Gamma[static_cast<std::size_t>(a)] * y; }
  double g(Index a, const VectorXd& y) const { return 0.5 * y.dot(h(a, y)); }
  double e(Index a, const VectorXd& y) const { return L.row(a).dot(y) + g(a, y); }

  // (44)
  VectorXd force(const VectorXd& y, const MatrixXd& S) const {
    VectorXd f = S * y;
    for (Index a = 0; a < L.rows(); ++a) f += g(a, y) * L.row(a).transpose() + e(a, y) * h(a, y);
    return f;
  }
  MatrixXd stiffness(const VectorXd& y) const {
    MatrixXd K = MatrixXd::Zero(L.cols(), L.cols());
    for (Index a = 0; a < L.rows(); ++a) {
      const VectorXd bent = L.row(a).transpose() + h(a, y);
      K += bent * bent.transpose() + e(a, y) * Gamma[static_cast<std::size_t>(a)];
    }
    return K;
  }
};

// (43): the rows of S̄, what they make of H, and the energy; rows Λ have no l.
TEST_F(TheorySecondOrder, StrainEnergy) {
  take(InertiaOption::M, StiffeningOption::stress);
  const Rows rows(*body_.second_order.stiffening);
  const Arrays of = arrays();
  EXPECT_LT(relative_difference(rows.L.transpose() * rows.L, of.part.S), 1e-8);
  for (Index j = 0; j < of.part.size; ++j) {
    MatrixXd H = MatrixXd::Zero(of.part.size, of.part.size);
    for (Index a = 0; a < rows.L.rows(); ++a) H += rows.L(a, j) * rows.Gamma[static_cast<std::size_t>(a)];
    EXPECT_LT((H - of.companion.H[static_cast<std::size_t>(j)]).norm(),
              1e-8 * of.companion.H[static_cast<std::size_t>(of.part.size - 1)].norm())
        << j;
  }
  const theory::Motion m = motion(state_);
  double V = 0.0;
  for (Index a = 0; a < rows.L.rows(); ++a) V += 0.5 * rows.e(a, m.y) * rows.e(a, m.y);
  for (const MatrixXd& Lambda : of.companion.Lambda) EXPECT_GT(std::abs(m.y.dot(Lambda * m.y)), 0.0);
  SuperelementScratch scratch = make_scratch(body_);
  test_support::evaluate(body_, state_, Vector3d::Zero(), scratch);
  EXPECT_NEAR(energy(body_, scratch, Vector3d::Zero()).strain, V, 1e-8 * V);
}

// (44), (45), and K_q of (54)
TEST_F(TheorySecondOrder, ElasticForceTangentAndDamping) {
  take(InertiaOption::M, StiffeningOption::stress);
  const Rows rows(*body_.second_order.stiffening);
  const MatrixXd S = theory::Constants(body_).S;
  const theory::Motion m = motion(state_);
  const VectorXd f = rows.force(m.y, S);
  EXPECT_LT(relative_difference(computed(resting(), Vector3d::Zero()), m.Upsilon.transpose() * f), tolerance);
  // Rows of L have round-off where S̄ has none: Cholesky drops what is below 1e-9.
  const MatrixXd K = m.Upsilon.transpose() * rows.stiffness(m.y) * m.Upsilon + theory::frame_stiffness(m, f);
  EXPECT_LT(relative_difference(tangent_of(resting(), {0.0, 0.0, 1.0}, TangentKind::step), K), 1e-8);
  EXPECT_LT(relative_difference(tangent_of(resting(), {0.0, 0.0, 1.0}, TangentKind::exact), K), 1e-8);

  const VectorXd undamped = computed(state_, Vector3d::Zero());
  const double b = 0.03;
  take(InertiaOption::M, StiffeningOption::stress, b);
  VectorXd damped = VectorXd::Zero(m.size);
  for (Index a = 0; a < rows.L.rows(); ++a) {
    const VectorXd bent = rows.L.row(a).transpose() + rows.h(a, m.y);
    damped += b * bent.dot(m.yd) * bent;
  }
  EXPECT_LT(relative_difference(computed(state_, Vector3d::Zero()) - undamped, m.Upsilon.transpose() * damped), 1e-8);
}

// (46) to (53): dual numbers along the motion give the rates of the momenta.
TEST_F(TheorySecondOrder, FullInertia) {
  take(InertiaOption::F, StiffeningOption::full);
  const Arrays of = arrays();
  const theory::Motion m = motion(state_);
  const Vector3d v_rate = m.a0 - m.Omega0.cross(m.v0), gravity(1.0, -2.0, -9.0), g0 = m.R0.transpose() * gravity;
  Arguments<Dual> at{{}, {}, VectorOf<Dual>(m.size), VectorOf<Dual>(m.size)};
  for (int i = 0; i < 3; ++i) {
    at.v[i] = Dual(m.v0[i], v_rate[i]);
    at.Omega[i] = Dual(m.Omega0[i], m.Omega0d[i]);
  }
  for (Index k = 0; k < m.size; ++k) {
    at.y[k] = Dual(m.y[k], m.yd[k]);
    at.yd[k] = Dual(m.yd[k], m.ydd[k]);
  }
  const Momenta<Dual> with_rates = of.momenta(at);
  const auto rate = [](const auto& x) { return x.unaryExpr([](const Dual& d) { return d.derivative; }).eval(); };
  const Momenta<double> now = of.momenta(Arguments<double>{m.v0, m.Omega0, m.y, m.yd});
  const Vector3d pi_v_rate = rate(with_rates.pi_v), pi_O_rate = rate(with_rates.pi_O), Om = m.Omega0;
  const double mass = of.part.mass;
  const Vector3d s = mass * of.part.center + of.part.Gamma * m.y + now.sigma;
  const Vector3d G_x = pi_v_rate + Om.cross(now.pi_v) - mass * g0;  // (51)
  const Vector3d G_Theta = pi_O_rate + Om.cross(now.pi_O) + m.v0.cross(now.pi_v) - s.cross(g0);
  const VectorXd G_y = of.shape_force(m, now, rate(with_rates.p), rate(with_rates.r), g0) +
                       Rows(*body_.second_order.stiffening).force(m.y, of.part.S);
  const VectorXd r = m.A0.transpose() * G_x + m.U.transpose() * G_Theta + m.Upsilon.transpose() * G_y;  // (53)
  EXPECT_LT(relative_difference(computed(state_, gravity), r), 1e-9);
  SuperelementScratch scratch = make_scratch(body_);
  test_support::evaluate(body_, state_, gravity, scratch);
  EXPECT_NEAR(energy(body_, scratch, gravity).kinetic, now.T, tolerance * now.T);
  EXPECT_LT((scratch.forces.inertia.pi_v - now.pi_v).norm(), tolerance * now.pi_v.norm());
  EXPECT_LT((scratch.forces.inertia.pi_O - now.pi_O).norm(), tolerance * now.pi_O.norm());
}

// M_q of (54): T is quadratic in (η, ẏ), so that differences of its values give the second derivatives.
TEST_F(TheorySecondOrder, StepTangentOfMass) {
  take(InertiaOption::F, StiffeningOption::full);
  const Arrays of = arrays();
  const theory::Motion m = motion(state_);
  const Index n = 6 + m.size;
  const auto T = [&](const VectorXd& rates) {
    return of.momenta(Arguments<double>{rates.head<3>(), rates.segment<3>(3), m.y, rates.tail(m.size)}).T;
  };
  MatrixXd H(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const VectorXd a = VectorXd::Unit(n, i), b = VectorXd::Unit(n, j);
      H(i, j) = T(a + b) - T(a) - T(b);
    }
  MatrixXd Z(n, m.size);
  Z << m.A0, m.U, m.Upsilon;
  EXPECT_LT(relative_difference(tangent_of(state_, {1.0, 0.0, 0.0}, TangentKind::step), Z.transpose() * H * Z),
            of_differences);
}

// (42), with and without stiffening
TEST_F(TheorySecondOrder, LoadCase) {
  for (const StiffeningOption stiffening : {StiffeningOption::stress, StiffeningOption::full}) {
    take(stiffening == StiffeningOption::full ? InertiaOption::F : InertiaOption::M, stiffening);
    const Arrays of = arrays();
    const theory::Motion m = motion(state_);
    const formats::LoadCase& load = of.companion.load_cases[0];
    MatrixXd whole = load.stiffness;  // with the answer of the kept modes
    for (Index k = 0; k < body_.modes; ++k) {
      const Index row = body_.boundary_size + k;
      whole -= load.force[row] / body_.S_II[k] * of.companion.H[static_cast<std::size_t>(row)];
    }
    MatrixXd mu_y = of.part.Phi.rightCols<3>().transpose() * whole;
    for (Index i = 0; i < m.nodes; ++i) {
      mu_y.middleCols<3>(6 * i) -= theory::skew(load.force.segment<3>(6 * i));
      mu_y.middleCols<3>(6 * i + 3) -= 0.5 * theory::skew(load.force.segment<3>(6 * i + 3));
    }
    const Vector3d F = of.part.Phi.leftCols<3>().transpose() * load.force;
    const Vector3d mu = of.part.Phi.rightCols<3>().transpose() * load.force + mu_y * m.y;
    const double factor = 1.7;
    const VectorXd force = factor * (m.A0.transpose() * F + m.U.transpose() * mu +
                                     m.Upsilon.transpose() * (load.force + load.stiffness * m.y));
    EXPECT_LT(relative_difference(computed(resting(), Vector3d::Zero()) - computed(resting(), Vector3d::Zero(), factor),
                                  force),
              1e-8);  // loads are small beside elastic forces
  }
}

}  // namespace
}  // namespace tisserand::mechanism::theory_second_order_test
