// SPDX-License-Identifier: GPL-3.0-or-later
// Eigenvalues of small motions and their comparison.
#pragma once

#include <complex>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"

namespace tisserand::test_support::crossings {

/// Eigenvalues with Im >= 0 of the analysis `modes` from this state (null: the start of the scene), in ascending order
/// of their size. Throws Error.
std::vector<std::complex<double>> eigenvalues(const formats::Scene& scene, const mechanism::BodyFiles& files,
                                              const mechanism::State* begin);

/// Largest difference of `a` from time * b, each over the size of its eigenvalue plus 1e-4 of the largest size.
double mode_difference(const std::vector<std::complex<double>>& a, const std::vector<std::complex<double>>& b,
                       double time);

}  // namespace tisserand::test_support::crossings
