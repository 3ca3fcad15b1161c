// Why a run must end where it stands: nodes of superelements that turn far against their floating frames, tyres at the
// ends of their roads.
#pragma once

#include <string>
#include <vector>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/run/report.hpp"

namespace tisserand::mechanism {

/// Largest angles of all superelements over the accepted states of a run. Of a cantilever of one body bent to a circle,
/// turned by φ at its end (so that its nodes turn by φ/2 against the mean frame), the tip errs by 6.4e-5 of the length
/// at φ = 0.4, 9.5e-4 at 0.8 and 4.3e-3 at 1.2 with second order; without, by 6.7e-3, 2.6e-2 and 5.9e-2
/// (docs/MECHANISM_VERIFICATION.md, "Second order: error over angle and deflection").
class FrameAngles {
 public:
  explicit FrameAngles(const Model& model) : seen_(model.superelements.size()) {}

  /// After an evaluation of an accepted state. Returns why the run must end: a body with stiffening has turned beyond
  /// where its energy means anything; or nothing.
  std::string observe(const Model& model, const State& state, const Evaluation& evaluation);

  /// Adds a note or a doubt for each superelement that has turned far.
  void tell(const Model& model, RunReport& report) const;

 private:
  struct Seen {
    double angle = 0.0;
    double time = 0.0;
    int node = 0;
  };
  std::vector<Seen> seen_;
};

/// After an evaluation of an accepted state: why the run must end, since a tyre has come to an end of its road; or
/// nothing.
std::string off_road(const Model& model, const State& state, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
