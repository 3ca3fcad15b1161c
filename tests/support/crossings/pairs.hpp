// SPDX-License-Identifier: GPL-3.0-or-later
// Few cells in which any two values of two axes meet.
#pragma once

#include <functional>
#include <vector>

namespace tisserand::test_support::crossings {

/// A value of each axis, from 0.
using Choice = std::vector<int>;

/// Choices of axes with so many values each, such that every pair of values of two axes that `sensible` allows in some
/// choice is in one of them at least. Always the same; the first ones hold the most new pairs.
std::vector<Choice> pairwise(const std::vector<int>& sizes, const std::function<bool(const Choice&)>& sensible);

}  // namespace tisserand::test_support::crossings
