// SPDX-License-Identifier: GPL-3.0-or-later
// One run as an object of the page's header (formats/PAGE.md).
#pragma once

#include <string>
#include <vector>

#include "formats/page/page_blocks.hpp"
#include "mechanism/view/body_shape.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

/// Options of a run in a page.
struct RunOptions {
  std::vector<std::string> channels;  ///< selected channels; empty: as many as fit
  ShapeOptions shapes;
};

/// JSON object of a run in the header of a page (formats/PAGE.md). Adds its numbers to `blocks`. Throws Error for
/// unknown channels and wrong shape files.
formats::Json run_header(ViewedRun& run, const RunOptions& options, formats::PageBlocks& blocks);

}  // namespace tisserand::mechanism
