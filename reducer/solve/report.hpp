// SPDX-License-Identifier: GPL-3.0-or-later
// Report on a solution for the terminal.
#pragma once

#include <string>

#include "reducer/solve/solve.hpp"

namespace tisserand::reducer {

/// Resultant [force; moment about `point`] that the support `support` exerts on the part. `support`: index in
/// Mesh::supports; −1 means all supports.
Eigen::Matrix<double, 6, 1> reaction_of(const Solution& solution, int support, Eigen::Index load_case,
                                        const Eigen::Vector3d& point);

/// Largest imbalance |applied + reactions| of forces and moments, relative to the size of the load.
double imbalance(const Solution& solution, Eigen::Index load_case);

/// Report on a solution for the terminal: the part, its supports, every load case with its largest values, reactions
/// and equilibrium, and the modes.
std::string solution_text(const Solution& solution, const formats::Part& part);

}  // namespace tisserand::reducer
