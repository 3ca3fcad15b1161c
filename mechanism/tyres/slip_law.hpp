// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of the laws by which tyres slip; the formulas are in the headers named after the laws.
#pragma once

#include "formats/tyres/magic_formula.hpp"

namespace tisserand::mechanism {

/// Constants of the law of comprehensive slip [GN90]. Stiffnesses are forces per unit of slip; angles count as slips.
struct ComprehensiveSlip {
  double slip_stiffness = 0.0;       ///< C_s: longitudinal force per slip
  double cornering_stiffness = 0.0;  ///< C_α: lateral force per slip angle
  double camber_stiffness = 0.0;     ///< C_γ: lateral force per sine of camber
  double friction = 0.0;             ///< μ₀: friction without slip
  double sliding_friction = 0.0;     ///< μ₁: friction at slip 1 and beyond
};

/// Magic Formula for one wheel: the coefficients of its property file.
struct MagicFormulaLaw {
  formats::MagicFormula p;
  double pressure = 0.0;  ///< dp_i: inflation pressure over that of the file, minus 1
  bool mirrored = false;  ///< the wheel is on the other side of the vehicle than in the file

  bool is_6_1() const { return p.version == formats::MagicFormulaVersion::mf_6_1; }
  bool has_overturning() const {
    return p.QSX1 != 0.0 || p.QSX2 != 0.0 || p.QSX3 != 0.0 || p.QSX4 != 0.0 || p.QSX10 != 0.0 || p.QSX12 != 0.0 ||
           p.QSX13 != 0.0 || p.QSX14 != 0.0;
  }
};

}  // namespace tisserand::mechanism
