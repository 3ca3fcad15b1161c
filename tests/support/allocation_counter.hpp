// SPDX-License-Identifier: GPL-3.0-or-later
// Counts heap allocations of a test program, to prove that hot paths make none.
#pragma once

#include <cstddef>

namespace tisserand::test_support {

/// Calls of malloc (operator new and Eigen included) by this thread since it started. Always 0 under the address
/// sanitizer, which has a malloc of its own.
std::size_t allocation_count();

}  // namespace tisserand::test_support
