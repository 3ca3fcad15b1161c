// What is seen of everything at one instant: one number per node and per cell, and the largest of them.
#pragma once

#include <vector>

#include "reducer/recover/places.hpp"
#include "reducer/recover/stresses.hpp"

namespace tisserand::reducer {

/// One value per node or cell at one instant.
struct InstantValues {
  std::vector<float> displacement;     ///< V: length
  std::vector<float> solid_von_mises;  ///< V: largest of the stress points at the node, 0 without
  std::vector<float> solid_stress;     ///< 6 V: of that point, in VTK's order xx yy zz xy yz xz
  std::vector<float> von_mises;  ///< elements: beams |normal stress|, shells the worse face, solids the worst node
};
InstantValues instant_values(const formats::Recovery& recovery, const SolidPoints& points,
                             const RecoveredFields& fields, Eigen::Index instant);

/// Largest value of a kind and where: node or element, -1: there is none.
struct LargestAt {
  float value = 0.0f;
  int at = -1;
};

struct InstantPeaks {
  LargestAt beam, shell, solid;  ///< elements; of solids the node
};
InstantPeaks instant_peaks(const formats::Recovery& recovery, const InstantValues& values);

}  // namespace tisserand::reducer
