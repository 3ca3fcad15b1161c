// SPDX-License-Identifier: GPL-3.0-or-later
// Check whether stiffness and density belong to one material, in the units of the file.
#pragma once

#include <string>

#include "common/units.hpp"

namespace tisserand::formats {

/// Stiffness and density of a beam (per length), a shell (per area) or a solid (per volume).
struct Substance {
  std::string what;  ///< "material 'steel'"
  double modulus = 0.0;
  double density = 0.0;
};

/// Warning for unusual numbers of a material; empty if there is nothing unusual, no density, or units have no names.
/// Unusual is a density outside 10 to 30 000 kg/m³ (aerogel, tungsten) or a speed of sound √(E/ρ) outside 100 to 20 000
/// m/s (rubber, diamond). The warning suggests units in which the numbers would be those of common materials. `owner`:
/// "the part", "the scene".
std::string substance_doubt(const Substance& substance, const Units& units, const std::string& owner);

}  // namespace tisserand::formats
