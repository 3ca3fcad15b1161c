// SPDX-License-Identifier: GPL-3.0-or-later
// Values at one instant: one number per node and per cell, and their maxima.
#pragma once

#include <vector>

#include "reducer/recover/places.hpp"
#include "reducer/recover/stresses.hpp"

namespace tisserand::reducer {

/// One value per node or cell at one instant.
struct InstantValues {
  std::vector<float> displacement;     ///< V: length
  std::vector<float> solid_von_mises;  ///< V: largest of the stress points at the node; 0 without any
  std::vector<float> solid_stress;     ///< 6 V: stress of that point, in VTK's order xx yy zz xy yz xz
  std::vector<float> von_mises;        ///< elements: beams |normal stress|, worse face of shells, worst node of solids
};
InstantValues instant_values(const formats::Recovery& recovery, const SolidPoints& points,
                             const RecoveredFields& fields, Eigen::Index instant);

/// Largest value of a kind and its node or element; -1: none.
struct LargestAt {
  float value = 0.0f;
  int at = -1;
};

struct InstantPeaks {
  LargestAt beam, shell, solid;  ///< elements; for solids the node
};
InstantPeaks instant_peaks(const formats::Recovery& recovery, const InstantValues& values);

}  // namespace tisserand::reducer
