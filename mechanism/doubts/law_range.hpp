// Whether nonlinear beams and bushings stay within what their laws represent.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Largest relative rotation between neighbouring nodes of a beam element, and largest stretch of an element, over the run.
class BeamRange {
 public:
  explicit BeamRange(const Model& model);

  /// At an evaluated state; some twenty flops per element.
  void observe(const State& state, const Evaluation& evaluation);

  /// At most two lines: the element that turns most and the one that stretches most.
  std::vector<std::string> doubts(const Model& model) const;

 private:
  /// Two neighbouring nodes. Node axes coincide at the reference, sections there differ by `bend`.
  struct Span {
    int first, last;
    double length;         ///< arc length at the reference
    Eigen::Matrix3d bend;  ///< D₂ D₁ᵀ of the section triads D
  };
  struct Extreme {
    double value = 0.0, time = 0.0;
    int span = -1;
  };

  std::vector<Span> spans_;
  Extreme turn_;     ///< 2 (1 − cos) of the relative rotation
  Extreme stretch_;  ///< |ε| of the arc through both nodes
};

/// Largest rotation vector of each bushing. Beyond half a turn it is that of the other way round, and the moment changes its
/// sign.
class BushingRange {
 public:
  explicit BushingRange(const Model& model) : seen_(model.bushings.size()) {}

  /// At an evaluated state.
  void observe(const State& state, const Evaluation& evaluation);

  /// At most one line, with the number of bushings and the name of the first.
  std::vector<std::string> doubts(const Model& model) const;

 private:
  struct Seen {
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    double angle = 0.0, time = 0.0;  ///< where it first came near half a turn or passed it; 0: never
  };
  std::vector<Seen> seen_;
};

}  // namespace tisserand::mechanism
