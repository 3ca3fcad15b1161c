// SPDX-License-Identifier: GPL-3.0-or-later
// Order in which the unknowns of bodies and joints are eliminated.
#pragma once

#include <vector>

#include "mechanism/solver/sparse_pattern.hpp"

namespace tisserand::mechanism {

/// Order of least degree of the blocks of a pattern. A block of multipliers follows at least one of the blocks of
/// coordinates that it couples. Before that its diagonal is zero, and a pivot elsewhere would destroy the order.
/// Requires a pattern with blocks.
std::vector<int> elimination_order(const SparsePattern& pattern);

}  // namespace tisserand::mechanism
