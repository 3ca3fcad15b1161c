// The small table that names the rows of matrices which cannot do it themselves: Matrix Market and fmx.
#pragma once

#include <string>

#include "formats/superelement/superelement.hpp"
#include "reducer/exchange/reduced_matrices.hpp"

namespace tisserand::reducer::exchange {

/// Files of matrices that cannot name their rows, and of the table that does.
struct TabledFiles {
  std::string stiffness, mass, rows;
};

/// CSV: a line "row,node,component,x,y,z", then one line for each row in order. node: a name, or a number (the node is
/// then called n<number>); component: x y z rx ry rz or 1 to 6; "mode" for an internal coordinate, whose other cells
/// may stay empty. # begins a comment. Gives rows and places. Throws Error.
ReducedMatrices read_rows(const std::string& format, const TabledFiles& files);

/// The table of a superelement, positions with 17 digits.
std::string rows_text(const formats::Superelement& element);

}  // namespace tisserand::reducer::exchange
