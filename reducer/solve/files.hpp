// SPDX-License-Identifier: GPL-3.0-or-later
// Files of a solution: values of named points, and the mesh with displacements and stresses for ParaView.
#pragma once

#include <string>
#include <vector>

#include "reducer/solve/solve.hpp"

namespace tisserand::reducer {

/// Paths of the files of a solution: stem.csv, stem.CASE.vtu for each load case, and stem-modes.vtu if modes are
/// requested. Buckling adds stem-buckling.csv, stem-buckling.html, and stem-buckling.CASE.vtu for each load case.
std::vector<std::string> solution_files(const std::string& stem, const formats::Part& part,
                                        const SolveRequest& request);

/// Table of displacements at named points, with lines `case,point,ux,uy,uz,rx,ry,rz` in part axes. It has every load
/// case, mode (mode_1, ...) and buckling shape (CASE-buckling_1, ...). The points are boundary nodes, points and
/// spiders that are nodes, and requested points. Throws Error for requested points that do not exist.
std::string solution_table(const Solution& solution, const formats::Part& part, const SolveRequest& request);

/// Table of buckling factors with lines `case,mode,load_factor`. The line of the reversed load has a negative factor
/// and the mode `reversed`.
std::string buckling_table(const Solution& solution);

/// HTML page that shows the motion of the part in every buckling shape.
std::string buckling_page(const Solution& solution, const formats::Part& part);

/// Writes the files that solution_files() names. Shapes of modes are scaled to a largest displacement of 1.
void write_solution(const Solution& solution, const formats::Part& part, const SolveRequest& request,
                    const std::string& stem);

}  // namespace tisserand::reducer
