// SPDX-License-Identifier: GPL-3.0-or-later
// Table of rows for matrix formats without row names: Matrix Market and fmx.
#pragma once

#include <string>

#include "formats/superelement/superelement.hpp"
#include "reducer/exchange/reduced_matrices.hpp"

namespace tisserand::reducer::exchange {

/// Files of matrices without row names, and the table that has them.
struct TabledFiles {
  std::string stiffness, mass, rows;
};

/// Reads a CSV table: a line "row,node,component,x,y,z", then one line per row in order. node: a name, or a number (the
/// node is then called n<number>). component: x y z rx ry rz or 1 to 6, or "mode" for an internal coordinate, whose
/// other cells may be empty. # begins a comment. The result has rows and places. Throws Error.
ReducedMatrices read_rows(const std::string& format, const TabledFiles& files);

/// Table of a superelement, positions with 17 digits.
std::string rows_text(const formats::Superelement& element);

}  // namespace tisserand::reducer::exchange
