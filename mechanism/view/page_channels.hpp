// SPDX-License-Identifier: GPL-3.0-or-later
// Choice of the curves of a page.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formats/page/page_blocks.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

/// Channels of a run whose curves a page holds.
struct PageChannels {
  formats::Json list = formats::Json::array();
  /// Number of omitted channels and the reason, {"count", "why"}, or null.
  formats::Json left_out;
  std::map<std::string, int> index;  ///< index in `list` by path

  /// Index of the channel `path` in `list`; −1: the page does not hold it.
  int find(const std::string& path) const;
};

/// Adds the selected channels of the run to `blocks`, one block per group. `selection`: patterns of
/// formats::select_channels(). For an empty selection it adds whole datasets, energies and joints first, as long as the
/// page holds at most `most_values` numbers.
PageChannels add_channels(const ViewedRun& run, const std::vector<std::string>& selection, std::size_t most_values,
                          formats::PageBlocks& blocks);

}  // namespace tisserand::mechanism
