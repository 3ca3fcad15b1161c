// The equations of motion as an ordinary differential equation: rates of a flat vector of positions and velocities.
#pragma once

#include "formats/scene/scene.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism {

/// How large the parts of the flat vector are, for error tests.
struct FlatLayout {
  int first = 0;       ///< of the state block: x, Q, further positions, v one after the other
  int positions = 0;   ///< x and Q and the rest
  int velocities = 0;  ///< v
  int rest = 0;        ///< positions after Q: their rates are the last velocities
  int size() const { return positions + velocities; }
};
FlatLayout flat_layout(const State& state);

/// Loads are evaluated within these instants: just after the last jump, just before the next.
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

  /// The flat vector becomes the state, with quaternions of length 1.
  void load(double time, const LoadWindow& window, const double* y);
  /// Accelerations and multipliers of the state. Throws Error for a direction without mass. With friction the reactions
  /// depend on the forces that they cause: Newton's iteration from the last ones; false if it does not converge.
  [[nodiscard]] bool try_accelerate();
  /// The same; Error where it does not converge.
  void accelerate();
  /// ẏ for the state that was loaded from y and accelerated. ṗ = ½ Lᵀ Ω keeps |p|, without a constraint per node.
  void rates(const double* y, double* ydot) const;
  /// Positions, then velocities of the state onto the constraints, in the mass norm. False if it does not converge.
  bool project();
  /// The state was accepted: frames, unwrapped angles, forces for tests. After accelerate().
  void settle();
  /// Largest |Φ| at the last accelerate() (positions, and angles times length).
  double violation() const;
  /// Absolute tolerance of each entry of y.
  void tolerances(double* absolute) const;

 private:
  bool project_without_reactions();
  double worst_violation() const;
  void factor_mass();

  const formats::Scene& scene_;
  const Model& model_;
  State& state_;
  Workspace& workspace_;
  Eigen::VectorXd reactions_;  ///< kept while positions are projected
  FlatLayout layout_;
  long evaluations_ = 0;
  long factorisations_ = 0;
};

}  // namespace tisserand::mechanism
