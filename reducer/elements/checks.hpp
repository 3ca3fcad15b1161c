// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the mesh before assembly: shapes of elements, and springs too stiff for floating-point accuracy.
#pragma once

#include <string>
#include <vector>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Checks the shape of every element. Throws one Error with the first ten faults and their number. Returns warnings.
std::vector<std::string> check_shapes(const Mesh& mesh, const std::string& where);

/// Indices of elements whose shape check_shapes() refuses, counted through beams, then shells, then solids.
std::vector<int> faulty_elements(const Mesh& mesh);

/// Warnings about springs more than 1e8 times as stiff as the stiffest element (of about a thousand per kind):
/// round-off of such a spring hides the stiffness of the part.
std::vector<std::string> stiff_spring_doubts(const Mesh& mesh);

}  // namespace tisserand::reducer
