// SPDX-License-Identifier: GPL-3.0-or-later
// Names and offsets of the columns of a results file, written to and read from the file.
#pragma once

#include <vector>

#include "formats/hdf5/file.hpp"
#include "formats/results/blocks.hpp"

namespace tisserand::formats {

/// Writes the names and offsets of columns for each group of which `blocks` has a dataset. Throws Error.
void write_names(const hdf5::Output& out, const ResultsLayout& layout, const std::vector<Block>& blocks);

/// Writes names and aliases of nodes. Files of modes require them even without node datasets over time. Throws Error.
void write_node_names(const hdf5::Output& out, const ResultsLayout& layout);

/// Reads the layout of a file, with the simulated scene. Throws Error.
ResultsLayout read_layout(const hdf5::InputFile& file);

}  // namespace tisserand::formats
