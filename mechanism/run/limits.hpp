// SPDX-License-Identifier: GPL-3.0-or-later
// Limits at which a run must end: large rotations of nodes against floating frames, and tyres at the ends of their
// roads.
#pragma once

#include <string>
#include <vector>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/run/report.hpp"

namespace tisserand::mechanism {

/// Largest angles of nodes relative to the floating frames of all superelements, over the accepted states of a run.
/// Example: a cantilever of one body bent to a circle, its end turned by φ (nodes by φ/2 against the mean frame). The
/// tip error relative to the length at φ = 0.4, 0.8 and 1.2 is 6.4e-5, 9.5e-4 and 4.3e-3 with second order. Without
/// second order it is 6.7e-3, 2.7e-2 and 5.9e-2 ([SO] 6).
class FrameAngles {
 public:
  explicit FrameAngles(const Model& model) : seen_(model.superelements.size()) {}

  /// Updates the angles after an evaluation of an accepted state. Returns the reason if the run must end, because a
  /// body with stiffening has turned beyond the range of its strain energy. Returns an empty text if the run may
  /// continue.
  std::string observe(const Model& model, const State& state, const Evaluation& evaluation);

  /// Adds a note or a warning to the report for each superelement with a large angle.
  void tell(const Model& model, RunReport& report) const;

 private:
  /// Largest angle of one superelement [rad], with its time and its node.
  struct Seen {
    double angle = 0.0;
    double time = 0.0;
    int node = 0;
  };
  std::vector<Seen> seen_;
};

/// Reason to end the run at an accepted, evaluated state: a tyre has reached an end of its road. Empty: no tyre has.
std::string off_road(const Model& model, const State& state, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
