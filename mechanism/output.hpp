// From the accepted state to one row of the results file.
#pragma once

#include <string>

#include "formats/results.hpp"
#include "formats/scene.hpp"
#include "mechanism/model.hpp"
#include "mechanism/state.hpp"
#include "mechanism/workspace.hpp"

namespace tisserand::mechanism {

formats::ResultsLayout results_layout(const Model& model, const formats::Scene& scene);

/// Evaluates the state and fills all but step, iterations, residual and constraint.
void fill_row(const Model& model, const State& state, Workspace& workspace, formats::ResultsRow& row);

}  // namespace tisserand::mechanism
