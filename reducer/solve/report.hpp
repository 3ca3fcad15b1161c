// What a solution tells on the terminal.
#pragma once

#include <string>

#include "reducer/solve/solve.hpp"

namespace tisserand::reducer {

/// [force; moment about `point`] that the supports `support` (row of Mesh::supports; −1: all) put on the part.
Eigen::Matrix<double, 6, 1> reaction_of(const Solution& solution, int support, Eigen::Index load_case,
                                        const Eigen::Vector3d& point);

/// Largest of |applied + reactions|, forces and moments, over the size of the load.
double imbalance(const Solution& solution, Eigen::Index load_case);

/// The part, its supports, every load case with its largest values, reactions and equilibrium, the modes.
std::string solution_text(const Solution& solution, const formats::Part& part);

}  // namespace tisserand::reducer
