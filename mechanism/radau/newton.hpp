// SPDX-License-Identifier: GPL-3.0-or-later
// Simplified Newton iteration of the three stages with two factorisations.
#pragma once

#include <array>
#include <complex>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/radau/stage_matrix.hpp"
#include "mechanism/radau/stages.hpp"
#include "mechanism/step/step.hpp"
#include "mechanism/step/step_report.hpp"
#include "mechanism/step/workspace.hpp"

namespace tisserand::mechanism::radau {

/// Units and limits of increments in Newton's iteration. The size of an increment is the ratio of measure_error()
/// (step/step_control.hpp).
struct Accuracy {
  formats::ErrorControl units;
  double newton = 1.0;  ///< limit of the predicted size of all remaining increments
  int most_iterations = 7;
  double multipliers = 1.0;  ///< limit of increments of multipliers, relative to forces
  bool fresh_parts = false;  ///< the tangents belong to the start of this step
};

/// Simplified Newton iteration of the three stages: parts (tangents), factors and vectors. The parts belong to one
/// state and stay while the iteration contracts; factors belong to the parts and to a step size. The iteration neglects
/// the change of the tangents between the state of the parts and a stage. Nodes of flexible bodies use axes that turn
/// with them, so that a stiff direction stays stiff. It also neglects the effect of the turning axes and of T(θ) − 1 on
/// rates. It contracts by about the angle of a step.
class Newton {
 public:
  explicit Newton(const Model& model);

  /// Makes new parts (tangents) at the state of the last evaluate(). Factors are discarded.
  void renew(const State& state, Evaluation& evaluation);
  bool has_parts() const { return parts_.valid; }
  /// Makes the factors of both matrices for a step of the length `step`, if they are missing. Returns false and sets
  /// report.outcome if a matrix is singular.
  [[nodiscard]] bool ready(double step, StepReport& report);
  /// Makes the factors of the real matrix alone, otherwise like ready().
  [[nodiscard]] bool ready_real(double step, StepReport& report);
  /// Iterates the predicted stages of the step from workspace.memory.previous until they converge. Otherwise it returns
  /// false and sets report.outcome; shorter() is then the factor for the next trial step.
  [[nodiscard]] bool iterate(const Accuracy& accuracy, Stages& stages, State& state, Workspace& workspace,
                             StepReport& report);
  /// Sets `correction` to the smallest change, weighted with the real matrix, that removes `violation` from the
  /// constraints, THEORY (75). The constraints are those of the last evaluate().
  void project(const Eigen::VectorXd& violation, const Evaluation& evaluation);
  /// Sets `correction` to the estimated error of the positions, THEORY (76). Translations of nodes of flexible bodies
  /// are turned back with the node to the state of the parts.
  void estimate(const Stages& stages, const State& begin);
  void forget();

  double contraction() const { return contraction_; }
  double shorter() const { return shorter_; }
  const SolverHealth& health() const { return real_.solver().health(); }

  Eigen::VectorXd correction;

 private:
  using Turns = std::vector<Eigen::Matrix3d>;

  template <class Visit>
  void for_turning_nodes(Visit visit) const {
    for (std::size_t i = 0; i < turning_.size(); ++i) visit(static_cast<std::size_t>(turning_[i]), turning_rows_[i]);
  }
  void evaluate_stage(const State& begin, int stage, Stages& stages, State& state, Evaluation& evaluation);
  void solve(const State& begin, Stages& stages);
  double measure_multipliers(const State& begin, const Evaluation& evaluation, double share,
                             const Stages::Columns& lambda) const;

  const Model& model_;
  TangentParts parts_;
  StageMatrix<double> real_;
  StageMatrix<std::complex<double>> complex_;
  double real_step_ = 0.0, complex_step_ = 0.0;  ///< step lengths of the factors; 0: none
  std::vector<int> turning_, turning_rows_;      ///< nodes of flexible bodies, and their first translations
  Turns axes_;                                   ///< axes of the nodes to which the factors belong
  Stages::Columns f_, g_;                        ///< −r and −(B v + Φ_t) of the stages, then increments d, λ
  Eigen::VectorXd real_upper_, real_rows_, first_, second_;
  Eigen::VectorXcd complex_upper_, complex_rows_;
  std::array<Turns, 3> turns_;  ///< per stage and node: rotation since the parts were made
  double contraction_ = 0.0;
  double confidence_ = 1.0;  ///< θ/(1 − θ) of the previous step, with its contraction θ
  double shorter_ = 0.5;
};

/// Sets `state` to one stage of a step from `begin`: positions, velocities, accelerations, multipliers and times.
void set_stage(const Model& model, const State& begin, int stage, const Stages& stages, State& state);

}  // namespace tisserand::mechanism::radau
