// SPDX-License-Identifier: GPL-3.0-or-later
// What an element adds by its mass, as whole matrices: the sums that programs never form.
#pragma once

#include "reducer/elements/turning_mass.hpp"

namespace tisserand::testing {

reducer::TurningForms turning_forms(const reducer::TurningMass& mass);

}  // namespace tisserand::testing
