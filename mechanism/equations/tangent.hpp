// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of evaluate(): the values of [A/s Bᵀ; B 0] at the state of the last evaluate().
#pragma once

#include <vector>

#include "mechanism/equations/evaluate.hpp"

namespace tisserand::mechanism {

/// Kind of the rows B̂ of THEORY (70): of which quantities, and by which increments, they are derivatives.
struct ConstraintRows {
  enum class Kind {
    plain,     ///< B: Φ for material increments
    position,  ///< B T(displacement of the step): Φ for increments of the rotation vector of the step
    velocity  ///< B + rate_factor ∂(B v)/∂q: rate_factor times B v for increments whose velocity is 1/rate_factor of
              ///< them
  };
  Kind kind = Kind::plain;
  double rate_factor = 0.0;
  bool operator==(const ConstraintRows&) const = default;
};

/// Request for A of THEORY (69), c_m ∂r/∂v̇ + c_c ∂r/∂v + c_k ∂r/∂q, hand-written or exact, and the rows below it.
struct TangentRequest {
  TangentCoefficients coefficients;
  TangentKind kind = TangentKind::step;
  ConstraintRows rows = {};
  bool operator==(const TangentRequest&) const = default;
};

/// Stored values of [A/s Bᵀ; rows 0] in the slots of the model's pattern.
struct MatrixValues {
  explicit MatrixValues(const Model& model) : values(model.pattern->values(), 0.0) {}
  std::vector<double> values;
  double scale = 1.0;  ///< s, which makes A/s of order one
};

/// Computes the values of the request. Internal coordinates of superelements are condensed; their blocks stay in the
/// evaluation for condense() and expand().
void evaluate_tangent(const Model& model, const State& state, const TangentRequest& request, Evaluation& evaluation,
                      MatrixValues& matrix);

/// Computes evaluate_tangent() without the superelements, for callers that keep internal coordinates. All values except
/// the scale are linear in the coefficients.
void evaluate_tangent_without_superelements(const Model& model, const State& state, const TangentRequest& request,
                                            Evaluation& evaluation, MatrixValues& matrix);

/// Computes W = c_m M + c_k K of the bodies alone instead of A, and B; superelements with their boundary coordinates.
void evaluate_weight(const Model& model, const State& state, const TangentCoefficients& coefficients,
                     Evaluation& evaluation, MatrixValues& matrix);

}  // namespace tisserand::mechanism
