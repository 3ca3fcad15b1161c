// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a results file from coordinates.
#include "tests/reducer/recovery/stored_run.hpp"

#include "formats/results/results.hpp"

namespace tisserand::testing {

void write(const StoredRun& run, const std::string& path) {
  formats::ResultsLayout layout;
  layout.scene = "test";
  layout.producer = "tests";
  layout.units = run.units;
  layout.superelements = run.bodies;
  layout.superelement_content_ids = run.ids;
  layout.channels = {"superelements/y", "superelements/frame_position", "superelements/frame_rotation"};
  layout.simulated.analysis = "dynamics";
  const int n = static_cast<int>(run.y[0].size()), bodies = static_cast<int>(run.bodies.size());
  for (int b = 0; b <= bodies; ++b) {
    layout.modes_offset.push_back(b * n);
    layout.boundary_offset.push_back(0);
  }
  for (const std::string& body : run.bodies) {
    formats::SimulatedBody simulated;
    simulated.name = body;
    simulated.kind = "superelement";
    simulated.origin = run.origin;
    layout.simulated.bodies.push_back(simulated);
  }
  layout.simulated.node_reference.resize(3, 0);
  formats::ResultsWriter writer(path, layout);
  formats::ResultsRow row;
  row.resize(layout);
  for (std::size_t k = 0; k < run.y.size(); k += run.bodies.size()) {
    row.time = 0.1 * static_cast<double>(k / run.bodies.size());
    for (int b = 0; b < bodies; ++b) {
      row.y.segment(b * n, n) = run.y[k + static_cast<std::size_t>(b)];
      row.frame_position.col(b) = run.position;
      row.frame_rotation.col(b) << run.rotation.w(), run.rotation.x(), run.rotation.y(), run.rotation.z();
    }
    writer.append(row);
  }
  writer.finish(true, "", "{}");
}

}  // namespace tisserand::testing
