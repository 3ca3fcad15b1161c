// SPDX-License-Identifier: GPL-3.0-or-later
// Sections by the names and sizes of Nastran's PBARL and PBEAML cards.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/sections/section.hpp"

namespace tisserand::reducer {

/// Number of sizes (DIM1, DIM2, ...) of a section type of PBARL, without NSM; 0 for an unknown type. Types: ROD, TUBE,
/// TUBE2, BAR, BOX, BOX1, I, I1, CHAN, CHAN1, CHAN2, T, T1, T2, L, Z, H, HAT, CROSS, HEXA, DBOX.
int pbarl_sizes(std::string_view type);

/// Section of a PBARL or PBEAML type, with constants about its centroid, which lies on the axis. Iyz and the shear
/// centre are included. `sizes`: those of the figures of the public Quick Reference Guides (PBARL, PBEAML), in which
/// yelem points up and zelem to the right. Their meaning agrees with the areas of pyNastran
/// (bdf/cards/properties/bars.py). The constants are exact for the sharp-cornered shape
/// (formats/sections/polygon.hpp). Nastran's formulas give a J that differs by a few percent for thick walls. Throws
/// Error for an unknown type, a wrong number of sizes or contradictory sizes.
formats::Section pbarl_section(std::string_view type, const std::vector<double>& sizes, const std::string& where);

/// Section for a CBAR, whose axis is both neutral axis and line of shear centres. The distance between centroid and
/// shear centre is dropped.
formats::Section on_bar_axis(formats::Section section);

/// Section for a CBEAM, whose axis runs through the shear centres. The centroid has an offset from this axis.
formats::Section on_shear_axis(formats::Section section);

}  // namespace tisserand::reducer
