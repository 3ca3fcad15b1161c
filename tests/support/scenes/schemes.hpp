// SPDX-License-Identifier: GPL-3.0-or-later
// The integration schemes that every test of the integrator runs through.
#pragma once

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "formats/scene/scene.hpp"

namespace tisserand::test_support {

struct Scheme {
  const char* name;
  formats::Method method;
  formats::Formulation formulation;
};

/// Generalised alpha and HHT with index 3 and stabilised index 2.
inline auto all_schemes() {
  using formats::Formulation;
  using formats::Method;
  return ::testing::Values(Scheme{"AlphaIndex3", Method::generalised_alpha, Formulation::index3},
                           Scheme{"AlphaStabilised", Method::generalised_alpha, Formulation::stabilised_index2},
                           Scheme{"HhtIndex3", Method::hht, Formulation::index3},
                           Scheme{"HhtStabilised", Method::hht, Formulation::stabilised_index2});
}

inline std::string scheme_name(const ::testing::TestParamInfo<Scheme>& given) { return given.param.name; }

/// The scene with the scheme; HHT with alpha = 0.1.
inline formats::Scene with_scheme(const Scheme& scheme, formats::Scene scene) {
  scene.integrator.method = scheme.method;
  scene.integrator.formulation = scheme.formulation;
  scene.integrator.alpha = 0.1;
  return scene;
}

/// Order of convergence from the errors with a step and with half of it.
inline double order(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace tisserand::test_support
