// SPDX-License-Identifier: GPL-3.0-or-later
// Nastran DMIG cards, the punch form of reduced matrices: import and export.
#pragma once

#include <string>

#include "formats/superelement/superelement.hpp"
#include "reducer/exchange/reduced_matrices.hpp"

namespace tisserand::reducer::exchange {

/// Files and matrix names from which DMIG matrices are read.
struct DmigSource {
  std::string path;
  std::string positions;  ///< second file, with GRID and CORD cards; may be empty
  std::string stiffness = "KAAX";
  std::string mass = "MAAX";
};

/// Reads two matrices from DMIG cards (IFO 1 or 6, TIN 1 or 2; small, large and free field), with GRID and coordinate
/// systems, SPOINT and EPOINT. If the files have no SPOINT and EPOINT, a point with component 0 that is no GRID is a
/// scalar point. Throws Error.
ReducedMatrices read_dmig(const DmigSource& source);

/// Nastran bulk data of a superelement: GRID (numbers 1, 2, ...), SPOINT (from 1000001), ASET1, and DMIG KAAX and MAAX
/// with IFO 6, TIN 2, large field. A value has as many digits as 16 characters hold, 11 to 14 (for exponents of up to
/// two digits).
std::string dmig_text(const formats::Superelement& element);

/// Text of `value` in at most 16 characters, with the exponent letter `letter` (E or D). The letter is omitted
/// (1.5-10) if that saves a digit.
std::string real_field(double value, char letter);

}  // namespace tisserand::reducer::exchange
