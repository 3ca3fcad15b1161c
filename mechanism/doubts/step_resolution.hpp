// Whether steps of a given size resolve what moves.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// ωh of the motion as √(Σ w Δv² / Σ w v²) over stretches of 16 steps, w the masses: for one frequency 2 sin(ωh/2), for
/// several their mean by kinetic energy. Of generalised alpha and HHT without control of the error; the other methods
/// choose their steps.
class StepResolution {
 public:
  StepResolution(const formats::Scene& scene, const Model& model);

  /// After a step from `before` to `state`.
  void observe(const Model& model, const State& before, const State& state);

  /// At most one: a node that turns by more than a quarter of a revolution per step, or the coarsest stretch in which
  /// at least a tenth of the largest kinetic energy moves.
  std::vector<std::string> doubts(const Model& model) const;

  /// |Δv|/|v| of the latest step, weighted with the masses; 0: not observed.
  double latest() const { return latest_; }

 private:
  struct Stretch {
    double rate = 0.0;  ///< ωh
    double time = 0.0;
    double step = 0.0;
    int coordinate = -1;  ///< that changes most
  };
  struct Turn {
    double angle = 0.0;  ///< of a node in a step
    double time = 0.0;
    int node = -1;
  };
  void close(const Model& model, const State& before, const State& state);

  bool active_;
  Eigen::ArrayXd mass_;  ///< of velocity coordinates; sized at the first step
  double change_ = 0.0, motion_ = 0.0;
  double latest_ = 0.0;
  int steps_ = 0;
  Turn fastest_;
  std::map<int, Stretch> coarsest_;  ///< by the binary exponent of the energy of the stretch
};

/// Steps in which a stop is touched, from one side, until it is left. Of the same runs as StepResolution.
class TouchResolution {
 public:
  TouchResolution(const formats::Scene& scene, const Model& model);

  /// After a step to the evaluated `state`.
  void observe(const Model& model, const State& state, const Evaluation& evaluation);

  /// At most one: the touch of fewest steps among those that press at least a tenth as hard as the hardest.
  std::vector<std::string> doubts(const Model& model) const;

 private:
  struct Touch {
    int steps = 0;
    double depth = 0.0, time = 0.0;
  };
  struct Seen {
    int spring = -1;
    Touch now;
    double deepest = 0.0;
    std::map<int, Touch> shortest;  ///< by the binary exponent of the depth
  };
  std::vector<Seen> stops_;
};

}  // namespace tisserand::mechanism
