// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices that CalculiX stores with *FREQUENCY, SOLVER=MATRIXSTORAGE: job.sti, job.mas and job.dof.
#pragma once

#include <string>

#include "reducer/exchange/reduced_matrices.hpp"

namespace tisserand::reducer::exchange {

/// Reads the matrices that CalculiX has stored. `stiffness`: path of job.sti; job.mas and job.dof must be in the same
/// folder. The matrices have lines "row column value" for one triangle, job.dof has a line "node.direction" for each
/// row. `modal`: nodes whose rows are internal coordinates. The result has no places of nodes. Throws Error.
ReducedMatrices read_calculix_matrices(const std::string& stiffness, const std::set<long>& modal);

}  // namespace tisserand::reducer::exchange
