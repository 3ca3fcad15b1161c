// Sections by the names and sizes of Nastran's PBARL and PBEAML cards.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/sections/section.hpp"

namespace tisserand::reducer {

/// Number of sizes (DIM1, DIM2, ...) of a type, NSM not counted; 0 for a type that is not known. Types: ROD, TUBE,
/// TUBE2, BAR, BOX, BOX1, I, I1, CHAN, CHAN1, CHAN2, T, T1, T2, L, Z, H, HAT, CROSS, HEXA, DBOX.
int pbarl_sizes(std::string_view type);

/// The section as it is: constants about its centroid, which lies on the axis, Iyz and the shear centre included. Sizes
/// as in the figures of the public Quick Reference Guides (PBARL, PBEAML); in them yelem points up and zelem to the
/// right; which size is which agrees with the areas of pyNastran (bdf/cards/properties/bars.py). Constants are exact
/// ones of the sharp-cornered shape (formats/sections/polygon.hpp), not Nastran's formulas, whose J differs by a few
/// percent for thick walls. Throws Error{..., where, ...} for an unknown type, a wrong number of sizes or sizes that
/// contradict each other.
formats::Section pbarl_section(std::string_view type, const std::vector<double>& sizes, const std::string& where);

/// For CBAR: its axis is neutral axis and line of shear centres at once, so the eccentricity is dropped.
formats::Section on_bar_axis(formats::Section section);

/// For CBEAM: its axis runs through the shear centres; the centroid lies beside it.
formats::Section on_shear_axis(formats::Section section);

}  // namespace tisserand::reducer
