// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of motion as an ordinary differential equation for a flat vector of positions and velocities.
#pragma once

#include "formats/scene/scene.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Sizes of the parts of the flat vector, for error tests.
struct FlatLayout {
  int first = 0;       ///< start in the state block: x, Q, further positions, v follow each other
  int positions = 0;   ///< number of positions: x, Q and the rest
  int velocities = 0;  ///< number of velocities v
  int rest = 0;        ///< positions after Q, whose rates are the last velocities
  int size() const { return positions + velocities; }
};
FlatLayout flat_layout(const State& state);

/// Time window in which loads are evaluated: from just after the last jump to just before the next.
struct LoadWindow {
  double from = 0.0;
  double to = 0.0;
};

class Index1 {
 public:
  Index1(const formats::Scene& scene, const Model& model, State& state, Workspace& workspace);

  const FlatLayout& layout() const { return layout_; }
  long evaluations() const { return evaluations_; }
  long factorisations() const { return factorisations_; }

  /// Copies the flat vector to the state and normalises quaternions.
  void load(double time, const LoadWindow& window, const double* y);
  /// Computes accelerations and multipliers of the state. Throws Error for a direction without mass. With friction the
  /// reactions depend on the forces that they cause. Newton's iteration solves this; false if it does not converge.
  [[nodiscard]] bool try_accelerate();
  /// Calls try_accelerate() and throws Error if it does not converge.
  void accelerate();
  /// Computes ẏ of the state that was loaded from y and accelerated.
  void rates(const double* y, double* ydot) const;
  /// Moves positions, then velocities onto the constraints in the mass norm. False if this does not converge.
  bool project();
  /// Accepts the state: updates frames, unwrapped angles and forces for tests. Requires accelerate().
  void settle();
  /// Largest |Φ| at the last accelerate() (positions, and angles times length).
  double violation() const;
  /// Fills in the absolute tolerance of each entry of y.
  void tolerances(double* absolute) const;

 private:
  bool project_without_reactions();
  double worst_violation() const;
  void factor_mass();

  const formats::Scene& scene_;
  const Model& model_;
  State& state_;
  Workspace& workspace_;
  Eigen::VectorXd reactions_;  ///< reactions, stored while positions are projected
  FlatLayout layout_;
  long evaluations_ = 0;
  long factorisations_ = 0;
};

}  // namespace tisserand::mechanism
