// Which curves a page holds.
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
  std::map<std::string, int> index;  ///< of `list`, by path

  /// −1: the page does not hold it.
  int find(const std::string& path) const;
};

/// Channels that the selection means, as formats::select_channels(); of an empty one whole datasets, energies and
/// joints first, until the page would hold more than `most_values` numbers. One block per group.
PageChannels add_channels(const ViewedRun& run, const std::vector<std::string>& selection, std::size_t most_values,
                          formats::PageBlocks& blocks);

}  // namespace tisserand::mechanism
