// SPDX-License-Identifier: GPL-3.0-or-later
// The group /scene of a results file.
#pragma once

#include <cstddef>

#include "formats/hdf5/file.hpp"
#include "formats/results/simulated_scene.hpp"

namespace tisserand::formats {

/// Writes the group /scene, or nothing if `scene` is empty.
void write_simulated(const hdf5::Output& out, const SimulatedScene& scene);

/// Reads the group /scene. The result is empty if the file has none (before version 1.5). Throws Error if shapes or
/// indices do not fit. `nodes`: number of stored nodes.
SimulatedScene read_simulated(const hdf5::InputFile& file, std::size_t nodes);

}  // namespace tisserand::formats
