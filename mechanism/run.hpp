// What one run of an analysis owns, and what all analyses do alike: start, and rows of results.
#pragma once

#include <string>

#include "formats/results.hpp"
#include "mechanism/build_model.hpp"
#include "mechanism/simulate.hpp"
#include "mechanism/workspace.hpp"

namespace tisserand::mechanism {

struct Run {
  const formats::Scene& scene;
  const RunControl& control;
  RunReport report;
  BuiltModel built;
  Workspace workspace;

  Run(const formats::Scene& scene_to_run, const BodyFiles& files, const RunControl& run_control);
  double seconds() const { return control.clock ? control.clock() : 0.0; }
};

/// The first load, force of a spring or motion that is no number at `time`, with its formula, or empty.
std::string nonfinite_load(Run& run, double time);

/// Rank, projection and what the analysis needs to begin; notes for the report. Throws Error.
void start(Run& run);

/// Where the rows of a run go.
struct RowWriter {
  formats::ResultsRow& row;
  formats::ResultsWriter& writer;
};

/// Stores the present state.
void write_row(Run& run, const StepReport& step, double size, RowWriter& out);

}  // namespace tisserand::mechanism
