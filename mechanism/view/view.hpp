// SPDX-License-Identifier: GPL-3.0-or-later
// `mechanism view`: one page from results files that any browser opens.
#pragma once

#include <string>

#include "mechanism/histories/series.hpp"
#include "mechanism/view/run_header.hpp"

namespace tisserand::mechanism {

/// Request for a page: runs, curves, shapes and the output file.
struct ViewRequest {
  SeriesRequest shown;  ///< results files, labels of the runs, curves (empty: as many as fit), references
  std::string output;   ///< path that ends in .html
  std::string title;    ///< title of the page; empty: names of the scenes
  int instants = 2001;  ///< largest number of instants per run: 2000 steps
  ShapeOptions shapes;
};

/// Page of the runs as HTML text. Throws Error.
std::string page_of(const ViewRequest& request);

/// Writes the page of the runs, completely or not at all. Returns messages for the user, one sentence per line: size,
/// what was thinned or omitted. Throws Error.
std::string view(const ViewRequest& request);

}  // namespace tisserand::mechanism
