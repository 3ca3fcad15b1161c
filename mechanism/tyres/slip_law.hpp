// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of the laws by which tyres slip; the formulas are in the headers named after the laws.
#pragma once

#include "formats/tyres/magic_formula.hpp"

namespace tisserand::mechanism {

/// Constants of [GN90]. Stiffnesses are forces per unit of slip; angles count as slips.
struct ComprehensiveSlip {
  double slip_stiffness = 0.0;       ///< C_s
  double cornering_stiffness = 0.0;  ///< C_α
  double camber_stiffness = 0.0;     ///< C_γ
  double friction = 0.0;             ///< μ₀ without slip
  double sliding_friction = 0.0;     ///< μ₁ at slip 1 and beyond
};

/// Coefficients of a property file for one wheel.
struct MagicFormulaLaw {
  formats::MagicFormula p;
  double pressure = 0.0;  ///< dp_i: inflation pressure over that of the file, less 1
  bool mirrored = false;  ///< the wheel is on the other side of the vehicle than in the file

  bool is_6_1() const { return p.version == formats::MagicFormulaVersion::mf_6_1; }
  bool has_overturning() const {
    return p.QSX1 != 0.0 || p.QSX2 != 0.0 || p.QSX3 != 0.0 || p.QSX4 != 0.0 || p.QSX10 != 0.0 || p.QSX12 != 0.0 ||
           p.QSX13 != 0.0 || p.QSX14 != 0.0;
  }
};

}  // namespace tisserand::mechanism
