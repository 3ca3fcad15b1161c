// Short pieces of road ahead of wheels, which a step must not pass over.
#pragma once

#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Marks along roads: the edges and quarters of their bumps, the feet, tops and middles of their ramps, the corners of
/// their tables. They bound steps whose size an error decides, as breakpoints do: such an error is measured where the
/// step ends, and a step from the flat before a bump to the flat behind it has none.
class RoadAhead {
 public:
  RoadAhead(const formats::Scene& scene, const Model& model);

  bool has_marks() const { return any_; }

  /// Time until a wheel reaches its next mark at its present speed, infinite if none is ahead. What is nearer than a
  /// hundredth of `step` counts as reached.
  double time_to_next(const Model& model, const Evaluation& evaluation, double step) const;

 private:
  std::vector<std::vector<double>> marks_;  ///< of each road, ascending x
  bool any_ = false;
};

}  // namespace tisserand::mechanism
