// SPDX-License-Identifier: GPL-3.0-or-later
// What a shell problem is meshed with: the kind of element and a number that refines.
#pragma once

namespace tisserand::reducer {

enum class Facets { quadrilaterals, triangles };

/// `n` multiplies the cells of the coarsest grid of a problem; triangles halve the cells.
struct ShellMesh {
  Facets facets = Facets::quadrilaterals;
  int n = 1;
};

}  // namespace tisserand::reducer
