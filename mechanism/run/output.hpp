// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of an accepted state to one row of the results file.
#pragma once

#include <string>
#include <vector>

#include "formats/results/results.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Removes from the model the places that output.channels does not store. After that the model cannot read stored
/// states. Throws Error for a channel that names no node.
void keep_chosen_places(const formats::Scene& scene, Model& model);

/// Layout of the results file of a run of this model.
formats::ResultsLayout results_layout(const Model& model, const formats::Scene& scene);

/// Adds to `notes` the message large_output() for the rows that the scene stores from `time` on, if it is not empty.
void note_large_output(const formats::Scene& scene, const Model& model, double time, std::vector<std::string>& notes);

/// Evaluates the state and fills in the row, except its step, iterations, residual and constraint.
void fill_row(const Model& model, const State& state, Evaluation& evaluation, formats::ResultsRow& row);

}  // namespace tisserand::mechanism
