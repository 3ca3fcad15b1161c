// SPDX-License-Identifier: GPL-3.0-or-later
// Matrix Market files (*.mtx) with a table of rows: import and export, bit for bit.
#pragma once

#include <string>

#include <Eigen/Core>

#include "reducer/exchange/rows_table.hpp"

namespace tisserand::reducer::exchange {

/// Reads coordinate and array files, real or integer, symmetric or general, and the table of rows. Throws Error.
ReducedMatrices read_matrix_market(const TabledFiles& files);

/// Coordinate, real, symmetric format: the lower triangle without zeros, column by column, 17 digits.
std::string matrix_market_text(const Eigen::MatrixXd& A, const std::string& comment);

}  // namespace tisserand::reducer::exchange
