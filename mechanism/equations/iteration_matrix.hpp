// SPDX-License-Identifier: GPL-3.0-or-later
// Matrix of a Newton iteration: a saddle system with condensed internal coordinates, and the request to which its
// factors belong.
#pragma once

#include <optional>
#include <string>

#include "mechanism/equations/saddle_system.hpp"

namespace tisserand::mechanism {

/// Matrix [A/s Bᵀ; B̂ 0] of a Newton iteration in boundary coordinates and multipliers, with its factors and solutions,
/// THEORY (69). s is MatrixValues::scale. It knows whether the factors can be used: they belong to the request for
/// which they were made, and are invalid after a failed factorisation, invalidate() or forget().
class IterationMatrix {
 public:
  explicit IterationMatrix(const Model& model);

  /// Computes the tangent of `request` at the state of the last evaluate() and factors it.
  [[nodiscard]] FactorReport factor(const Model& model, const State& state, const TangentRequest& request,
                                    Evaluation& evaluation);
  /// Whether the factors belong to this request (at any state), and to the blocks of superelements in the evaluation.
  /// solve_increment() needs these blocks for internal coordinates, and every tangent replaces them.
  bool serves(const TangentRequest& request, const Evaluation& evaluation) const {
    return factored_ == request && tangent_ == evaluation.tangents;
  }
  /// Marks the factors as unusable, so that the next iteration makes new ones.
  void invalidate() { factored_.reset(); }
  /// Discards factors and pivots. The next factorisation then chooses its pivots like the first one.
  void forget();

  /// Solves A d + Bᵀ dλ = −r, B̂ d = rows with the factors. `increment` receives d (boundary and internal coordinates),
  /// `multipliers` receives dλ.
  void solve_increment(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& rows, Evaluation& evaluation);
  /// Solves A d + Bᵀ μ = 0, B̂ d = rows: the smallest change d, weighted with A, that changes the constraints by
  /// `rows`. `correction` receives d (boundary and internal coordinates), `projection_multipliers` receives μ.
  void solve_projection(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& rows, Evaluation& evaluation);

  /// Name of the coordinate or constraint that dominates the solution for a right-hand side of ones. If the
  /// matrix is nearly singular, this is the coordinate that nothing holds.
  std::string weakest_equation(const Model& model);
  const SolverHealth& health() const { return system_.health(); }

  Eigen::VectorXd increment;               ///< d of solve_increment()
  Eigen::VectorXd multipliers;             ///< dλ of solve_increment()
  Eigen::VectorXd correction;              ///< d of solve_projection()
  Eigen::VectorXd projection_multipliers;  ///< μ of solve_projection()
  Eigen::VectorXd rows;                    ///< buffer for right-hand sides of constraint rows

 private:
  void gather(const Model& model, std::size_t superelement, const Eigen::VectorXd& boundary);

  SaddleSystem system_;
  std::optional<TangentRequest> factored_;
  long tangent_ = 0;                  ///< Evaluation::tangents of the factors
  Eigen::VectorXd element_boundary_;  ///< d_B of one superelement
};

}  // namespace tisserand::mechanism
