// SPDX-License-Identifier: GPL-3.0-or-later
// Tyres of planar models: functions of tyre.hpp for axle, road and node in the plane (build/planar.hpp).
#pragma once

#include "mechanism/tyres/tyre.hpp"

namespace tisserand::mechanism {

// evaluate(), tangent() and dissipated_power() call these functions. Components out of the plane are zero: camber,
// forces across the wheel, rows and columns of the tangent.

/// Computes the terms of a tyre in a planar model, as evaluate() of tyre.hpp.
void evaluate_in_plane(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                       TyreTerms& terms);
/// Tangent of a tyre in a planar model, as tangent() of tyre.hpp.
Matrix8d tangent_in_plane(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                          const TangentCoefficients& coefficients);
/// Rate δ̇ of the penetration of a tyre in a planar model.
double sinking_in_plane(const Tyre& tyre, const Road& road, const NodeMotion& node);

}  // namespace tisserand::mechanism
