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

/// Least relaxation length over the radius. With it an unloaded tyre loses its deflection within a fraction of a turn.
inline constexpr double least_relaxation = 0.05;

/// Tyre: a disc of radius R₀ about the origin of the marker `wheel`, with the axle along y of the marker, on a road. γ
/// is the camber, Ω the spin. V_x and V_y are velocities of the contact along and across the wheel.
///
/// Load: F_z = max(0, k δ + k₂ δ² + c δ̇ ramp) with the penetration δ and c = `damping`. The ramp raises the damping
/// over the first hundredth of the radius, so that no force jumps when a wheel lands. The rolling radius is R = R₀ −
/// δ/3 ([Ril12] chapter 3), or that of the file. Without relaxation slips are slip velocities over the speed V that the
/// law chooses. Below v₀ = `low_speed` they are over (V² + v₀²)/(2 v₀), so a standing tyre creeps and does not stick.
///
/// With relaxation the slips are tread deflections over relaxation lengths, u/σ_x and v/σ_y. Their equations are
/// u̇ = V_sx − V u/σ_x and v̇ = V_y − V v/σ_y ([Pac12] section 7.2), V_sx = V_x − Ω R, V not below |V_y|. At rest the
/// deflections act as springs, and sliding at standstill is Dahl's friction. The deflections are coordinates of the
/// model with a small mass, τ ü + u̇ = .., whose time τ = 1e-6 R₀/v₀ integrators damp. The relative error is τ V/σ
/// while the tyre relaxes, and zero in steady motion. Below 10 v₀ a part of the slip velocity V_s, 0.01 V_s/v₀ at rest,
/// damps oscillations on the deflections.
///
/// Moments: M_x = F_z (R₀ − radius) sin γ, with the loaded radius, unless the law has its own. With it the load is that
/// of the energy of the penetration. −(R − radius) F_x about the axle makes V_x − Ω R the velocity at which F_x takes
/// power: a tyre alone drives nothing. −C_r F_z R about the axle, C_r = `rolling_resistance`, or the moment of the law,
/// resists rolling.
struct Tyre {
  std::string name;
  Marker wheel;
  int road = 0;  ///< index in Model::roads
  double radius = 0.0;
  double stiffness = 0.0;    ///< k: vertical stiffness
  double progressive = 0.0;  ///< k₂: quadratic part of the vertical stiffness
  double damping = 0.0;
  std::variant<ComprehensiveSlip, MagicFormulaLaw> law;
  double rolling_resistance = 0.0;
  double low_speed = 0.0;
  double relaxation = 0.0;  ///< relaxation length of comprehensive slip, both directions
  int lag = -1;             ///< index of u among the modal coordinates, then v; −1: none
  bool planar = false;      ///< rolls in the plane of a planar model (in_plane.hpp)

  bool relaxes() const { return lag >= 0; }
};

/// Deflections w = [u; v] of the tread of a tyre with relaxation, and their first and second rates. They are zero
/// without relaxation.
struct Tread {
  Eigen::Vector2d w = Eigen::Vector2d::Zero(), wd = Eigen::Vector2d::Zero(), wdd = Eigen::Vector2d::Zero();
};

/// Forces and slips of a tyre at one instant. Tyre axes are x, y, n of DiscContact (ISO-W). Forces are zero without
/// contact.
struct TyreTerms {
  Vector6d residual = Vector6d::Zero();               ///< −[force (world); moment about the node (its axes)]
  Eigen::Vector2d lag = Eigen::Vector2d::Zero();      ///< residual of the equations of u and v
  Eigen::Vector3d force = Eigen::Vector3d::Zero();    ///< force on the wheel, tyre axes
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();   ///< moment about the contact centre, tyre axes
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();  ///< contact centre, from the origin of the model
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double slip = 0.0;         ///< (Ω R − V_x)/V: positive when driving forward
  double slip_angle = 0.0;   ///< atan(V_y/|V_x|), ISO 8855: positive where F_y is negative
  double camber = 0.0;       ///< camber (inclination), right-handed about x
  double penetration = 0.0;  ///< depth below the road; negative: height above it
  double rolling_radius = 0.0;
  double adhesion = 0.0;  ///< share of the patch that adheres, or of friction left
  double energy = 0.0;    ///< energy of the vertical spring, ½ k δ² + ⅓ k₂ δ³
};
/// Computes the terms of a tyre at the motion of its wheel. `node`: motion of the node of the wheel.
void evaluate(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread, TyreTerms& terms);

/// Power that a tyre dissipates: power taken from the wheel minus the rate of the energy of its vertical spring.
/// Requires `terms` at the motion of the node. It costs as much as these terms, since it needs the rate of the ground
/// under the wheel.
double dissipated_power(const Tyre& tyre, const Road& road, const NodeMotion& node, const TyreTerms& terms);

/// Tangent c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q of a tyre (8 x 8), with six rows of the wheel, then those of u and v. It
/// is exact except at limits of terms and for changes of road friction along the way. Without relaxation the last two
/// rows and columns are zero.
Matrix8d tangent(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                 const TangentCoefficients& coefficients);

/// Rates of the tread deflections `w` = [u; v] in settled motion of the wheel, by their equations without mass.
Eigen::Vector2d settled_rates(const Tyre& tyre, const Road& road, const NodeMotion& node, const Eigen::Vector2d& w);
/// Mass m of the equations of the tread deflections u and v.
double lag_mass(const Tyre& tyre);

/// Quantity of a tyre at the motion of its wheel, as in TyreTerms.
double tyre_quantity(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                     formats::TyreQuantity quantity);
/// Derivative c_c ∂/∂v + c_k ∂/∂q of tyre_quantity() by the motion of the wheel. It omits the deflections of the tread,
/// which costs iterations if an expression uses the slip of a tyre with relaxation.
Vector6d tyre_quantity_gradient(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                                formats::TyreQuantity quantity, const TangentCoefficients& coefficients);

/// Largest lateral effect of a tyre relative to its load: force across the wheel and moments not about the axle (over
/// the radius). The wheel rolls upright and straight on a plane, with several loads, speeds and slips.
double sideways_share(const Tyre& tyre);

/// Stiffness (8 x 8) with which statics holds free motions of a standing tyre, in the matrix only, without force. The
/// motions are those along the road, roll, deflections of the tread, and in the air the motion normal to the road.
Matrix8d standing_stiffness(const Tyre& tyre, const Road& road, const NodeMotion& node, const TyreTerms& terms);

}  // namespace tisserand::mechanism
