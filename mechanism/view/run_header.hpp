// SPDX-License-Identifier: GPL-3.0-or-later
// One run as an object of the page's header (formats/PAGE.md).
#pragma once

#include <string>
#include <vector>

#include "formats/page/page_blocks.hpp"
#include "mechanism/view/body_shape.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

struct RunOptions {
  std::vector<std::string> channels;  ///< selection; empty: as many as fit
  ShapeOptions shapes;
};

/// Object of a run. Its numbers go to `blocks`. Throws Error: unknown channels, wrong shape files.
formats::Json run_header(ViewedRun& run, const RunOptions& options, formats::PageBlocks& blocks);

}  // namespace tisserand::mechanism
