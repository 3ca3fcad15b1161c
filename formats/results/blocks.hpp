// SPDX-License-Identifier: GPL-3.0-or-later
// Table of the data that a results file stores over time: the only place with datasets, shapes, units and channel
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

/// Dataset of a results file over T instants (T x `shape`), with access to its values in a row and the names of its
/// columns.
struct Block {
  std::string dataset;               ///< "/nodes/position"
  std::vector<std::uint64_t> shape;  ///< shape at one instant; empty: a scalar
  /// Names of the columns of a flattened row, without the dataset's name: "tip/x". An empty string for a scalar.
  std::vector<std::string> columns;
  std::vector<std::string> units;  ///< per column
  std::string unit;                ///< attribute "unit" of the dataset
  const double* (*values)(const ResultsRow&) = nullptr;
  void (*resize)(ResultsRow&, Eigen::Index items) = nullptr;  ///< resizes to `items` and sets to 0

  std::size_t width() const { return columns.size(); }
};

/// All blocks that have columns in the layout, in the order of RESULTS.md, /time first. The selection layout.channels
/// is not applied.
std::vector<Block> all_blocks(const ResultsLayout& layout);

/// Replaces the second name of a node in a channel or pattern by its stored name. For example,
/// "nodes/position/rod/end/x" becomes "nodes/position/rod/8/x".
std::string without_alias(std::string channel, const ResultsLayout& layout);

/// Blocks of /modes, whose rows are modes instead of instants.
std::vector<Block> mode_blocks(const ResultsLayout& layout);

/// Flags of the nodes that the selection layout.channels stores: all nodes, or the union of the nodes that its entries
/// name ("nodes/position/arm/tip"), by name or alias. Throws Error for an entry that selects nothing. One union serves
/// all datasets, because they share /nodes/name.
std::vector<bool> chosen_nodes(const ResultsLayout& layout, const std::string& where);

/// Fault of an entry of a selection of channels as {what, remedy}, or nothing.
std::optional<std::pair<std::string, std::string>> fault_of_selection(const std::string& entry);

/// Blocks that layout.channels selects by groups, datasets, patterns and single nodes. /time is always included. Throws
/// Error for an entry that selects nothing.
std::vector<Block> chosen_blocks(const ResultsLayout& layout, const std::string& where);

}  // namespace tisserand::formats
