// Eigenvalues of small motions, for comparison.
#pragma once

#include <complex>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"

namespace tisserand::test_support::crossings {

/// Of the analysis `modes` from this state (null: the start of the scene), those with Im >= 0, in ascending order of
/// their size. Throws Error.
std::vector<std::complex<double>> eigenvalues(const formats::Scene& scene, const mechanism::BodyFiles& files,
                                              const mechanism::State* begin);

/// The largest difference of `a` from time * b, over the size of each eigenvalue and a ten-thousandth of the largest.
double mode_difference(const std::vector<std::complex<double>>& a, const std::vector<std::complex<double>>& b,
                       double time);

}  // namespace tisserand::test_support::crossings
