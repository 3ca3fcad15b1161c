// SPDX-License-Identifier: GPL-3.0-or-later
// Report on a solution for the terminal.
#pragma once

#include <string>

#include "reducer/solve/solve.hpp"

namespace tisserand::reducer {

/// [force; moment about `point`] of the supports `support` on the part (index in Mesh::supports; −1: all).
Eigen::Matrix<double, 6, 1> reaction_of(const Solution& solution, int support, Eigen::Index load_case,
                                        const Eigen::Vector3d& point);

/// Largest of |applied + reactions|, forces and moments, relative to the size of the load.
double imbalance(const Solution& solution, Eigen::Index load_case);

/// Report: the part, its supports, every load case with its largest values, reactions and equilibrium, the modes.
std::string solution_text(const Solution& solution, const formats::Part& part);

}  // namespace tisserand::reducer
