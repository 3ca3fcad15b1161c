// SPDX-License-Identifier: GPL-3.0-or-later
// Values at one instant: one number per node and per cell, and their maxima.
#pragma once

#include <vector>

#include "reducer/recover/places.hpp"
#include "reducer/recover/stresses.hpp"

namespace tisserand::reducer {

/// Displacements and stresses at one instant, as one value per node or per element. V is the number of nodes.
struct InstantValues {
  std::vector<float> displacement;     ///< V: magnitude of the displacement [length of the scene]
  std::vector<float> solid_von_mises;  ///< V: largest von Mises stress of the stress points at the node; 0 without any
  /// 6 V: stress of the stress point with this largest value, in the order xx yy zz xy yz xz of VTK.
  std::vector<float> solid_stress;
  /// Elements: |normal stress| of beams, von Mises stress of the worse face of shells and worst node of solids.
  std::vector<float> von_mises;
};
InstantValues instant_values(const formats::Recovery& recovery, const SolidPoints& points,
                             const RecoveredFields& fields, Eigen::Index instant);

/// Largest stress of one kind of element, and the element or node that has it (`at`; −1: none).
struct LargestAt {
  float value = 0.0f;
  int at = -1;
};

/// Largest stresses of beams, shells and solids at one instant, with their places.
struct InstantPeaks {
  LargestAt beam, shell, solid;  ///< `at` is the element, for solids the node
};
InstantPeaks instant_peaks(const formats::Recovery& recovery, const InstantValues& values);

}  // namespace tisserand::reducer
