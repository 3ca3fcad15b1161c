// Reactions of overconstrained mechanisms: of all multipliers that cause the same motion, those of least norm.
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

/// Chooses again which rows are solved for, by a rank-revealing QR at the state. Returns whether they changed.
/// Multipliers keep their values, also those of rows that are left out from now on: in the next solution the others
/// replace their forces.
bool choose_active_rows(const Model& model, State& state, Evaluation& evaluation);

/// Examines the rows of overconstrained scenes while bodies turn. A row that is left out is a linear combination of
/// those that are solved for. If its factors grow, these become dependent. Rows are chosen again as soon as a factor
/// exceeds `most_factor`, long before Newton's iteration meets the loss of rank. The instant depends on the state
/// alone, which contains the rotation of bodies in loops since the last examination.
class RowWatch {
 public:
  explicit RowWatch(const Model& model);

  /// Adds the turn of an accepted step to state.turned(). Does nothing where all rows are solved for.
  void note_turn(const Model& model, double step, State& state) const;

  /// Examines the rows at the state if bodies have turned by `examined_turn`, and chooses others if that is due.
  /// Returns whether they changed; the caller then forgets factors. Evaluates the state where it examines.
  bool renew(const Model& model, State& state, Evaluation& evaluation);

  static constexpr double examined_turn = 0.25;  ///< [rad]
  static constexpr double most_factor = 3.0;     ///< at about 1/3 rad from a position where rows become dependent

 private:
  double largest_factor(const Model& model, const State& state, Evaluation& evaluation);

  std::vector<int> rotations_;  ///< first rotation coordinate of each node of bodies in loops
  std::optional<SaddleSystem> system_;
  Eigen::VectorXd factors_, row_, rest_;
};

/// λ with the same Bᵀλ and least Σ |f|² + |m|²/L² over all joints and couplings: f, m the wrench that each exerts on
/// its body B at the origin of its marker, L the characteristic length of the scene. At the state of the last
/// evaluate(). Up to 400 constraints by a complete orthogonal decomposition, above by conjugate gradients on the normal
/// equations (started at zero they converge to the solution of least norm).
Eigen::VectorXd least_norm_multipliers(const Model& model, const Evaluation& evaluation, const Eigen::VectorXd& lambda);

/// Joints and couplings, by name, whose reactions could be changed without changing the motion. At the state of the
/// last evaluate().
std::vector<std::string> joints_without_unique_reaction(const Model& model, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
