// SPDX-License-Identifier: GPL-3.0-or-later
// Matrix Market files (*.mtx) with a table of rows: import and export, bit for bit.
#pragma once

#include <string>

#include <Eigen/Core>

#include "reducer/exchange/rows_table.hpp"

namespace tisserand::reducer::exchange {

/// Reads two Matrix Market files and their table of rows. The files may be in coordinate or array format, real or
/// integer, symmetric or general. Throws Error.
ReducedMatrices read_matrix_market(const TabledFiles& files);

/// Matrix Market file of a symmetric matrix A, in the format "coordinate real symmetric". It has the lower triangle
/// without zeros, column by column, with 17 digits. `comment`: text of its comment.
std::string matrix_market_text(const Eigen::MatrixXd& A, const std::string& comment);

}  // namespace tisserand::reducer::exchange
