// SPDX-License-Identifier: GPL-3.0-or-later
// Files of a solution: values of named points, and the mesh with displacements and stresses for ParaView.
#pragma once

#include <string>
#include <vector>

#include "reducer/solve/solve.hpp"

namespace tisserand::reducer {

/// Paths of the files: stem.csv, stem.CASE.vtu for each load case, stem-modes.vtu if modes are requested; for buckling
/// stem-buckling.csv, stem-buckling.html, and stem-buckling.CASE.vtu for each load case.
std::vector<std::string> solution_files(const std::string& stem, const formats::Part& part,
                                        const SolveRequest& request);

/// Table with lines `case,point,ux,uy,uz,rx,ry,rz` for every load case, mode (mode_1, ...) and buckling shape
/// (CASE-buckling_1, ...), part axes. Points: boundary nodes, points and spiders that are nodes, and requested points.
/// Throws Error for requested points that do not exist.
std::string solution_table(const Solution& solution, const formats::Part& part, const SolveRequest& request);

/// Table with lines `case,mode,load_factor`; the factor of the reversed load is negative, its mode `reversed`.
std::string buckling_table(const Solution& solution);

/// HTML page on which the part moves in every buckling shape.
std::string buckling_page(const Solution& solution, const formats::Part& part);

/// Writes the files of solution_files(). Shapes of modes are scaled to a largest displacement of 1.
void write_solution(const Solution& solution, const formats::Part& part, const SolveRequest& request,
                    const std::string& stem);

}  // namespace tisserand::reducer
