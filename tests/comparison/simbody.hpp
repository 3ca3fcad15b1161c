// What Simbody says of a random mechanism.
#pragma once

#include "tests/support/scenes/random_mechanism.hpp"

namespace tisserand::comparison {

/// Of the joints that Simbody has: throws std::logic_error for others.
test_support::StartOfMotion start_by_simbody(const test_support::RandomMechanism& mechanism);

}  // namespace tisserand::comparison
