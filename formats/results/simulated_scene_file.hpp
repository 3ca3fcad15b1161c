// The group /scene of a results file.
#pragma once

#include <cstddef>

#include "formats/hdf5/file.hpp"
#include "formats/results/simulated_scene.hpp"

namespace tisserand::formats {

/// Writes nothing of an empty one.
void write_simulated(const hdf5::Output& out, const SimulatedScene& scene);

/// Empty where the file holds none (before version 1.5). Throws Error: shapes and indices that do not fit.
SimulatedScene read_simulated(const hdf5::InputFile& file, std::size_t nodes);

}  // namespace tisserand::formats
