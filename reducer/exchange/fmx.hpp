// SPDX-License-Identifier: GPL-3.0-or-later
// FEDEM's binary files of reduced matrices (*.fmx): import and export, bit for bit.
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

#include "reducer/exchange/rows_table.hpp"

namespace tisserand::reducer::exchange {

/// Reads the matrices of the files ..._S.fmx and ..._M.fmx, and their table of rows. Throws Error.
ReducedMatrices read_fmx(const TabledFiles& files);

enum class FmxKind { stiffness, mass, gravity };

/// Bytes of a fmx file. They are a tag of 30 characters such as "#FEDEM stiffness matrix", and the 16-bit number
/// 0x1234, which shows the byte order. Then two 32-bit numbers 0 and `checksum`, the line ";1.0;", and the values
/// column by column follow.
std::string fmx_bytes(FmxKind kind, std::uint32_t checksum, const Eigen::MatrixXd& values);

}  // namespace tisserand::reducer::exchange
