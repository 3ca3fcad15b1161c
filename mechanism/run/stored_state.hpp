// SPDX-License-Identifier: GPL-3.0-or-later
// State of a scene from one instant of its results file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Sums over the run until then, for the energy balance; 0 if they were not stored.
struct StoredSums {
  double work = 0.0;
  double dissipated = 0.0;
  double initial_energy = 0.0;
  std::size_t row = 0;  ///< row of the instant
};

/// Reads positions, velocities, internal coordinates and their rates, floating frames and unwrapped angles at the
/// stored instant `at` (absent: the last). Throws Error: no such instant, channels of `nodes`, `superelements` or
/// `joints/coordinate` that were not stored, names that the scene does not have.
StoredSums read_stored_state(const Model& model, const std::string& file, const std::optional<double>& at, State& state,
                             Workspace& workspace);

}  // namespace tisserand::mechanism
