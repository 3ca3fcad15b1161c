// SPDX-License-Identifier: GPL-3.0-or-later
// Slip of the contact patch of a tyre and its force: the interface between the motion of a wheel and the laws of slip.
#pragma once

namespace tisserand::mechanism {

/// Slips of the contact patch, and what else its force depends on. Slips are velocities of the contact over a speed
/// that the law chooses, or tread deflections over relaxation lengths. `along`: slip along x against the rolling
/// (positive: braking while rolling forward). `across`: slip along y. `rolling`: direction in which the tread runs
/// through the patch, −1 to 1, 0 at standstill.
template <class T>
struct PatchSlip {
  T along, across;
  T camber_sine;
  T load;
  T length;  ///< length of the patch
  T radius;  ///< rolling radius
  T rolling;
  T speed = T(0.0);       ///< |V_x|, velocity along the wheel
  double friction = 1.0;  ///< factor of the road on coefficients of friction
};

/// Force of the contact patch in tyre axes, about the contact centre.
template <class T>
struct PatchForce {
  T x = T(0.0), y = T(0.0), moment = T(0.0);    ///< F_x, F_y, M_z
  T overturning = T(0.0), resistance = T(0.0);  ///< M_x and M_y, if the law contains them
  double adhesion = 0.0;                        ///< fraction of the patch that does not slide
};

}  // namespace tisserand::mechanism
