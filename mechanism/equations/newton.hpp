// Linear algebra of one Newton iteration: factor the condensed system, solve for boundary coordinates and multipliers,
// expand the internal coordinates.
#pragma once

#include <string>

#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/workspace.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Evaluates the tangent at the state of the last evaluate() and factors it.
[[nodiscard]] FactorReport factor(const Model& model, const State& state, const TangentCoefficients& coefficients,
                                  TangentKind kind, const ConstraintRows& rows, Workspace& workspace);

/// Solves A d + Bᵀ dλ = −r, B d = rows with the kept factors. `increment` (boundary and internal) receives d, the
/// multipliers in workspace.unknowns.tail receive dλ.
void solve_increment(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& rows, Workspace& workspace);

/// Solves A d + Bᵀ μ = 0, B d = rows with the kept factors: the smallest change of position, weighted with A, that does
/// `rows` to the constraints. `correction` receives d.
void solve_correction(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& rows, Workspace& workspace);

/// Name of the coordinate or constraint that dominates the solution for a unit right-hand side: with nearly singular
/// factors the direction that nothing holds.
std::string weakest_equation(const Model& model, Workspace& workspace);

/// B T(displacement of the step) d for the Jacobian of the last evaluate(), d in boundary coordinates.
void apply_jacobian(const Model& model, const Workspace& workspace, const Eigen::VectorXd& d,
                    Eigen::Ref<Eigen::VectorXd> rows);

/// x += d, Q <- Q exp(dΘ/2), w += d, y += d from the positions of `from`; the only update of positions in the program.
void retract(const Model& model, const State& from, const Eigen::VectorXd& d, State& to);

}  // namespace tisserand::mechanism
