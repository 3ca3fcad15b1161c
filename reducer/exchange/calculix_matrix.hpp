// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices that CalculiX stores with *FREQUENCY, SOLVER=MATRIXSTORAGE: job.sti, job.mas and job.dof.
#pragma once

#include <string>

#include "reducer/exchange/reduced_matrices.hpp"

namespace tisserand::reducer::exchange {

/// `stiffness` is job.sti; job.mas and job.dof are in the same folder. Lines "row column value", one triangle; lines
/// "node.direction", one per row. Places are empty. Throws Error.
ReducedMatrices read_calculix_matrices(const std::string& stiffness, const std::set<long>& modal);

}  // namespace tisserand::reducer::exchange
