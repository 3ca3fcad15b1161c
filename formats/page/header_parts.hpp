// Objects of the header that pages of runs and of parts have in common (formats/PAGE.md).
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/page/deformation.hpp"
#include "formats/page/page_blocks.hpp"
#include "formats/page/surface.hpp"

namespace tisserand::formats {

struct PageShape {
  const Surface& surface;  ///< without vertices: a marker
  std::string source;
  bool points = false;   ///< the vertices are drawn too
  int all_vertices = 0;  ///< before thinning
  /// Length of the scene by which a unit of stress counts in the modes, whose rows of stress follow those of
  /// displacement
  /// ([xx yy zz], [xy yz zx] per vertex); 0: there are none.
  double stress_scale = 0.0;
  std::vector<int> elements{};  ///< element of each triangle; empty: not known
};

Json shape_json(const PageShape& shape, const FewModes& few, PageBlocks& blocks);

/// Diagonal of the box about it.
double size_of(const Surface& surface);

/// Labels of length, time, angle, force, moment, stress, energy, mass.
Json units_json(const Units& units);

/// Pascal in a unit of stress; null: the units have no names.
Json pascal_json(const Units& units);

}  // namespace tisserand::formats
