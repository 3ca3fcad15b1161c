// The table of what a results file stores over time: the one place that knows datasets, shapes, units and channel
// names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/results/results.hpp"

namespace tisserand::formats {

/// One dataset over time, shape T x `shape`: where its values stand in a row, and what its columns are called.
struct Block {
  std::string dataset;               ///< "/nodes/position"
  std::vector<std::uint64_t> shape;  ///< of one instant; empty: a scalar
  std::vector<std::string> columns;  ///< names of the flat columns after "nodes/position/", empty string for a scalar
  std::vector<std::string> units;    ///< per column
  std::string unit;                  ///< attribute "unit" of the dataset
  const double* (*values)(const ResultsRow&) = nullptr;
  void (*resize)(ResultsRow&, Eigen::Index items) = nullptr;  ///< gives them room, and sets them to 0

  std::size_t width() const { return columns.size(); }
};

/// All blocks that the layout has columns for, in the order of RESULTS.md, /time first; the selection is not applied.
std::vector<Block> all_blocks(const ResultsLayout& layout);

/// "nodes/position/rod/end/x" -> "nodes/position/rod/8/x": a node that has two names is stored once. Also of patterns.
std::string without_alias(std::string channel, const ResultsLayout& layout);

/// Those of /modes, whose rows are modes and no instants.
std::vector<Block> mode_blocks(const ResultsLayout& layout);

/// Which nodes the selection layout.channels stores: all, or, where entries name single ones
/// ("nodes/position/arm/tip"), the union of these; an entry means a node by either of its names. Throws Error for an
/// entry that means none. One union for all datasets, because they share /nodes/name.
std::vector<bool> chosen_nodes(const ResultsLayout& layout, const std::string& where);

/// Finds out what is wrong with an entry of a selection, or nothing: {what, remedy}.
std::optional<std::pair<std::string, std::string>> fault_of_selection(const std::string& entry);

/// Those that layout.channels chooses (groups, datasets, patterns, single nodes), always with /time. Throws Error for
/// an entry that means none.
std::vector<Block> chosen_blocks(const ResultsLayout& layout, const std::string& where);

}  // namespace tisserand::formats
