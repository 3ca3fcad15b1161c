// SPDX-License-Identifier: GPL-3.0-or-later
// The equations of motion as an ordinary differential equation for a flat vector of positions and velocities.
#pragma once

#include "formats/scene/scene.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// Sizes of the parts of the flat vector y = [positions, velocities] and its place in the state block.
struct FlatLayout {
  int first = 0;       ///< start of y in the state block, where x, Q, further positions and v follow each other
  int positions = 0;   ///< number of positions: x, Q and the rest
  int velocities = 0;  ///< number of velocities v
  int rest = 0;        ///< number of positions after Q, whose rates are the last velocities
  int size() const { return positions + velocities; }
};
/// Layout of the flat vector for the state.
FlatLayout flat_layout(const State& state);

/// Interval of time in which loads are evaluated: from just after the last jump to just before the next.
struct LoadWindow {
  double from = 0.0;
  double to = 0.0;
};

/// Equations of motion as an ordinary differential equation ẏ = f(t, y) for the flat vector y of positions and
/// velocities.
class Index1 {
 public:
  Index1(const formats::Scene& scene, const Model& model, State& state, Workspace& workspace);

  const FlatLayout& layout() const { return layout_; }
  /// Number of calls of try_accelerate().
  long evaluations() const { return evaluations_; }
  /// Number of factorisations of [M Bᵀ; B 0].
  long factorisations() const { return factorisations_; }

  /// Copies the flat vector `y` to the state and normalises quaternions. `window`: interval in which loads are
  /// evaluated.
  void load(double time, const LoadWindow& window, const double* y);
  /// Computes accelerations and multipliers of the state. With friction the reactions depend on the forces that they
  /// cause, and Newton's iteration solves this. Returns false if the iteration does not converge, or if the state is
  /// not finite. Throws Error for a direction without mass.
  [[nodiscard]] bool try_accelerate();
  /// Calls try_accelerate() and throws Error if it does not converge.
  void accelerate();
  /// Computes ẏ of the state, which was loaded from y and accelerated.
  void rates(const double* y, double* ydot) const;
  /// Moves positions, then velocities, onto the constraints in the mass norm. Returns false if this does not converge.
  bool project();
  /// Accepts the state: updates frames, unwrapped angles and forces for tests. Requires accelerate().
  void settle();
  /// Largest |Φ| at the last accelerate(): lengths, and angles times characteristic length.
  double violation() const;
  /// Fills in the absolute error tolerance of each entry of y.
  void tolerances(double* absolute) const;

 private:
  bool project_without_reactions();
  double worst_violation() const;
  void factor_mass();

  const formats::Scene& scene_;
  const Model& model_;
  State& state_;
  Workspace& workspace_;
  Eigen::VectorXd reactions_;  ///< multipliers, stored while positions are projected
  FlatLayout layout_;
  long evaluations_ = 0;
  long factorisations_ = 0;
};

}  // namespace tisserand::mechanism
