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

/// Sums of the energy balance over a run until a stored instant; 0 if they were not stored.
struct StoredSums {
  double work = 0.0;
  double dissipated = 0.0;
  double initial_energy = 0.0;
  std::size_t row = 0;  ///< index of the row of the instant
};

/// Reads a state from the results `file` at the stored instant `at` (absent: the last one). The state gets positions,
/// velocities, internal coordinates and their rates, floating frames and unwrapped angles. Returns the sums of the
/// energy balance until then. Throws Error for an instant that is not stored, and for names that the scene does not
/// have. It also throws for channels of `nodes`, `superelements` or `joints/coordinate` that were not stored.
StoredSums read_stored_state(const Model& model, const std::string& file, const std::optional<double>& at, State& state,
                             Workspace& workspace);

}  // namespace tisserand::mechanism
