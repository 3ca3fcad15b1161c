// SPDX-License-Identifier: GPL-3.0-or-later
// How often a test of faults (killed runs, damaged files) tries.
#pragma once

#include <cstdlib>

namespace tisserand::test_support {

/// `few` in ./check; the value of TISSERAND_KILLS where it is set, as ./check --part faults does.
inline int trials(int few) {
  const char* wish = std::getenv("TISSERAND_KILLS");
  return wish == nullptr ? few : std::atoi(wish);
}

}  // namespace tisserand::test_support
