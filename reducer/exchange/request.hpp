// SPDX-License-Identifier: GPL-3.0-or-later
// Arguments of import and export on the command line.
#pragma once

#include <string>

namespace tisserand::reducer::exchange {

/// Arguments of `reducer import`.
struct ImportRequest {
  std::string input;
  std::string output;     ///< empty: next to the input
  std::string from;       ///< format: dmig, abaqus, calculix, matrixmarket, fmx; empty: recognised from the content
  std::string units;      ///< units of the file: "mm,t,s" or "consistent"
  std::string matrices;   ///< names of the DMIG matrices: "KAAX,MAAX"
  std::string mass;       ///< file of the mass matrix
  std::string rows;       ///< table of rows
  std::string positions;  ///< file of positions
  std::string names;      ///< names of nodes: "101=base,102=tip"
  std::string modal;      ///< nodes whose rows are internal coordinates: "1001-1008,2000"
};

/// Arguments of `reducer export`.
struct ExportRequest {
  std::string input;
  std::string output;  ///< empty: next to the input
  std::string to;      ///< format: dmig, matrixmarket, fmx, mbdyn
};

/// Imports matrices: reads and checks them, writes the superelement and its certificate, and prints a report. Throws
/// Error.
void import_matrices(const ImportRequest& request);

/// Exports a superelement: reads it, writes files of the other program, and prints what they hold. Throws Error.
void export_matrices(const ExportRequest& request);

}  // namespace tisserand::reducer::exchange
