// SPDX-License-Identifier: GPL-3.0-or-later
// Exact hand-written tangents of beam elements (first derivatives of the forces in bodies/beam/kernels.hpp).
#include "mechanism/bodies/beam/kernels.hpp"

namespace tisserand::mechanism {
namespace {

using beam::Logarithm;
using Eigen::Matrix3d;
using Eigen::Vector3d;
template <int N>
using Square = Eigen::Matrix<double, 6 * N, 6 * N>;

/// Derivatives of t = tan(a/4)/a and e by u = a²: ∇t = t1 ψ, ∇e = e1 ψ. Series below a² = 0.25 (nine terms).
struct LogarithmDerivatives {
  double t, t1, e1;

  explicit LogarithmDerivatives(const Logarithm<double>& log) {
    if (log.u < beam::series_limit) {
      t = beam::polynomial(t_series, log.u);
      t1 = 2.0 * beam::polynomial(derivative(t_series), log.u);
      e1 = 2.0 * beam::polynomial(derivative(beam::e_series), log.u);
    } else {
      const double w2 = log.w.squaredNorm();
      t = std::sqrt(w2 / log.u);
      t1 = (0.25 * (1.0 + w2) - t) / log.u;
      const double cotangent = 1.0 - log.e * log.u;          // (a/2) cot(a/2)
      const double sine = 2.0 * std::sqrt(w2) / (1.0 + w2);  // sin(a/2)
      const double cosecant = 0.25 * log.u / (sine * sine);  // (a/2)²/sin²(a/2)
      e1 = ((cosecant - cotangent) / log.u - 2.0 * log.e) / log.u;
    }
  }

 private:
  /// Series tan(a/4)/a = ¼ Σ τ_k (u/16)^k with tan x = Σ τ_k x^(2k+1).
  static constexpr std::array<double, 9> t_series = [] {
    constexpr std::array<double, 9> tau = {1.0,
                                           1.0 / 3,
                                           2.0 / 15,
                                           17.0 / 315,
                                           62.0 / 2835,
                                           1382.0 / 155925,
                                           21844.0 / 6081075,
                                           929569.0 / 638512875,
                                           6404582.0 / 10854718875};
    std::array<double, 9> a{};
    double factor = 0.25;
    for (std::size_t k = 0; k < 9; ++k, factor /= 16.0) a[k] = factor * tau[k];
    return a;
  }();
  template <std::size_t K>
  static constexpr std::array<double, K - 1> derivative(const std::array<double, K>& a) {
    std::array<double, K - 1> b{};
    for (std::size_t k = 1; k < K; ++k) b[k - 1] = static_cast<double>(k) * a[k];
    return b;
  }
};

/// Matrix T⁻¹(ψ) = 1 + ψ~/2 + e ψ~².
Matrix3d inverse_tangent(const Logarithm<double>& log) {
  const Matrix3d P = skew(log.psi);
  return Matrix3d::Identity() + 0.5 * P + log.e * (P * P);
}

/// Derivative ∂(T⁻¹(ψ) m)/∂ψ = −m~/2 − e [(ψ×m)~ + ψ~ m~] + e1 (ψ×(ψ×m)) ψᵀ.
Matrix3d inverse_tangent_derivative(const Vector3d& psi, double e, double e1, const Vector3d& m) {
  const Vector3d b = psi.cross(m);
  Matrix3d Z = skew(Vector3d(-0.5 * m - e * b));
  Z.noalias() -= e * (m * psi.transpose());  // ψ~ m~ = m ψᵀ − (ψ·m) 1
  Z.diagonal().array() += e * psi.dot(m);
  Z.noalias() += (e1 * psi.cross(b)) * psi.transpose();
  return Z;
}

/// Sets A = c_m M + c_c (Ω~ J − (JΩ)~) on the diagonal blocks of rotations, and all other entries to zero.
template <int N>
void set_inertia(const BeamElement<N>& e, std::span<const NodeMotion> nodes, const TangentCoefficients& c,
                 Square<N>& A) {
  A.setZero();
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j)
      for (int k = 0; k < 3; ++k) A(6 * i + k, 6 * j + k) = c.mass * e.mass * beam::Shares<N>::mass[i][j];
    if (!e.rotary) continue;
    const Matrix3d& J = e.inertia[i];
    const Vector3d& Omega = nodes[e.nodes[i]].Omega;
    const Vector3d spin = J * Omega;
    A.template block<3, 3>(6 * i + 3, 6 * i + 3) = c.mass * J + c.damping * (skew(Omega) * J - skew(spin));
  }
}

/// Sum of the derivatives of b̈ by c, ċ and c̈ of a bow, weighted with the coefficients of their changes.
Matrix3d by_chord(const beam::Bow<double>& b, const TangentCoefficients& c) {
  const Vector3d on_c = c.stiffness * b.d_acceleration + 2.0 * c.damping * b.d_rate + c.mass * b.d;
  const Vector3d on_d = c.stiffness * b.c_acceleration + 2.0 * c.damping * b.c_rate + c.mass * b.c;
  Matrix3d D = -b.k * (b.c * on_c.transpose());
  D.noalias() -= b.k * (c.stiffness * b.c_acceleration + 2.0 * c.damping * b.c_rate) * b.d.transpose();
  D.noalias() -= (2.0 * c.stiffness * b.k) * b.c_rate * b.d_rate.transpose();
  D.diagonal().array() -= b.k * (b.c.dot(c.stiffness * b.d_acceleration + 2.0 * c.damping * b.d_rate) + b.d.dot(on_d) +
                                 2.0 * c.stiffness * b.d_rate.dot(b.c_rate));
  return D;
}

/// Product B X, column by column.
template <class Columns>
Columns on_d(const beam::Bow<double>& b, const Columns& X) {
  return X - (b.k * b.c) * (b.c.transpose() * X);
}

/// Adds the contribution of the parabola of two nodes to A. A motion of node i, weighted with the coefficients, changes
/// d by c_k D_i, D_i = −s_i R_i a~, ḋ by −s_i R_i [c_c a~ + c_k (Ω×a)~], d̈ by −s_i R_i [c_m a~ + c_c
/// ((Ω×a)~ + Ω~ a~) + c_k (Ω̇×a + Ω×(Ω×a))~], s_i = ±L/2, and c, ċ, c̈ by ∓c_k, ∓c_c, ∓c_m.
void add_parabola(const BeamElement2& e, const beam::NodePointers<NodeMotion, 2>& node, const Vector3d& gravity,
                  const TangentCoefficients& c, Square<2>& A) {
  using beam::Parabola;
  using Wide = Eigen::Matrix<double, 3, 12>;
  const beam::Bow<double> bow(e, node);
  const Vector3d f = beam::force_on_bow<double>(e, node, gravity, bow.acceleration()), f_d = bow.on_d(f);
  const double cf = bow.c.dot(f), cd = bow.c.dot(bow.d);
  // Changes of b̈ and of the forces on d and c that f itself causes.
  Wide acceleration, at_d, at_chord;
  std::array<Matrix3d, 2> arm;  // s_i a_i~ R_iᵀ, for forces on d
  Matrix3d d_by_c = (-c.stiffness * bow.k) * bow.c * f.transpose();
  d_by_c.diagonal().array() -= c.stiffness * bow.k * cf;
  const Matrix3d c_by_c = (-c.stiffness * bow.k) * (bow.d * f.transpose() + f * bow.d.transpose());
  const Matrix3d chord = by_chord(bow, c);
  for (int i = 0; i < 2; ++i) {
    const Vector3d a = Parabola::sign[i] * e.length * beam::along(e, i);
    const Vector3d& Omega = node[i]->Omega;
    const Matrix3d skew_a = skew(a);
    const Vector3d rate = Omega.cross(a), turned = node[i]->Omegad.cross(a) + Omega.cross(rate);
    Matrix3d change = c.mass * skew_a + skew(Vector3d(c.damping * rate + c.stiffness * turned));
    change.noalias() += c.damping * (skew(Omega) * skew_a);
    arm[i].noalias() = skew_a * node[i]->R.transpose();
    const Matrix3d D = c.stiffness * arm[i].transpose();  // −R a~ = (a~ Rᵀ)ᵀ
    const Matrix3d D_rate = c.damping * arm[i].transpose() - c.stiffness * (node[i]->R * skew(rate));
    const double end = i == 0 ? -1.0 : 1.0;
    acceleration.block<3, 3>(0, 6 * i) = end * chord;
    Matrix3d turn = on_d(bow, Matrix3d(-(node[i]->R * change)));
    turn.noalias() -= (2.0 * bow.k * bow.c_rate) * (bow.c.transpose() * D_rate);
    turn.noalias() -= (bow.k * bow.c) * (bow.c_acceleration.transpose() * D + 2.0 * (bow.c_rate.transpose() * D_rate));
    turn.noalias() -= (bow.k * bow.c_acceleration) * (bow.c.transpose() * D);
    turn.noalias() -= (2.0 * bow.k * bow.c_rate) * (bow.c_rate.transpose() * D);
    acceleration.block<3, 3>(0, 6 * i + 3) = turn;
    at_d.block<3, 3>(0, 6 * i) = end * d_by_c;
    at_d.block<3, 3>(0, 6 * i + 3).setZero();
    at_chord.block<3, 3>(0, 6 * i) = end * c_by_c;
    at_chord.block<3, 3>(0, 6 * i + 3) = (-bow.k * cf) * D - (bow.k * f) * (bow.c.transpose() * D);
    A.block<3, 3>(6 * i + 3, 6 * i + 3) += c.stiffness * (skew_a * skew(Vector3d(node[i]->R.transpose() * f_d)));
  }
  Wide force = e.mass * Parabola::by_itself * acceleration;
  for (int i = 0; i < 2; ++i) force.block<3, 3>(0, 6 * i).diagonal().array() += c.mass * e.mass * Parabola::by_node;
  const Eigen::Matrix<double, 1, 12> along_chord = bow.c.transpose() * force;
  at_d += force;
  at_d.noalias() -= (bow.k * bow.c) * along_chord;
  at_chord -= (bow.k * cd) * force;
  at_chord.noalias() -= (bow.k * bow.d) * along_chord;
  acceleration *= e.mass * Parabola::by_node;
  A.middleRows<3>(0) += acceleration - at_chord;
  A.middleRows<3>(6) += acceleration + at_chord;
  for (int i = 0; i < 2; ++i) A.middleRows<3>(6 * i + 3).noalias() += arm[i] * at_d;
}

/// Derivative ∂(A(ψ) v)/∂ψ of chord_to_arc.
Matrix3d chord_gradient(const Vector3d& psi, const Vector3d& v) {
  Matrix3d B = (2.0 * v * psi.transpose() - psi * v.transpose()) / 24.0;
  B.diagonal().array() -= psi.dot(v) / 24.0;
  return B;
}

/// Second derivatives of the strain energy by g and ψ, times c: by_g = c A D A, mixed = c ∂(on_g)/∂ψ,
/// by_psi = c ∂(on_psi)/∂ψ. D is that of W/L by Γ: E A J Jᵀ + N e'' + C of the shear strains, J = ∂ε/∂Γ. ε also depends
/// on κ₁: E A (ρ² κ₁) of J and κ₁, N ρ² + E A (ρ² κ₁)² of κ₁ twice.
struct Stiffness2 {
  Matrix3d by_g, mixed, by_psi;

  Stiffness2(const BeamElement2& e, const beam::State2<double>& state, double c) {
    const Vector3d &psi = state.log.psi, &g = state.g, &n = state.force;
    Matrix3d A = psi * psi.transpose() / -24.0;
    A.diagonal().array() += 1.0 + state.log.u / 24.0;
    const Matrix3d B = chord_gradient(psi, g);
    const Vector3d J = Vector3d::UnitX() + state.bent.gradient;
    const double axial = c * e.force_stiffness[0], twist = e.polar_radius_squared * state.kappa[0];
    Matrix3d D = (axial * J) * J.transpose() + (c * state.normal) * state.bent.hessian();
    D.diagonal().tail<2>() += c * e.force_stiffness.tail<2>();
    const Matrix3d DA = D * A, DB = D * B;
    by_g.noalias() = A * DA;
    mixed = c * chord_gradient(psi, n);
    mixed.noalias() += A * DB;
    mixed.col(0) += (axial * twist / e.length) * (A * J);
    by_psi = (c * e.length / -24.0) * (n * g.transpose() + g * n.transpose());
    by_psi.noalias() += e.length * (B.transpose() * DB);
    const Vector3d with_twist = (axial * twist) * (B.transpose() * J);
    by_psi.col(0) += with_twist;
    by_psi.row(0) += with_twist.transpose();
    by_psi(0, 0) += (c * e.polar_radius_squared * state.normal + axial * twist * twist) / e.length;
    by_psi.diagonal() += c / e.length * e.moment_stiffness;
    by_psi.diagonal().array() += c * e.length / 12.0 * n.dot(g);
  }
};

/// Adds c ∂G_int/∂q of two nodes to A. P_i = ∂θ_m/∂Θ_i, G_i = ∂ψ/∂Θ_i. N and M are the forces on δg and δψ, N_g, N_ψ,
/// M_ψ their derivatives, and H = N~ − g~ N_g. K_θθ = P_iᵀ L H g~ P_j + Y_i G_j − L P_iᵀ g~ N_ψ G_j + its transpose (i,
/// j exchanged), K_θx = (P_iᵀ H + G_iᵀ N_ψᵀ) Λᵀ = K_xθᵀ, K_xx = Λ N_g Λᵀ/L.
void add_stiffness(const BeamElement2& e, const beam::State2<double>& state, double c, Square<2>& A) {
  const LogarithmDerivatives f(state.log);
  const Vector3d &psi = state.log.psi, &w = state.log.w;
  const Stiffness2 second(e, state, c);
  const Vector3d h = e.length * state.on_g.cross(state.g);
  const Matrix3d skew_g = skew(state.g), skew_psi = skew(psi);
  const Matrix3d H = c * skew(state.on_g) - skew_g * second.by_g;
  const Matrix3d Jh = e.length * (H * skew_g), across = -e.length * (skew_g * second.mixed);

  // Derivatives by ψ of the half sum and the half difference of the end moments.
  const Matrix3d mean = 0.5 * (c * skew(state.on_psi) - skew_psi * second.by_psi);
  const Vector3d b = psi.cross(state.on_psi);
  Matrix3d even = skew(Vector3d(c * (0.5 * f.t * h - state.log.e * b)));
  even.noalias() -= (c * state.log.e) * (state.on_psi * psi.transpose());
  even.diagonal().array() += c * state.log.e * psi.dot(state.on_psi);
  even.noalias() += (c * (0.5 * f.t1 * h.cross(psi) + f.e1 * psi.cross(b))) * psi.transpose();
  Matrix3d E = state.log.e * (skew_psi * skew_psi);
  E.diagonal().array() += 1.0;
  even.noalias() += E * second.by_psi;

  const Matrix3d &D1 = e.section[0], &D2 = e.section[1];
  const Matrix3d G = E + 0.5 * skew_psi;
  const Matrix3d half = 0.5 * (Matrix3d::Identity() + skew(w));
  const std::array<Matrix3d, 2> P = {half.transpose() * D1.transpose(), half * D2.transpose()};
  const std::array<Matrix3d, 2> Gn = {-(G.transpose() * D1.transpose()), G * D2.transpose()};
  const std::array<Matrix3d, 2> Y = {D1 * (mean - even), D2 * (mean + even)};
  const Matrix3d HL = H * state.axes.transpose(), XL = second.mixed.transpose() * state.axes.transpose();
  const Matrix3d K = state.axes * second.by_g * state.axes.transpose() / e.length;
  for (int i = 0; i < 2; ++i) {
    const Matrix3d PJ = P[i].transpose() * Jh + Gn[i].transpose() * across.transpose();
    const Matrix3d YG = Y[i] + P[i].transpose() * across;
    const Matrix3d Kx = P[i].transpose() * HL + Gn[i].transpose() * XL;
    for (int j = 0; j < 2; ++j) {
      const double sign = j == 0 ? -1.0 : 1.0;
      A.block<3, 3>(6 * i + 3, 6 * j + 3) += PJ * P[j] + YG * Gn[j];
      A.block<3, 3>(6 * i + 3, 6 * j) += sign * Kx;
      A.block<3, 3>(6 * j, 6 * i + 3) += sign * Kx.transpose();
      A.block<3, 3>(6 * i, 6 * j) += (i == j ? 1.0 : -1.0) * K;
    }
  }
}

using Matrix39 = Eigen::Matrix<double, 3, 9>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// Derivative ∂(T(φ) a)/∂φ = c a~ − c1 (φ×a) φᵀ − d [(φ×a)~ + φ~ a~] + d1 (φ×(φ×a)) φᵀ.
Matrix3d tangent_derivative(const Vector3d& phi, const beam::CurvatureFunctions<double>& f, const Vector3d& a) {
  const Vector3d b = phi.cross(a);
  Matrix3d X = skew(Vector3d(f.c * a - f.d * b));
  X.noalias() -= f.d * (a * phi.transpose());
  X.diagonal().array() += f.d * phi.dot(a);
  X.noalias() += (f.d1 * phi.cross(b) - f.c1 * b) * phi.transpose();
  return X;
}

/// Second derivative ∂²(m · T(φ) a)/∂φ², symmetric (notation of tangent_gradient).
Matrix3d tangent_hessian(const beam::Point3<double>& p) {
  const Vector3d &phi = p.phi, &a = p.a, &m = p.moment;
  const Vector3d k = a.cross(m);
  const double am = a.dot(m), pa = phi.dot(a), pm = phi.dot(m), A = phi.dot(k), B = pa * pm - p.u * am;
  const Vector3d b = a * pm + m * pa - 2.0 * am * phi;
  const Vector3d v = p.f.d1 * b - p.f.c1 * k + 0.5 * (p.f.d2(p.u) * B - p.f.c2(p.u) * A) * phi;
  Matrix3d half = v * phi.transpose() + p.f.d * (a * m.transpose());
  Matrix3d X = half + half.transpose();
  X.diagonal().array() += p.f.d1 * B - p.f.c1 * A - 2.0 * p.f.d * am;
  return X;
}

/// Adds the contribution of one quadrature point, scaled by c: K by (Φ₁, Φ₃, θ₂), and Kx, their forces by (x₁, x₂, x₃).
/// The variations are δφ, δa, δθ₂ with δθ = T δφ + exp(−φ) δθ₂, δκ = T δa + Ξ δφ, δφ = Σ n_i δΦ_i, δa = Σ n_i' δΦ_i.
void add_point(const BeamElement3& e, const beam::Point3<double>& p, int point, double c, Matrix9& K, Matrix9& Kx,
               Square<3>& A) {
  const double weight = 0.5 * c * e.length;
  const std::array<double, 2> n = {beam::shape[point][0], beam::shape[point][2]};
  const std::array<double, 2> dn = {beam::slope[point][0] / e.length, beam::slope[point][2] / e.length};
  const Matrix3d skew_phi = skew(p.phi), skew_g = skew(p.g);
  const Matrix3d T = Matrix3d::Identity() - p.f.c * skew_phi + p.f.d * (skew_phi * skew_phi);
  const Matrix3d Xi = tangent_derivative(p.phi, p.f, p.a);
  const Vector3d h = weight * p.force.cross(p.g), m = weight * p.moment;
  const Matrix3d H = weight * (skew(p.force) - skew_g * e.force_stiffness.asDiagonal());
  const double twist = e.polar_radius_squared * p.kappa[0], axial = weight * e.force_stiffness[0];
  Vector3d by_kappa = weight * e.moment_stiffness;
  by_kappa[0] += weight * e.polar_radius_squared * p.force[0] + axial * twist * twist;
  const Matrix3d J = H * skew_g, JT = J * T, JE = J * p.turn.transpose();
  const Matrix3d CT = by_kappa.asDiagonal() * T, CX = by_kappa.asDiagonal() * Xi;
  // ε depends on κ₁: E A (ρ² κ₁) of δΓ₁ = g~₁ᵀ δθ + (Λᵀ δx')₁ and δκ₁, in both orders.
  const Vector3d turned = (axial * twist) * skew_g.row(0).transpose();
  const Vector3d by_phi_1 = T.transpose() * turned;
  const Vector3d kappa_by_phi = Xi.row(0).transpose(), kappa_by_a = T.row(0).transpose();
  Matrix3d by_phi =
      T.transpose() * JT + Xi.transpose() * CX - tangent_derivative(-p.phi, p.f, h) + weight * tangent_hessian(p);
  by_phi += by_phi_1 * kappa_by_phi.transpose() + kappa_by_phi * by_phi_1.transpose();
  Matrix3d mixed = Xi.transpose() * CT - tangent_derivative(-p.phi, p.f, m).transpose();
  mixed += by_phi_1 * kappa_by_a.transpose();
  const Matrix3d by_a = T.transpose() * CT;
  const Vector3d direct = p.turn * turned;
  const Matrix3d down = p.turn * (JT - skew(h) * T) + direct * kappa_by_phi.transpose();
  const Matrix3d down_a = direct * kappa_by_a.transpose();
  const Matrix3d across = T.transpose() * JE + kappa_by_phi * direct.transpose();
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j)
      K.block<3, 3>(3 * i, 3 * j) +=
          n[i] * n[j] * by_phi + n[i] * dn[j] * mixed + dn[i] * n[j] * mixed.transpose() + dn[i] * dn[j] * by_a;
    K.block<3, 3>(6, 3 * i) += n[i] * down + dn[i] * down_a;
    K.block<3, 3>(3 * i, 6) += n[i] * across + dn[i] * down_a.transpose();
  }
  K.block<3, 3>(6, 6) += p.turn * JE;
  const Matrix3d HL = H * p.axes.transpose(), EHL = p.turn * HL;
  const Eigen::RowVector3d normal = (axial * twist) * p.axes.col(0).transpose();
  const Matrix3d THL = T.transpose() * HL + kappa_by_phi * normal, by_a_x = kappa_by_a * normal;
  const Matrix3d C = p.axes * (weight * e.force_stiffness).asDiagonal() * p.axes.transpose();
  for (int i = 0; i < 3; ++i) {
    const double di = beam::slope[point][i] / e.length;
    for (int k = 0; k < 2; ++k) Kx.block<3, 3>(3 * k, 3 * i) += di * (n[k] * THL + dn[k] * by_a_x);
    Kx.block<3, 3>(6, 3 * i) += di * EHL;
    for (int j = 0; j < 3; ++j) A.block<3, 3>(6 * i, 6 * j) += di * beam::slope[point][j] / e.length * C;
  }
}

/// Adds c ∂G_int/∂q of three nodes to A. V = ∂(Φ₁, Φ₃, θ₂)/∂(Θ₁, Θ₂, Θ₃) transforms K by (Φ₁, Φ₃, θ₂) to the nodes. The
/// change of V at constant forces P is added.
void add_stiffness(const BeamElement3& e, const beam::State3<double>& state, const beam::Moments3<double>& P, double c,
                   Square<3>& A) {
  Matrix9 K = Matrix9::Zero(), Kx = Matrix9::Zero();
  for (int k = 0; k < 2; ++k) add_point(e, state.point[k], k, c, K, Kx, A);
  const std::array<const Logarithm<double>*, 2> logs = {&state.log1, &state.log3};
  const std::array<Vector3d, 2> force = {c * P.on1, c * P.on3};
  const std::array<int, 2> end = {0, 2};
  const Matrix3d& D2 = e.section[1];
  std::array<Matrix3d, 2> outer, inner;  // V by the rotation of the end node and of the middle node
  for (int i = 0; i < 2; ++i) {
    const Matrix3d G = inverse_tangent(*logs[i]);
    outer[i] = G * e.section[end[i]].transpose();
    inner[i] = -(G.transpose() * D2.transpose());
  }
  Matrix9 KV;
  for (int i = 0; i < 2; ++i) KV.middleCols<3>(3 * end[i]) = K.middleCols<3>(3 * i).lazyProduct(outer[i]);
  KV.middleCols<3>(3) = K.middleCols<3>(0).lazyProduct(inner[0]) + K.middleCols<3>(3).lazyProduct(inner[1]) +
                        K.middleCols<3>(6).lazyProduct(D2.transpose());
  Matrix39 middle = D2.lazyProduct(KV.bottomRows<3>()), middle_x = D2.lazyProduct(Kx.bottomRows<3>());
  for (int i = 0; i < 2; ++i) {
    const LogarithmDerivatives f(*logs[i]);
    const Vector3d& Phi = logs[i]->psi;
    const Matrix3d plus = inverse_tangent_derivative(Phi, logs[i]->e, f.e1, force[i]);
    const Matrix3d minus = inverse_tangent_derivative(-Phi, logs[i]->e, f.e1, force[i]);
    const Matrix3d Dm = e.section[end[i]] * minus, Dp = D2 * plus;
    Matrix39 row = outer[i].transpose().lazyProduct(KV.middleRows<3>(3 * i));
    row.middleCols<3>(3 * end[i]) -= Dm * outer[i];
    row.middleCols<3>(3) -= Dm * inner[i];
    middle += inner[i].transpose().lazyProduct(KV.middleRows<3>(3 * i));
    middle.middleCols<3>(3 * end[i]) -= Dp * outer[i];
    middle.middleCols<3>(3) -= Dp * inner[i];
    middle_x += inner[i].transpose().lazyProduct(Kx.middleRows<3>(3 * i));
    const Matrix39 row_x = outer[i].transpose().lazyProduct(Kx.middleRows<3>(3 * i));
    for (int j = 0; j < 3; ++j) {
      A.block<3, 3>(6 * end[i] + 3, 6 * j + 3) += row.middleCols<3>(3 * j);
      A.block<3, 3>(6 * end[i] + 3, 6 * j) = row_x.middleCols<3>(3 * j);
      A.block<3, 3>(6 * j, 6 * end[i] + 3) = row_x.middleCols<3>(3 * j).transpose();
    }
  }
  for (int j = 0; j < 3; ++j) {
    A.block<3, 3>(9, 6 * j + 3) += middle.middleCols<3>(3 * j);
    A.block<3, 3>(9, 6 * j) = middle_x.middleCols<3>(3 * j);
    A.block<3, 3>(6 * j, 9) = middle_x.middleCols<3>(3 * j).transpose();
  }
}

template <int N>
beam::Configuration<double, N> gather(const BeamElement<N>& element, std::span<const NodeMotion> nodes,
                                      beam::NodePointers<NodeMotion, N>& motion) {
  beam::Configuration<double, N> q;
  for (int i = 0; i < N; ++i) {
    motion[i] = &nodes[element.nodes[i]];
    q.x[i] = motion[i]->x;
    q.R[i] = motion[i]->R;
  }
  return q;
}

}  // namespace

void residual_and_tangent(const BeamElement2& element, std::span<const NodeMotion> nodes,
                          const Eigen::Vector3d& gravity, const TangentCoefficients& coefficients,
                          Eigen::Matrix<double, 12, 1>& r, Eigen::Matrix<double, 12, 12>& A) {
  beam::NodePointers<NodeMotion, 2> motion;
  const beam::State2<double> state(element, gather(element, nodes, motion));
  beam::internal_force(element, state, r);
  beam::add_inertia(element, motion, gravity, r);
  set_inertia(element, nodes, coefficients, A);
  add_parabola(element, motion, gravity, coefficients, A);
  add_stiffness(element, state, coefficients.stiffness, A);
}

void residual_and_tangent(const BeamElement3& element, std::span<const NodeMotion> nodes,
                          const Eigen::Vector3d& gravity, const TangentCoefficients& coefficients,
                          Eigen::Matrix<double, 18, 1>& r, Eigen::Matrix<double, 18, 18>& A) {
  beam::NodePointers<NodeMotion, 3> motion;
  const beam::State3<double> state(element, gather(element, nodes, motion));
  const beam::Moments3<double> P = beam::internal_force(element, state, r);
  beam::add_inertia(element, motion, gravity, r);
  set_inertia(element, nodes, coefficients, A);
  add_stiffness(element, state, P, coefficients.stiffness, A);
}

}  // namespace tisserand::mechanism
