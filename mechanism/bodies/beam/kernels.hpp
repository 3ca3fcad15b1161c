// SPDX-License-Identifier: GPL-3.0-or-later
// Strains, energy and forces of beam elements for any scalar (double, Dual, complex); bodies/beam/element.cpp
// instantiates them.
#pragma once

#include <array>

#include "common/math/rotation.hpp"
#include "mechanism/bodies/beam/element.hpp"
#include "mechanism/bodies/beam/resultants.hpp"
#include "mechanism/bodies/beam/rotation.hpp"

namespace tisserand::mechanism::beam {

/// Positions and orientations (world axes) of the N nodes of one beam element.
template <class S, int N>
struct Configuration {
  std::array<Vec3<S>, N> x;
  std::array<Mat3<S>, N> R;
};

/// Abscissa 1/√3 of the two Gauss points s = −1/√3, 1/√3 of the three-node element. Each has the weight L/2.
inline constexpr double gauss = 0.57735026918962576451;
/// Shape functions at the Gauss points (point x node): N₁ = s(s−1)/2, N₂ = 1 − s², N₃ = s(s+1)/2.
inline constexpr std::array<std::array<double, 3>, 2> shape = {
    {{0.5 * gauss * (gauss + 1), 2.0 / 3, 0.5 * gauss*(gauss - 1)},
     {0.5 * gauss * (gauss - 1), 2.0 / 3, 0.5 * gauss*(gauss + 1)}}};
/// Derivatives of the shape functions by arc length S, times L, at the Gauss points (point x node): d/dS = (2/L) d/ds.
inline constexpr std::array<std::array<double, 3>, 2> slope = {
    {{-2 * gauss - 1, 4 * gauss, 1 - 2 * gauss}, {2 * gauss - 1, -4 * gauss, 1 + 2 * gauss}}};

/// Product A(ψ) v = v − ψ×(ψ×v)/24 of a two-node element, from its chord to its arc, with `u` = ψ·ψ. Arc over chord is
/// (a/2)/sin(a/2) = 1 + a²/24 + O(a⁴) across ψ, a = |ψ|, and 1 along ψ.
template <class S>
inline Vec3<S> chord_to_arc(const Vec3<S>& psi, const S& u, const Vec3<S>& v) {
  return v + (v * u - psi * dot3(psi, v)) * S(1.0 / 24);
}
/// Product (∂(A v)/∂ψ)ᵀ n with the matrix A(ψ) of chord_to_arc().
template <class S>
inline Vec3<S> chord_gradient_transposed(const Vec3<S>& psi, const Vec3<S>& v, const Vec3<S>& n) {
  return (psi * (2.0 * dot3(v, n)) - n * dot3(psi, v) - v * dot3(psi, n)) * S(1.0 / 24);
}

/// State of a two-node element at its middle: section triad Λ (`axes`), g = Λᵀx', strains Γ and κ, and resultants.
/// `on_g` is ∂W/∂g over L and `on_psi` is ∂W/∂ψ, with the strain energy W and the relative rotation vector ψ. on_g = A
/// force, A of chord_to_arc(), and on_psi = moment + L (∂(A g)/∂ψ)ᵀ force.
template <class S>
struct State2 {
  Logarithm<S> log;
  Mat3<S> axes;
  Vec3<S> g, gamma, kappa, force, moment, on_g, on_psi;
  S energy, normal;  ///< strain energy per length W/L; normal force N
  BentLength<S> bent;

  State2(const BeamElement2& e, const Configuration<S, 2>& q)
      : State2(e, q, q.R[0] * e.section[0].template cast<S>()) {}

 private:
  State2(const BeamElement2& e, const Configuration<S, 2>& q, const Mat3<S>& first)
      : log(first.transpose() * (q.R[1] * e.section[1].template cast<S>())) {
    const Mat3<S> W = skew(log.w);
    const S factor = 2.0 / (1.0 + dot3(log.w, log.w));
    axes = first + (first * (W + W * W)) * factor;
    g = axes.transpose() * (q.x[1] - q.x[0]) * S(1.0 / e.length);
    gamma = chord_to_arc(log.psi, log.u, g) - e.initial_gamma[0].template cast<S>();
    kappa = log.psi * S(1.0 / e.length) - e.initial_kappa[0].template cast<S>();
    bent = BentLength<S>(e, gamma);
    const Resultants<S> of(e, gamma, kappa, gamma[0] + bent.value, Vec3<S>::UnitX() + bent.gradient);
    force = of.force;
    moment = of.moment;
    energy = of.energy;
    normal = of.normal;
    on_g = chord_to_arc(log.psi, log.u, force);
    on_psi = moment + chord_gradient_transposed(log.psi, g, force) * S(e.length);
  }
};

/// State at one quadrature point of a three-node element: rotation vector φ = N₁Φ₁ + N₃Φ₃ from the middle node,
/// Φ_i = log(Λ₂ᵀΛ_i), its derivative a = φ' by arc length, u = φ·φ, κ = T(φ) a − κ₀, and g = Λᵀx'.
template <class S>
struct Point3 {
  Vec3<S> phi, a;
  S u;
  CurvatureFunctions<S> f;
  Mat3<S> turn;  ///< exp(φ): rotation from the middle node
  Mat3<S> axes;  ///< Λ = Λ₂ exp(φ): section triad, world axes
  Vec3<S> g, gamma, kappa, force, moment;
  S energy;  ///< strain energy per length W/L

  Point3(const BeamElement3& e, const Configuration<S, 3>& q, const Mat3<S>& middle, const Vec3<S>& Phi1,
         const Vec3<S>& Phi3, int point)
      : phi(Phi1 * S(shape[point][0]) + Phi3 * S(shape[point][2])),
        a(Phi1 * S(slope[point][0] / e.length) + Phi3 * S(slope[point][2] / e.length)),
        u(dot3(phi, phi)),
        f(u) {
    const Mat3<S> P = skew(phi);
    turn = Mat3<S>::Identity() + P * f.s + (P * P) * f.c;
    axes = middle * turn;
    const Vec3<S> slope_x = q.x[0] * S(slope[point][0] / e.length) + q.x[1] * S(slope[point][1] / e.length) +
                            q.x[2] * S(slope[point][2] / e.length);
    g = axes.transpose() * slope_x;
    gamma = g - e.initial_gamma[point].template cast<S>();
    kappa = tangent_times(phi, f, a) - e.initial_kappa[point].template cast<S>();
    const Resultants<S> of(e, gamma, kappa, gamma[0], Vec3<S>::UnitX());
    force = of.force;
    moment = of.moment;
    energy = of.energy;
  }
};

/// State of a three-node beam element: triad of the middle node, rotations relative to it, integration points.
template <class S>
struct State3 {
  Mat3<S> middle;  ///< Λ₂: section triad of the middle node
  Logarithm<S> log1, log3;
  std::array<Point3<S>, 2> point;

  State3(const BeamElement3& e, const Configuration<S, 3>& q)
      : middle(q.R[1] * e.section[1].template cast<S>()),
        log1(middle.transpose() * (q.R[0] * e.section[0].template cast<S>())),
        log3(middle.transpose() * (q.R[2] * e.section[2].template cast<S>())),
        point{Point3<S>(e, q, middle, log1.psi, log3.psi, 0), Point3<S>(e, q, middle, log1.psi, log3.psi, 1)} {}
};

/// Strain energy W of a beam element.
template <class S>
S strain_energy(const BeamElement2& e, const Configuration<S, 2>& q) {
  const State2<S> state(e, q);
  return e.length * state.energy;
}
template <class S>
S strain_energy(const BeamElement3& e, const Configuration<S, 3>& q) {
  const State3<S> state(e, q);
  return 0.5 * e.length * (state.point[0].energy + state.point[1].energy);
}

/// Computes the elastic forces r = [∂W/∂x_i; ∂W/∂Θ_i] of a two-node element. With the rotation increments δθ₁, δθ₂ of
/// the nodes in section axes, σ = δθ₁ + δθ₂ and δ = δθ₂ − δθ₁, and with ψ, w, e of Logarithm, the variations are
/// δψ = (1 + e ψ~²) δ + ψ×σ/2, δθ_m = (σ + w×δ)/2 (middle section), δg = Λᵀ δx' + g×δθ_m.
template <class S>
void internal_force(const BeamElement2& e, const State2<S>& state, Eigen::Matrix<S, 12, 1>& r) {
  const Vec3<S>& psi = state.log.psi;
  const Vec3<S> n = state.axes * state.on_g;
  const Vec3<S> h = cross(state.on_g, state.g) * S(e.length);
  const Vec3<S> psi_m = cross(psi, state.on_psi);
  const Vec3<S> sum = (h - psi_m) * S(0.5);
  const Vec3<S> difference = cross(h, state.log.w) * S(0.5) + state.on_psi + cross(psi, psi_m) * state.log.e;
  r.template segment<3>(0) = -n;
  r.template segment<3>(3) = e.section[0].template cast<S>() * (sum - difference);
  r.template segment<3>(6) = n;
  r.template segment<3>(9) = e.section[1].template cast<S>() * (sum + difference);
}

/// Generalised forces on the relative rotations Φ₁, Φ₃ and on θ₂ of the middle node of an element (section axes).
template <class S>
struct Moments3 {
  Vec3<S> on1, on3, direct;
};

/// Computes the elastic forces r = [∂W/∂x_i; ∂W/∂Θ_i] of a three-node element. Returns their moments. Variations:
/// δΦ_i = T⁻¹(Φ_i) δθ_i − T⁻ᵀ(Φ_i) δθ₂, δθ = exp(−φ) δθ₂ + T(φ) δφ, δκ = δ(T(φ) φ').
template <class S>
Moments3<S> internal_force(const BeamElement3& e, const State3<S>& state, Eigen::Matrix<S, 18, 1>& r) {
  const double weight = 0.5 * e.length;
  Moments3<S> P{Vec3<S>::Zero(), Vec3<S>::Zero(), Vec3<S>::Zero()};
  r.setZero();
  for (int k = 0; k < 2; ++k) {
    const Point3<S>& p = state.point[k];
    const Vec3<S> n = p.axes * p.force;
    for (int i = 0; i < 3; ++i) r.template segment<3>(6 * i) += n * S(0.5 * slope[k][i]);
    const Vec3<S> h = cross(p.force, p.g) * S(weight);
    const Vec3<S> minus = -p.phi;
    const Vec3<S> on_phi = tangent_times(minus, p.f, h) + tangent_gradient(p.phi, p.u, p.f, p.a, p.moment) * S(weight);
    const Vec3<S> on_a = tangent_times(minus, p.f, p.moment);
    P.on1 += on_phi * S(shape[k][0]) + on_a * S(0.5 * slope[k][0]);
    P.on3 += on_phi * S(shape[k][2]) + on_a * S(0.5 * slope[k][2]);
    P.direct += p.turn * h;
  }
  const Vec3<S> minus1 = -state.log1.psi, minus3 = -state.log3.psi;
  r.template segment<3>(3) = e.section[0].template cast<S>() * inverse_tangent_times(minus1, state.log1.e, P.on1);
  r.template segment<3>(9) =
      e.section[1].template cast<S>() * (P.direct - inverse_tangent_times(state.log1.psi, state.log1.e, P.on1) -
                                         inverse_tangent_times(state.log3.psi, state.log3.e, P.on3));
  r.template segment<3>(15) = e.section[2].template cast<S>() * inverse_tangent_times(minus3, state.log3.e, P.on3);
  return P;
}

/// Shares of an element of mass 1: consistent mass ∫ N_i N_j dS / L, and ∫ N_i dS / L (gravity, rotary inertia).
template <int N>
struct Shares;
template <>
struct Shares<2> {
  static constexpr double mass[2][2] = {{1.0 / 3, 1.0 / 6}, {1.0 / 6, 1.0 / 3}};
  static constexpr double node[2] = {0.5, 0.5};
};
template <>
struct Shares<3> {
  static constexpr double mass[3][3] = {
      {2.0 / 15, 1.0 / 15, -1.0 / 30}, {1.0 / 15, 8.0 / 15, 1.0 / 15}, {-1.0 / 30, 1.0 / 15, 2.0 / 15}};
  static constexpr double node[3] = {1.0 / 6, 2.0 / 3, 1.0 / 6};
};

/// Pointers to the motions of the N nodes of one element.
template <class Motion, int N>
using NodePointers = std::array<const Motion*, static_cast<std::size_t>(N)>;

/// Constants of the parabola of the mass of a two-node element, x(ξ) = (1 − ξ) x₁ + ξ x₂ + ξ(1 − ξ) b. It is the even
/// part of the cubic through both nodes. Inertia is m times integrals of products of 1 − ξ, ξ and ξ(1 − ξ).
/// b = d − 0.6 (d·c) c/L², d = L (t₁ − t₂)/2, c = x₂ − x₁, unit vectors t_i along the beam at node i.
/// d vanishes in every rigid motion of a straight element. For an arc it is exact to O(L⁴). d is normal to the mean of
/// the tangents, but b must be nearly normal to the chord: 0.4 of the angle φ between both turns it. The reason is that
/// the weight q L changes the tension along an element. With the slope κ s + φ (6 s² − ½), s from −½ to ½ along L, this
/// has the energy −q L² κ φ/30 (κ: difference of the slopes at the ends), as with b. With d alone it is −q L² κ φ/12,
/// and the free end of a chain turns over if q L³ exceeds 130 EI.
struct Parabola {
  static constexpr double by_node = 1.0 / 12, by_itself = 1.0 / 30, whole = 1.0 / 6, across = 0.6;
  static constexpr std::array<double, 2> sign = {0.5, -0.5};  ///< d = L Σ sign_i R_i a_i
};

/// Unit vector a_i along the beam in the axes of node i.
inline Eigen::Vector3d along(const BeamElement2& e, int i) { return e.section[i].col(0); }

/// Vectors d, c and b of Parabola for one element, with their rates. The derivatives of b are B = ∂b/∂d = 1 − k c cᵀ
/// and H = ∂b/∂c = −k (c dᵀ + (d·c) 1), k = 0.6/L².
template <class S>
struct Bow {
  Vec3<S> d, d_rate, d_acceleration, c, c_rate, c_acceleration;
  S k;

  template <class Motion>
  Bow(const BeamElement2& e, const std::array<const Motion*, 2>& node)
      : d(Vec3<S>::Zero()),
        d_rate(Vec3<S>::Zero()),
        d_acceleration(Vec3<S>::Zero()),
        c(node[1]->x - node[0]->x),
        c_rate(node[1]->xd - node[0]->xd),
        c_acceleration(node[1]->xdd - node[0]->xdd),
        k(Parabola::across / (e.length * e.length)) {
    for (int i = 0; i < 2; ++i) {
      const Vec3<S> a = along(e, i).template cast<S>() * S(Parabola::sign[i] * e.length);
      const Vec3<S> rate = cross<S>(node[i]->Omega, a);
      const Vec3<S> turned = cross<S>(node[i]->Omegad, a) + cross<S>(node[i]->Omega, rate);
      d += node[i]->R * a;
      d_rate += node[i]->R * rate;
      d_acceleration += node[i]->R * turned;
    }
  }

  Vec3<S> value() const { return on_d(d); }
  Vec3<S> rate() const { return on_d(d_rate) + by_chord(c_rate); }
  /// Acceleration b̈ = B d̈ + H c̈ − 2k [(c·ḋ + d·ċ) ċ + (ḋ·ċ) c], with B = ∂b/∂d and H = ∂b/∂c.
  Vec3<S> acceleration() const {
    const Vec3<S> rates = c_rate * (dot3(c, d_rate) + dot3(d, c_rate)) + c * dot3(d_rate, c_rate);
    return on_d(d_acceleration) + by_chord(c_acceleration) - rates * (k + k);
  }
  /// Product B f = Bᵀ f with the symmetric B = ∂b/∂d: the force on d that a force f on b causes.
  Vec3<S> on_d(const Vec3<S>& f) const { return f - c * (k * dot3(c, f)); }
  /// Product Hᵀ f with H = ∂b/∂c: the force on c that a force f on b causes.
  Vec3<S> on_chord(const Vec3<S>& f) const { return (d * dot3(c, f) + f * dot3(d, c)) * (-k); }
  /// Product H u with H = ∂b/∂c.
  Vec3<S> by_chord(const Vec3<S>& u) const { return (c * dot3(d, u) + u * dot3(d, c)) * (-k); }
};

/// Inertia force less weight that does work on the bow vector b of Parabola. `acceleration`: b̈.
template <class S, class Motion>
Vec3<S> force_on_bow(const BeamElement2& e, const std::array<const Motion*, 2>& node, const Eigen::Vector3d& gravity,
                     const Vec3<S>& acceleration) {
  return ((node[0]->xdd + node[1]->xdd) * S(Parabola::by_node) + acceleration * S(Parabola::by_itself) -
          gravity.template cast<S>() * S(Parabola::whole)) *
         S(e.mass);
}

/// Adds inertia force less weight to the residual r: M ẍ − m_i g and J Ω̇ + Ω × J Ω; two nodes: with the parabola.
/// `Motion`: NodeMotion or its equivalent with another scalar.
template <class S, int N, class Motion>
void add_inertia(const BeamElement<N>& e, const NodePointers<Motion, N>& node, const Eigen::Vector3d& gravity,
                 Eigen::Matrix<S, 6 * N, 1>& r) {
  for (int i = 0; i < N; ++i) {
    const double m = e.mass;
    Vec3<S> f = gravity.template cast<S>() * S(-m * Shares<N>::node[i]);
    for (int j = 0; j < N; ++j) f += node[j]->xdd * S(m * Shares<N>::mass[i][j]);
    r.template segment<3>(6 * i) += f;
    if (!e.rotary) continue;
    const Mat3<S> J = e.inertia[i].template cast<S>();
    const Vec3<S> spin = J * node[i]->Omega;
    r.template segment<3>(6 * i + 3) += J * node[i]->Omegad + cross<S>(node[i]->Omega, spin);
  }
  if constexpr (N == 2) {
    const Bow<S> bow(e, node);
    const Vec3<S> acceleration = bow.acceleration(), f = force_on_bow<S>(e, node, gravity, acceleration);
    const Vec3<S> on_d = bow.on_d(f), on_chord = bow.on_chord(f);
    for (int i = 0; i < 2; ++i) {
      r.template segment<3>(6 * i) += acceleration * S(e.mass * Parabola::by_node) + on_chord * S(i == 0 ? -1.0 : 1.0);
      const Vec3<S> arm = along(e, i).template cast<S>() * S(Parabola::sign[i] * e.length);
      const Vec3<S> force = node[i]->R.transpose() * on_d;
      r.template segment<3>(6 * i + 3) += cross(arm, force);
    }
  }
}

}  // namespace tisserand::mechanism::beam
