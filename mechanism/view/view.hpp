// SPDX-License-Identifier: GPL-3.0-or-later
// `mechanism view`: one page from results files that any browser opens.
#pragma once

#include <string>

#include "mechanism/histories/series.hpp"
#include "mechanism/view/run_header.hpp"

namespace tisserand::mechanism {

struct ViewRequest {
  SeriesRequest shown;  ///< results files, labels of the runs, curves (empty: as many as fit), references
  std::string output;   ///< .html
  std::string title;    ///< empty: names of the scenes
  int instants = 2001;  ///< largest number per run: 2000 steps
  ShapeOptions shapes;
};

/// Page as text. Throws Error.
std::string page_of(const ViewRequest& request);

/// Writes the page, completely or not at all. Returns messages for the user, one sentence per line: size, what was
/// thinned or omitted. Throws Error.
std::string view(const ViewRequest& request);

}  // namespace tisserand::mechanism
