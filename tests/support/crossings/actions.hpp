// SPDX-License-Identifier: GPL-3.0-or-later
// What acts in the cells.
#pragma once

#include "tests/support/crossings/ingredients.hpp"

namespace tisserand::test_support::crossings {

/// Adds the loads, springs, drives or gears to the scene of arm, hinge and bob.
void add_action(const Ingredients& ingredients, formats::Scene& scene);

/// What acts along a coordinate does so along the first of the hinge, or that of the wrist where it has none.
std::string acted_coordinate(Hinge hinge);

}  // namespace tisserand::test_support::crossings
