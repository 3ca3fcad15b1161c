// SPDX-License-Identifier: GPL-3.0-or-later
// Table of rows for matrix formats without row names: Matrix Market and fmx.
#pragma once

#include <string>

#include "formats/superelement/superelement.hpp"
#include "reducer/exchange/reduced_matrices.hpp"

namespace tisserand::reducer::exchange {

/// Files of two matrices without row names, and of the table that names the rows.
struct TabledFiles {
  std::string stiffness, mass, rows;
};

/// Reads the table of rows, a CSV file, and returns rows and places without the matrices. The first line is
/// "row,node,component,x,y,z"; one line per row follows in order. `node` is a name, or a number (the node is then
/// called n<number>). `component` is x y z rx ry rz or 1 to 6, or "mode" for an internal coordinate, whose other cells
/// may be empty. # begins a comment. Throws Error.
ReducedMatrices read_rows(const std::string& format, const TabledFiles& files);

/// Table of rows of a superelement as CSV, with positions of 17 digits.
std::string rows_text(const formats::Superelement& element);

}  // namespace tisserand::reducer::exchange
