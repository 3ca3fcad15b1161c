// What the contact patch of a tyre feels and what it exerts: between the motion of a wheel and the laws of slip.
#pragma once

namespace tisserand::mechanism {

/// Slips are velocities of the contact over a speed that the law chooses, or tread deflections over relaxation lengths:
/// along x against the rolling (positive: braking while rolling forward), across it along y. `rolling`: −1 to 1,
/// direction in which the tread runs through the patch, 0 at standstill.
template <class T>
struct PatchSlip {
  T along, across;
  T camber_sine;
  T load;
  T length;  ///< of the patch
  T radius;  ///< rolling radius
  T rolling;
  T speed = T(0.0);       ///< |V_x|
  double friction = 1.0;  ///< of the road: factor of the coefficients of friction
};

/// In tyre axes, about the contact centre.
template <class T>
struct PatchForce {
  T x = T(0.0), y = T(0.0), moment = T(0.0);    ///< F_x, F_y, M_z
  T overturning = T(0.0), resistance = T(0.0);  ///< M_x and M_y of laws that measured them
  double adhesion = 0.0;                        ///< share of the patch that does not slide
};

}  // namespace tisserand::mechanism
