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

/// Whether some constraint row is inactive, because others imply it. The multipliers are then not unique.
bool is_overconstrained(const State& state);

/// Chooses the active constraint rows by a rank-revealing QR at the state. Returns whether they changed. All
/// multipliers keep their values, also those of omitted rows: in the next solution the other rows take over their
/// forces.
bool choose_active_rows(const Model& model, State& state, Evaluation& evaluation);

/// Watch on the active constraint rows of overconstrained scenes while bodies turn. An omitted row is a linear
/// combination of the active ones. If the factors of this combination grow, the active rows become dependent. Rows are
/// chosen again as soon as a factor exceeds `most_factor`, long before Newton's iteration meets the loss of rank. The
/// instant depends on the state alone, which contains the rotation of bodies in loops since the last examination.
class RowWatch {
 public:
  explicit RowWatch(const Model& model);

  /// Adds the largest turn of bodies in loops over an accepted step to state.turned(). Does nothing if all rows are
  /// active.
  void note_turn(const Model& model, double step, State& state) const;

  /// Examines the rows at the state if bodies have turned by `examined_turn`, and chooses others if necessary. Returns
  /// whether the rows changed; the caller must then discard factors. An examination evaluates the state.
  bool renew(const Model& model, State& state, Evaluation& evaluation);

  static constexpr double examined_turn = 0.25;  ///< turn [rad] after which rows are examined
  static constexpr double most_factor = 3.0;     ///< largest factor, about 1/3 rad before rows become dependent

 private:
  double largest_factor(const Model& model, const State& state, Evaluation& evaluation);

  std::vector<int> rotations_;  ///< first rotation coordinate of each node of bodies in loops
  std::optional<SaddleSystem> system_;
  Eigen::VectorXd factors_, row_, rest_;
};

/// Multipliers of least norm among those with the same forces Bᵀλ, at the last evaluate() of the state. The norm is
/// Σ |f|² + |m|²/L² over all joints and couplings. f and m are force and moment of each on its body B at the origin of
/// its marker, L is the characteristic length. Only loops with omitted rows are examined, one by one. Up to 400
/// constraints of a loop it uses a complete orthogonal decomposition. Above, it uses conjugate gradients on the normal
/// equations, which start at zero.
Eigen::VectorXd least_norm_multipliers(const Model& model, const Evaluation& evaluation, const State& state);

/// Names of joints and couplings whose reactions are not unique: they could change without a change of the motion. Uses
/// the state of the last evaluate().
std::vector<std::string> joints_without_unique_reaction(const Model& model, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
