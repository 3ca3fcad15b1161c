// SPDX-License-Identifier: GPL-3.0-or-later
// Arguments of import and export on the command line.
#pragma once

#include <string>

namespace tisserand::reducer::exchange {

struct ImportRequest {
  std::string input;
  std::string output;     ///< empty: next to the input
  std::string from;       ///< dmig, abaqus, calculix, matrixmarket, fmx; empty: from the content
  std::string units;      ///< "mm,t,s" or "consistent"
  std::string matrices;   ///< DMIG names: "KAAX,MAAX"
  std::string mass;       ///< file of the mass matrix
  std::string rows;       ///< table of rows
  std::string positions;  ///< file of positions
  std::string names;      ///< "101=base,102=tip"
  std::string modal;      ///< "1001-1008,2000"
};

struct ExportRequest {
  std::string input;
  std::string output;  ///< empty: next to the input
  std::string to;      ///< dmig, matrixmarket, fmx, mbdyn
};

/// Reads and checks matrices, writes the superelement and its certificate, and prints a report. Throws Error.
void import_matrices(const ImportRequest& request);

/// Reads a superelement, writes files of the other program, and prints their contents. Throws Error.
void export_matrices(const ExportRequest& request);

}  // namespace tisserand::reducer::exchange
