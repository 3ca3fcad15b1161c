// Largest values over time of everything that was recovered, and when.
#pragma once

#include <string>
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

/// Largest value of a kind, where and when.
struct Peak {
  float value = 0.0f;
  double time = 0.0;
  int at = -1;  ///< node or element
};

struct Envelope {
  std::vector<float> displacement, solid_von_mises, von_mises;  ///< over all instants so far
  std::vector<float> displacement_time, von_mises_time;
  Peak moved;               ///< node
  Peak beam, shell, solid;  ///< elements; of solids the node
};

/// `values` of one more instant.
void extend(const formats::Recovery& recovery, const InstantValues& values, double time, Envelope& envelope);

}  // namespace tisserand::reducer
