// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of time and laws of a scene in another description of it.
#pragma once

#include <array>

#include "formats/tables/function_spec.hpp"
#include "tests/support/crossings/similarity.hpp"

namespace tisserand::test_support::crossings {

/// y'(x') with x' = x_factor x and y' = y_factor y.
formats::LawSpec law(const formats::LawSpec& law, double x_factor, double y_factor);

/// factor f(t) as a function of the new time and of the channels in the new description.
formats::TimeFunctionSpec rewritten(const formats::TimeFunctionSpec& f, double factor, const formats::Scene& scene,
                                    const Similarity& s);

/// The three components of matrix f(t): of numbers and expressions alone, unless the matrix has one entry per row.
std::array<formats::TimeFunctionSpec, 3> combined(const std::array<formats::TimeFunctionSpec, 3>& f,
                                                  const Eigen::Matrix3d& matrix, const formats::Scene& scene,
                                                  const Similarity& s);

}  // namespace tisserand::test_support::crossings
