// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of evaluate(): the values of [A/s Bᵀ; B 0] at the state of the last evaluate().
#pragma once

#include <vector>

#include "mechanism/equations/evaluate.hpp"

namespace tisserand::mechanism {

/// Kind of the constraint rows B̂ in the iteration matrix, THEORY (70). A kind says which quantities the rows are
/// derivatives of, and by which increments.
struct ConstraintRows {
  /// Kinds of constraint rows.
  enum class Kind {
    plain,  ///< B: derivative of Φ by material increments
    /// B T(θ): derivative of Φ by increments of the rotation vector θ of the step.
    position,
    /// B + rate_factor ∂(B v)/∂q: derivative of rate_factor · B v by increments d that change the velocities by
    /// d/rate_factor.
    velocity
  };
  Kind kind = Kind::plain;
  double rate_factor = 0.0;
  bool operator==(const ConstraintRows&) const = default;
};

/// Request for a tangent: coefficients of A = c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q, THEORY (69), step tangent or exact
/// one, and the kind of constraint rows.
struct TangentRequest {
  TangentCoefficients coefficients;
  TangentKind kind = TangentKind::step;
  ConstraintRows rows = {};
  bool operator==(const TangentRequest&) const = default;
};

/// Values of the matrix [A/s Bᵀ; B̂ 0] in the slots of the pattern of the model.
struct MatrixValues {
  explicit MatrixValues(const Model& model) : values(model.pattern->values(), 0.0) {}
  std::vector<double> values;
  double scale = 1.0;  ///< factor s, which makes A/s of order one
};

/// Computes the values of the matrix of `request`, at the state of the last evaluate(). Internal coordinates of
/// superelements are condensed. Their blocks stay in the evaluation, for condense() and expand().
void evaluate_tangent(const Model& model, const State& state, const TangentRequest& request, Evaluation& evaluation,
                      MatrixValues& matrix);

/// Computes the values of the matrix of `request` without the superelements, for callers that keep internal
/// coordinates. All values except the scale are linear in the coefficients.
void evaluate_tangent_without_superelements(const Model& model, const State& state, const TangentRequest& request,
                                            Evaluation& evaluation, MatrixValues& matrix);

/// Computes the values of [W/s Bᵀ; B 0] with the weight W = c_m M + c_k K of THEORY (67). W has bodies and the masses
/// of tyre treads, without joints and forces. Superelements have their boundary matrices, with internal coordinates
/// held.
void evaluate_weight(const Model& model, const State& state, const TangentCoefficients& coefficients,
                     Evaluation& evaluation, MatrixValues& matrix);

}  // namespace tisserand::mechanism
