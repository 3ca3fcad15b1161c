// SPDX-License-Identifier: GPL-3.0-or-later
// FEDEM's binary files of reduced matrices (*.fmx): import and export, bit for bit.
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

#include "reducer/exchange/rows_table.hpp"

namespace tisserand::reducer::exchange {

/// Matrices of ..._S.fmx, ..._M.fmx and the table of rows. Throws Error.
ReducedMatrices read_fmx(const TabledFiles& files);

enum class FmxKind { stiffness, mass, gravity };

/// Bytes of a file: tag of 30 characters "#FEDEM stiffness matrix", and the 16-bit number 0x1234 that shows the byte
/// order. Then two 32-bit numbers 0 and `checksum`, the line ";1.0;", and the values column by column.
std::string fmx_bytes(FmxKind kind, std::uint32_t checksum, const Eigen::MatrixXd& values);

}  // namespace tisserand::reducer::exchange
