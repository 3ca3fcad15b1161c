// `mechanism view`: from results files to one page that any browser opens.
#pragma once

#include <string>

#include "mechanism/histories/series.hpp"
#include "mechanism/view/run_header.hpp"

namespace tisserand::mechanism {

struct ViewRequest {
  SeriesRequest shown;  ///< results files, labels of the runs, curves (empty: what fits), references
  std::string output;   ///< .html
  std::string title;    ///< empty: names of the scenes
  int instants = 2001;  ///< the most per run: 2000 steps
  ShapeOptions shapes;
};

/// The page as text.
std::string page_of(const ViewRequest& request);

/// Writes it: whole or not at all. Returns what a user should know, one sentence per line: size, what was thinned or
/// left out. Throws Error.
std::string view(const ViewRequest& request);

}  // namespace tisserand::mechanism
