// SPDX-License-Identifier: GPL-3.0-or-later
// Coefficients of the Magic Formula, with the names of tyre property files (.tir) and [Pac12].
#pragma once

namespace tisserand::formats {

/// Versions of the Magic Formula. mf_5_2: MF-Tyre 5.2, called PAC2002 by Adams. mf_6_1: [Pac12] section 4.3.2, with
/// inflation pressure. Version 6.2 has the force and moment coefficients of 6.1 and three more of the overturning
/// moment.
enum class MagicFormulaVersion { mf_5_2, mf_6_1 };

/// Forces that a tyre file provides (its USE_MODE without the tens).
enum class MagicFormulaForces { none, longitudinal, lateral, uncombined, combined };

/// Coefficients of the Magic Formula. Lengths, forces, pressures and speeds have units of the scene; angles are in
/// [rad]; others have no unit. The formulas are in mechanism/tyres/magic_formula.hpp.
struct MagicFormula {
  MagicFormulaVersion version = MagicFormulaVersion::mf_6_1;
  MagicFormulaForces forces = MagicFormulaForces::combined;
  bool transient = false;  ///< whether the file requests relaxation lengths (tens of USE_MODE)

  bool along() const { return forces != MagicFormulaForces::none && forces != MagicFormulaForces::lateral; }
  bool across() const { return forces != MagicFormulaForces::none && forces != MagicFormulaForces::longitudinal; }

  // Dimensions, vertical, conditions.
  double UNLOADED_RADIUS = 0, FNOMIN = 0, VERTICAL_STIFFNESS = 0, VERTICAL_DAMPING = 0;
  double BREFF = 0, DREFF = 0, FREFF = 0, QFZ1 = 0, QFZ2 = 0, PFZ1 = 0;
  double LONGITUDINAL_STIFFNESS = 0, LATERAL_STIFFNESS = 0;
  double LONGVL = 0, VXLOW = 0, NOMPRES = 0, INFLPRES = 0;
  // Ranges of the fit. Beyond them forces are those of the limits.
  double FZMIN = 0, FZMAX = 0, KPUMIN = 0, KPUMAX = 0, ALPMIN = 0, ALPMAX = 0, CAMMIN = 0, CAMMAX = 0, PRESMIN = 0,
         PRESMAX = 0;
  // Scaling factors.
  double LFZO = 1, LCX = 1, LMUX = 1, LEX = 1, LKX = 1, LHX = 1, LVX = 1, LGAX = 1, LCY = 1, LMUY = 1, LEY = 1, LKY = 1,
         LHY = 1, LVY = 1, LGAY = 1, LKYC = 1, LTR = 1, LRES = 1, LGAZ = 1, LKZC = 1, LXAL = 1, LYKA = 1, LVYKA = 1,
         LS = 1, LMX = 1, LVMX = 1, LMY = 1, LSGKP = 1, LSGAL = 1;
  // Longitudinal force.
  double PCX1 = 0, PDX1 = 0, PDX2 = 0, PDX3 = 0, PEX1 = 0, PEX2 = 0, PEX3 = 0, PEX4 = 0, PKX1 = 0, PKX2 = 0, PKX3 = 0,
         PHX1 = 0, PHX2 = 0, PVX1 = 0, PVX2 = 0, PPX1 = 0, PPX2 = 0, PPX3 = 0, PPX4 = 0;
  double RBX1 = 0, RBX2 = 0, RBX3 = 0, RCX1 = 0, REX1 = 0, REX2 = 0, RHX1 = 0;
  double PTX1 = 0, PTX2 = 0, PTX3 = 0, PCFX1 = 0, PCFX2 = 0, PCFX3 = 0;
  // Lateral force.
  double PCY1 = 0, PDY1 = 0, PDY2 = 0, PDY3 = 0, PEY1 = 0, PEY2 = 0, PEY3 = 0, PEY4 = 0, PEY5 = 0, PKY1 = 0, PKY2 = 0,
         PKY3 = 0, PKY4 = 2, PKY5 = 0, PKY6 = 0, PKY7 = 0, PHY1 = 0, PHY2 = 0, PHY3 = 0, PVY1 = 0, PVY2 = 0, PVY3 = 0,
         PVY4 = 0, PPY1 = 0, PPY2 = 0, PPY3 = 0, PPY4 = 0, PPY5 = 0;
  double RBY1 = 0, RBY2 = 0, RBY3 = 0, RBY4 = 0, RCY1 = 0, REY1 = 0, REY2 = 0, RHY1 = 0, RHY2 = 0, RVY1 = 0, RVY2 = 0,
         RVY3 = 0, RVY4 = 0, RVY5 = 0, RVY6 = 0;
  double PTY1 = 0, PTY2 = 0, PCFY1 = 0, PCFY2 = 0, PCFY3 = 0;
  // Moments: overturning, rolling resistance, aligning.
  double QSX1 = 0, QSX2 = 0, QSX3 = 0, QSX4 = 0, QSX5 = 0, QSX6 = 0, QSX7 = 0, QSX8 = 0, QSX9 = 0, QSX10 = 0, QSX11 = 0,
         QSX12 = 0, QSX13 = 0, QSX14 = 0, PPMX1 = 0;
  double QSY1 = 0, QSY2 = 0, QSY3 = 0, QSY4 = 0, QSY5 = 0, QSY6 = 0, QSY7 = 1, QSY8 = 0;
  double QBZ1 = 0, QBZ2 = 0, QBZ3 = 0, QBZ4 = 0, QBZ5 = 0, QBZ9 = 0, QBZ10 = 0, QCZ1 = 0, QDZ1 = 0, QDZ2 = 0, QDZ3 = 0,
         QDZ4 = 0, QDZ6 = 0, QDZ7 = 0, QDZ8 = 0, QDZ9 = 0, QDZ10 = 0, QDZ11 = 0, QEZ1 = 0, QEZ2 = 0, QEZ3 = 0, QEZ4 = 0,
         QEZ5 = 0, QHZ1 = 0, QHZ2 = 0, QHZ3 = 0, QHZ4 = 0, SSZ1 = 0, SSZ2 = 0, SSZ3 = 0, SSZ4 = 0, PPZ1 = 0, PPZ2 = 0;
};

}  // namespace tisserand::formats
