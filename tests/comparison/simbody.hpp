// SPDX-License-Identifier: GPL-3.0-or-later
// Start of motion of a random mechanism by Simbody.
#pragma once

#include "tests/support/scenes/random_mechanism.hpp"

namespace tisserand::comparison {

/// Start of motion by Simbody, for joints that Simbody has. Throws std::logic_error for others.
test_support::StartOfMotion start_by_simbody(const test_support::RandomMechanism& mechanism);

}  // namespace tisserand::comparison
