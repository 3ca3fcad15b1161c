// Whether stiffness and density belong to one material, in the units that the file says.
#pragma once

#include <string>

#include "common/units.hpp"

namespace tisserand::formats {

/// Both per length, per area or per volume.
struct Substance {
  std::string what;  ///< "material 'steel'"
  double modulus = 0.0;
  double density = 0.0;
};

/// What is doubtful about a density outside 10 to 30 000 kg/m³ (aerogel and tungsten lie within) or a speed of sound
/// √(E/ρ) outside 100 to 20 000 m/s (rubber and diamond lie within), with the units in which the numbers would be those
/// of common materials. Empty: nothing, no density, or units without names. `owner`: "the part", "the scene".
std::string substance_doubt(const Substance& substance, const Units& units, const std::string& owner);

}  // namespace tisserand::formats
