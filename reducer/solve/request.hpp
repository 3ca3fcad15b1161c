// SPDX-License-Identifier: GPL-3.0-or-later
// Arguments of `reducer solve` on the command line, except the part.
#pragma once

#include <string>
#include <vector>

namespace tisserand::reducer {

/// Arguments of `reducer solve`.
struct SolveRequest {
  int modes = 0;                    ///< number of requested modes of the supported part, lowest first
  std::vector<std::string> points;  ///< further nodes of the table: labels, or "x,y,z" of the part frame
  int buckling = 0;                 ///< number of requested load factors per load case, lowest first
};

}  // namespace tisserand::reducer
