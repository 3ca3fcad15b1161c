// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of the mesh before assembly: shapes of elements, and springs too stiff for floating-point accuracy.
#pragma once

#include <string>
#include <vector>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Checks the shape of every element of the mesh. Throws one Error with the first ten faults and the number of all
/// faults. Returns the first ten warnings and, if there are more, their number. `where`: place for the message of the
/// Error.
std::vector<std::string> check_shapes(const Mesh& mesh, const std::string& where);

/// Indices of the elements with faults that check_shapes() refuses. The index counts all beams, then all shells, then
/// all solids.
std::vector<int> faulty_elements(const Mesh& mesh);

/// Warnings about springs that are more than 1e8 times as stiff as the stiffest element. Round-off of such a spring
/// hides the stiffness of the part. About a thousand elements of each kind are compared.
std::vector<std::string> stiff_spring_doubts(const Mesh& mesh);

}  // namespace tisserand::reducer
