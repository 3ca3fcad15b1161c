// SPDX-License-Identifier: GPL-3.0-or-later
// Short pieces of road ahead of wheels, over which a step must not pass.
#pragma once

#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Marks along roads, over which a step with error control must not pass: edges and quarters of bumps, feet, tops and
/// middles of ramps, corners of tables. They bound steps as breakpoints do. The error is measured at the end of a step,
/// so a step over a whole bump, from flat to flat, would show none.
class RoadAhead {
 public:
  RoadAhead(const formats::Scene& scene, const Model& model);

  bool has_marks() const { return any_; }

  /// Time until a wheel reaches its next mark at its present speed, infinite if none is ahead. Marks nearer than a
  /// hundredth of `step` count as reached.
  double time_to_next(const Model& model, const Evaluation& evaluation, double step) const;

 private:
  std::vector<std::vector<double>> marks_;  ///< x of the marks of each road, ascending
  bool any_ = false;
};

}  // namespace tisserand::mechanism
