// SPDX-License-Identifier: GPL-3.0-or-later
// Choice of the curves of a page.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formats/page/page_blocks.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

struct PageChannels {
  formats::Json list = formats::Json::array();
  formats::Json left_out;            ///< {"count", "why"}, or null
  std::map<std::string, int> index;  ///< index in `list` by path

  /// Index of a path in `list`; −1: the page does not hold it.
  int find(const std::string& path) const;
};

/// Adds the selected channels, as formats::select_channels(). For an empty selection whole datasets, energies and
/// joints first, as long as the page holds at most `most_values` numbers. One block per group.
PageChannels add_channels(const ViewedRun& run, const std::vector<std::string>& selection, std::size_t most_values,
                          formats::PageBlocks& blocks);

}  // namespace tisserand::mechanism
