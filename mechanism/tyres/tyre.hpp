// SPDX-License-Identifier: GPL-3.0-or-later
// Tyre: forces of a disc on a road on the wheel that carries it.
#pragma once

#include <string>
#include <variant>

#include <Eigen/Core>

#include "mechanism/frames/marker.hpp"
#include "mechanism/tyres/road.hpp"
#include "mechanism/tyres/slip_law.hpp"

namespace tisserand::mechanism {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

using Vector8d = Eigen::Matrix<double, 8, 1>;
using Matrix8d = Eigen::Matrix<double, 8, 8>;

/// Least relaxation length over the radius: an unloaded tyre loses its deflection within a fraction of a turn.
inline constexpr double least_relaxation = 0.05;

/// Disc of radius R₀ about the origin of `wheel`, with the axle as y of the marker, on a road at rest.
///
/// Load: F_z = max(0, k δ + k₂ δ² + c δ̇ ramp) with the penetration δ. The ramp raises the damping over the first
/// hundredth of the radius, so that no force jumps when a wheel lands. The rolling radius is R = R₀ − δ/3 ([Ril12]
/// chapter 3), or that of the file. Slips without relaxation are velocities of the contact over V, the speed that the
/// law chooses. Below v₀ they are over (V² + v₀²)/(2 v₀), so a standing tyre creeps and does not stick.
///
/// With relaxation the slips are tread deflections over relaxation lengths, u/σ_x and v/σ_y. u̇ = V_sx − V u/σ_x and v̇
/// = V_y − V v/σ_y ([Pac12] section 7.2), V not below |V_y|. At rest the deflections act as springs, and sliding at
/// standstill is Dahl's friction. They are coordinates of the model with a small mass, τ ü + u̇ = .., whose time τ =
/// 1e-6 R₀/v₀ integrators damp. The relative error is τ V/σ while the tyre relaxes, and zero in steady motion. Below 10
/// v₀ a part of the slip velocity, 0.01 V_s/v₀ at rest, damps oscillations on the deflections.
///
/// Moments: M_x = F_z (R₀ − radius) sin γ makes the load that of the energy of the penetration, unless the law has its
/// own. −(R − radius) F_x about the axle makes V_x − Ω R the velocity at which F_x takes power: a tyre alone drives
/// nothing. −C_r F_z R about the axle, or that of the law, resists rolling.
struct Tyre {
  std::string name;
  Marker wheel;
  int road = 0;  ///< row of Model::roads
  double radius = 0.0;
  double stiffness = 0.0;    ///< k
  double progressive = 0.0;  ///< k₂
  double damping = 0.0;
  std::variant<ComprehensiveSlip, MagicFormulaLaw> law;
  double rolling_resistance = 0.0;
  double low_speed = 0.0;
  double relaxation = 0.0;  ///< σ of comprehensive slip, both directions
  int lag = -1;             ///< modal coordinate of u, that of v follows; −1: no relaxation
  bool planar = false;      ///< rolls in the x-y plane of a planar model: functions of in_plane.hpp

  bool relaxes() const { return lag >= 0; }
};

/// Deflections [u; v] of the tread of a tyre with relaxation, and their first and second rates; zero otherwise.
struct Tread {
  Eigen::Vector2d w = Eigen::Vector2d::Zero(), wd = Eigen::Vector2d::Zero(), wdd = Eigen::Vector2d::Zero();
};

/// Terms at one instant: force and moment on the wheel, ISO-W axes x, y, n of DiscContact. Zero without contact.
struct TyreTerms {
  Vector6d residual = Vector6d::Zero();               ///< minus [force, world; moment about the node, its axes]
  Eigen::Vector2d lag = Eigen::Vector2d::Zero();      ///< residual of the equations of u and v
  Eigen::Vector3d force = Eigen::Vector3d::Zero();    ///< tyre axes
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();   ///< about the contact centre, tyre axes
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();  ///< contact centre, from the origin of node positions
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double slip = 0.0;         ///< (Ω R − V_x)/V: positive when driving forward
  double slip_angle = 0.0;   ///< atan(V_y/|V_x|), ISO 8855: positive where F_y is negative
  double camber = 0.0;       ///< inclination, right-handed about x
  double penetration = 0.0;  ///< negative: height of the disc above the road
  double rolling_radius = 0.0;
  double adhesion = 0.0;  ///< fraction of the patch that does not slide, or of the friction that is left; 0 in the air
  double energy = 0.0;    ///< ½ k δ² + ⅓ k₂ δ³
};
/// Terms of a tyre at the motion of its wheel.
void evaluate(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread, TyreTerms& terms);

/// Power taken from the wheel minus the rate of the energy, at the motion of these terms. It costs as much as they do,
/// since it needs the rate of the ground under the wheel.
double dissipated_power(const Tyre& tyre, const Road& road, const NodeMotion& node, const TyreTerms& terms);

/// Tangent c_m ∂residual/∂v̇ + c_c ∂residual/∂v + c_k ∂residual/∂q of wheel, u and v. Exact except at limits of terms
/// and for changes of road friction along the way. Without relaxation the last two rows and columns are zero.
Matrix8d tangent(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                 const TangentCoefficients& coefficients);

/// Rates of u and v in settled motion of the wheel: those of the equations without mass.
Eigen::Vector2d settled_rates(const Tyre& tyre, const Road& road, const NodeMotion& node, const Eigen::Vector2d& w);
/// Mass of the equations of u and v.
double lag_mass(const Tyre& tyre);

/// Quantity of TyreTerms, and its derivative c_c ∂/∂v + c_k ∂/∂q by the motion of the wheel. The derivative omits the
/// deflections of a tread, which costs iterations if an expression uses the slip of such a tyre.
double tyre_quantity(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                     formats::TyreQuantity quantity);
Vector6d tyre_quantity_gradient(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                                formats::TyreQuantity quantity, const TangentCoefficients& coefficients);

/// Largest ratio to the load of the force across the wheel and of moments (over the radius) not about the axle. The
/// wheel rolls upright and straight on a plane, with several loads, speeds and slips.
double sideways_share(const Tyre& tyre);

/// Stiffness with which statics holds free motions of a standing tyre, in the matrix only, without force. These are the
/// motion along the road, roll, deflections of the tread, and in the air the motion normal to the road.
Matrix8d standing_stiffness(const Tyre& tyre, const Road& road, const NodeMotion& node, const TyreTerms& terms);

}  // namespace tisserand::mechanism
