// Tyre: what a disc on a road exerts on the wheel that carries it.
#pragma once

#include <string>

#include <Eigen/Core>

#include "mechanism/frames/marker.hpp"
#include "mechanism/tyres/comprehensive_slip.hpp"
#include "mechanism/tyres/contact.hpp"

namespace tisserand::mechanism {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A disc of radius R₀ about the origin of `wheel`, with the axle as y of the marker, on a road at rest.
///
/// Load: F_z = max(0, k δ + c δ̇ ramp) with the penetration δ; the ramp leads the damper in over the first hundredth of
/// the radius, so that nothing jumps when a wheel lands. The rolling radius is R = R₀ − δ/3 ([Ril12] chapter 3). Slips
/// are velocities of the contact over V = max(|V_x|, |Ω R|), below v₀ over (V² + v₀²)/(2 v₀): a standing tyre creeps
/// rather than sticks.
///
/// Moments about the contact centre: M_x = F_z (R₀ − radius) sin γ makes the load that of the energy ½ k δ²; about the
/// axle −(R − radius) F_x makes the slip velocity V_x − Ω R the one at which F_x takes power (a tyre drives nothing by
/// itself), and −C_r F_z R resists rolling.
struct Tyre {
  std::string name;
  Marker wheel;
  int road = 0;  ///< row of Model::roads
  double radius = 0.0;
  double stiffness = 0.0;
  double damping = 0.0;
  ComprehensiveSlip law;
  double rolling_resistance = 0.0;
  double low_speed = 0.0;
};

/// At one instant. Force and moment on the wheel; ISO-W axes x, y, n of DiscContact. Zero without contact.
struct TyreTerms {
  Vector6d residual = Vector6d::Zero();               ///< minus [force, world; moment about the node, its axes]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();    ///< tyre axes
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();   ///< about the contact centre, tyre axes
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();  ///< contact centre, counted as positions of nodes
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double slip = 0.0;         ///< (Ω R − V_x)/V: positive when driving forward
  double slip_angle = 0.0;   ///< atan(V_y/|V_x|), ISO 8855: positive where F_y is negative
  double camber = 0.0;       ///< inclination, right-handed about x
  double penetration = 0.0;  ///< negative: height of the disc above the road
  double rolling_radius = 0.0;
  double adhesion = 0.0;    ///< share of the patch that does not slide; 0 in the air
  double energy = 0.0;      ///< ½ k δ²
  double dissipated = 0.0;  ///< power taken from the wheel beyond the energy
};
void evaluate(const Tyre& tyre, const Road& road, const NodeMotion& node, TyreTerms& terms);

/// c_c ∂residual/∂v + c_k ∂residual/∂q, exact but for what only terms at their limits know.
Matrix6d tangent(const Tyre& tyre, const Road& road, const NodeMotion& node, const TangentCoefficients& coefficients);

/// A quantity of TyreTerms, and c_c ∂/∂v + c_k ∂/∂q of it, exact as the tangent.
double tyre_quantity(const Tyre& tyre, const Road& road, const NodeMotion& node, formats::TyreQuantity quantity);
Vector6d tyre_quantity_gradient(const Tyre& tyre, const Road& road, const NodeMotion& node,
                                formats::TyreQuantity quantity, const TangentCoefficients& coefficients);

/// Stiffness with which statics holds what a standing tyre leaves free (matrix alone, no force): motion along the road,
/// roll, and in the air also the way down.
Matrix6d standing_stiffness(const Tyre& tyre, const Road& road, const NodeMotion& node, const TyreTerms& terms);

}  // namespace tisserand::mechanism
