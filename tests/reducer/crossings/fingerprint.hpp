// SPDX-License-Identifier: GPL-3.0-or-later
// What a part does, in numbers that do not depend on how it is described.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "reducer/reduce.hpp"
#include "reducer/solve/solve.hpp"
#include "tests/reducer/crossings/description.hpp"

namespace tisserand::testing::crossings {

/// Numbers of one kind; they may differ by `limit` of the largest.
struct Trait {
  std::string name;
  Eigen::VectorXd values;
  double limit = 0.0;
};

/// In SI units and the axes of the first description: mass, centre, inertia; flexibility at the boundary; frequencies
/// held and free; stress stiffness, inertia in a turning frame and second order of momentum of the companion; statics,
/// stresses, modes and load factors of `reducer solve`. `has_own_second_order`: see PartModel.
std::vector<Trait> fingerprint(const reducer::Reduction& reduction, const reducer::Solution& solution,
                               const Description& d, bool has_own_second_order);

/// The worst trait: name with the numbers of both, and difference over its limit.
struct Difference {
  std::string name;
  double share = 0.0;
};
Difference worst_difference(const std::vector<Trait>& a, const std::vector<Trait>& b);

}  // namespace tisserand::testing::crossings
