// What a results file says of the columns of its datasets, to and from the file.
#pragma once

#include <vector>

#include "formats/hdf5/file.hpp"
#include "formats/results/blocks.hpp"

namespace tisserand::formats {

/// Names and offsets of each group of which any dataset is stored. Throws Error.
void write_names(const hdf5::Output& out, const ResultsLayout& layout, const std::vector<Block>& blocks);

/// Names of nodes and their other names, which files of modes also need where they store no motion. Throws Error.
void write_node_names(const hdf5::Output& out, const ResultsLayout& layout);

/// All that a file says of its layout, and of the scene that was simulated. Throws Error.
ResultsLayout read_layout(const hdf5::InputFile& file);

}  // namespace tisserand::formats
