// Tyres of planar models: what tyre.hpp computes, where axle, road and node are as the plane asks (build/planar.hpp).
#pragma once

#include "mechanism/tyres/tyre.hpp"

namespace tisserand::mechanism {

// evaluate(), tangent() and dissipated_power() come here by themselves. What leaves the plane is zero: camber, what
// acts across the wheel, rows and columns of the tangent.

void evaluate_in_plane(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                       TyreTerms& terms);
Matrix8d tangent_in_plane(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                          const TangentCoefficients& coefficients);
/// δ̇.
double sinking_in_plane(const Tyre& tyre, const Road& road, const NodeMotion& node);

}  // namespace tisserand::mechanism
