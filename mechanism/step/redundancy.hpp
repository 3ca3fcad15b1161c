// SPDX-License-Identifier: GPL-3.0-or-later
// Redundant constraints: choice of active rows, and reactions of least norm among those of the same motion.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/saddle_system.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Whether some constraint row is implied by others, so that the multipliers are not unique.
bool is_overconstrained(const State& state);

/// Chooses the active rows by a rank-revealing QR at the state. Returns whether they changed. Multipliers keep their
/// values, also those of omitted rows: in the next solution the other rows replace their forces.
bool choose_active_rows(const Model& model, State& state, Evaluation& evaluation);

/// Examines the rows of overconstrained scenes while bodies turn. An omitted row is a linear combination of the active
/// ones. If its factors grow, the active rows become dependent. Rows are chosen again as soon as a factor exceeds
/// `most_factor`, long before Newton's iteration meets the loss of rank. The instant depends on the state alone, which
/// contains the rotation of bodies in loops since the last examination.
class RowWatch {
 public:
  explicit RowWatch(const Model& model);

  /// Adds the turn of an accepted step to state.turned(). Does nothing if all rows are active.
  void note_turn(const Model& model, double step, State& state) const;

  /// Examines the rows at the state if bodies have turned by `examined_turn`, and chooses others if necessary. Returns
  /// whether they changed; then the caller discards factors. An examination evaluates the state.
  bool renew(const Model& model, State& state, Evaluation& evaluation);

  static constexpr double examined_turn = 0.25;  ///< [rad]
  static constexpr double most_factor = 3.0;     ///< reached about 1/3 rad before rows become dependent

 private:
  double largest_factor(const Model& model, const State& state, Evaluation& evaluation);

  std::vector<int> rotations_;  ///< first rotation coordinate of each node of bodies in loops
  std::optional<SaddleSystem> system_;
  Eigen::VectorXd factors_, row_, rest_;
};

/// Multipliers λ with the same Bᵀλ and least Σ |f|² + |m|²/L² over all joints and couplings, at the last evaluate(). f,
/// m: wrench of each on its body B at the origin of its marker. L: characteristic length. Up to 400 constraints use a
/// complete orthogonal decomposition. Above, conjugate gradients on the normal equations start at zero.
Eigen::VectorXd least_norm_multipliers(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& lambda);

/// Names of joints and couplings whose reactions could change without changing the motion, at the state of the last
/// evaluate().
std::vector<std::string> joints_without_unique_reaction(const Model& model, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
