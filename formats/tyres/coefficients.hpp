// SPDX-License-Identifier: GPL-3.0-or-later
// Coefficients of tyre property files, by name.
#pragma once

#include <span>

#include "formats/tyres/magic_formula.hpp"

namespace tisserand::formats {

enum class Quantity { number, length, force, stiffness, damping, speed, pressure };
enum class Versions { both, only_5_2, only_6_1 };

/// Coefficient of the Magic Formula: name in the file, member that stores it, versions that have it, physical
/// dimension.
struct Coefficient {
  const char* name;
  double MagicFormula::*value;
  Versions versions = Versions::both;
  Quantity dimension = Quantity::number;
};

/// Whether files of the given version of the Magic Formula have the coefficient.
inline bool holds(Versions versions, MagicFormulaVersion version) {
  return versions == Versions::both || (versions == Versions::only_6_1) == (version == MagicFormulaVersion::mf_6_1);
}

std::span<const Coefficient> tyre_coefficients();

}  // namespace tisserand::formats
