// SPDX-License-Identifier: GPL-3.0-or-later
// Objects of the header that pages of runs and pages of parts share (formats/PAGE.md).
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/page/deformation.hpp"
#include "formats/page/page_blocks.hpp"
#include "formats/page/surface.hpp"

namespace tisserand::formats {

/// Shape of a body as the header of a page describes it.
struct PageShape {
  const Surface& surface;  ///< without vertices: a marker
  std::string source;
  bool points = false;   ///< whether the vertices are drawn too
  int all_vertices = 0;  ///< number of vertices before thinning
  /// Length that represents a unit of stress in the modes; 0: no stress. With stress, rows of stress ([xx yy zz], [xy
  /// yz zx] per vertex) follow the rows of displacement.
  double stress_scale = 0.0;
  std::vector<int> elements{};  ///< element of each triangle; empty: unknown
};

Json shape_json(const PageShape& shape, const FewModes& few, PageBlocks& blocks);

/// Length of the diagonal of the surface's bounding box.
double size_of(const Surface& surface);

/// Unit labels of length, time, angle, force, moment, stress, energy and mass.
Json units_json(const Units& units);

/// Pascals per unit of stress; null if the units have no names.
Json pascal_json(const Units& units);

}  // namespace tisserand::formats
