// SPDX-License-Identifier: GPL-3.0-or-later
// Conditions of B and of the iteration matrix, and growth of the motion.
#include "mechanism/doubts/failure_cause.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "mechanism/analyses/assembly.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/step/generalised_alpha.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Condition of B beyond which its rows are nearly dependent: BBᵀ keeps a third of its digits. Mechanisms away from
/// singular positions have 1 to 1e3, one step before them 6e5 (tests/stability, four-bar).
constexpr double dependent = 1e5;
/// Largest sizes for which the condition of B is computed: a second at most.
constexpr int most_constraints = 400, longest_row = 4000;
/// Reciprocal condition of the iteration matrix at which two digits of a solution remain.
constexpr double nearly_singular = 1e-14;
/// Tolerance of the gaps of an assembly: far above round-off, far below gaps a millisecond after a dead point.
constexpr double closed = 1e-9;

/// Condition of the active rows of B, with lengths and rotations scaled by the characteristic length. 0: not computed.
/// Needs evaluate().
double constraint_condition(const Model& model, const State& state, const Evaluation& now) {
  const int rows = model.sizes.constraints, columns = model.sizes.boundary;
  if (rows == 0 || rows > most_constraints || columns > longest_row) return 0.0;
  MatrixXd B(rows, columns);
  VectorXd unit = VectorXd::Zero(model.sizes.velocities()), column(rows);
  for (int j = 0; j < columns; ++j) {
    unit[j] = model.equation_scale[j];
    apply_jacobian(model, now, unit, column);
    B.col(j) = column;
    unit[j] = 0.0;
  }
  for (int row = 0; row < rows; ++row)
    if (!model.length_row[row]) B.row(row) *= model.length;
  std::vector<int> solved;
  for (int row = 0; row < rows; ++row)
    if (state.active()[row] != 0.0) solved.push_back(row);
  const MatrixXd active = B(solved, Eigen::all);
  const VectorXd squares =
      Eigen::SelfAdjointEigenSolver<MatrixXd>(active * active.transpose(), Eigen::EigenvaluesOnly).eigenvalues();
  if (squares.size() == 0) return 0.0;
  return std::sqrt(squares[squares.size() - 1] / std::max(squares[0], 1e-32 * squares[squares.size() - 1]));
}

/// Factors the iteration matrix of a step of the given size from the evaluated state.
FactorReport factored(const Model& model, const formats::IntegratorSpec& options, double size, const State& state,
                      Workspace& workspace) {
  const StepScheme scheme = step_scheme(model, options, state, state.time() + size);
  return workspace.matrix.factor(model, state, scheme.request, workspace.now);
}

bool is_singular(const FactorReport& factors) {
  return !factors.regular || factors.reciprocal_condition < nearly_singular;
}

/// Text on drives that joints cannot follow: what stays open at the end of the step for any motion of whole bodies.
std::string unreachable(const Model& model, double size, State state, Evaluation& now) {
  if (model.motions.empty() || model.sizes.constraints > most_constraints || model.sizes.boundary > longest_row)
    return {};
  state.time() += size;
  const AssemblyReport report = assemble(model, {closed}, state, now);
  if (report.closed || report.open.empty()) return {};
  const JointGap& gap = report.open.front();
  return fmt::format(
      ". The joints cannot be closed at t = {:.6g}{}: '{}' stays open by {:.2g}{}. The drive demands a position that "
      "the mechanism cannot reach. Reduce the motion of the drive, or change the lengths",
      state.time(), after_time(model.units), gap.joint, std::max(gap.length, gap.angle),
      gap.length < gap.angle ? " rad" : after_number(unit_label(model.units, 1, 0, 0)));
}

}  // namespace

std::string failure_cause(const Model& model, const formats::IntegratorSpec& options, const Doubts& doubts,
                          const Failure& failure, State& state, Workspace& workspace) {
  if (failure.step.outcome == StepOutcome::inaccurate) return {};
  if (const std::string seen = doubts.explanation(Puzzle::failure, model); !seen.empty())
    return ". Probable cause: " + seen;
  if (const std::string open = unreachable(model, failure.size, state, workspace.now); !open.empty()) return open;
  evaluate(model, state, workspace.now);
  const double condition = constraint_condition(model, state, workspace.now);
  if (condition > dependent)
    return fmt::format(
        ". The constraint equations are nearly dependent there (condition {:.1e} of their scaled Jacobian), as in a "
        "singular position. Pass it with another step, or release one direction of a joint",
        condition);
  const FactorReport factors = factored(model, options, failure.size, state, workspace);
  if (is_singular(factors)) {
    if (!is_singular(factored(model, options, failure.size / 4.0, state, workspace)))
      return fmt::format(
          ". The iteration matrix is singular with the step of {:.3g}, but regular with a quarter of it. A negative "
          "stiffness (of a spring, a follower load, a part that buckles) cancels the mass there. Set a shorter 'step', "
          "or more 'max_halvings'",
          failure.size);
    return fmt::format(
        ". The iteration matrix is singular there with the step of {:.3g} too. A direction has no mass, no stiffness "
        "and no constraint{}. Give it a mass or a stiffness, or constrain it",
        failure.size,
        factors.singular_column >= 0 && factors.singular_column < model.sizes.boundary
            ? fmt::format(": {}", coordinate_name(model, factors.singular_column))
            : "");
  }
  const std::string seen = doubts.explanation(Puzzle::regular_failure, model);
  return fmt::format(". The equations are regular there (reciprocal condition {:.1e}{}){}",
                     factors.reciprocal_condition,
                     condition > 0.0 ? fmt::format(", condition of the constraints {:.1e}", condition) : "",
                     !seen.empty() ? ", but " + seen
                                   : ". The cause begins within the step: a load, a stop or friction. Set a shorter "
                                     "'step', or more 'max_halvings'");
}

}  // namespace tisserand::mechanism
