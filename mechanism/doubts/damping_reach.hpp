// SPDX-License-Identifier: GPL-3.0-or-later
// Validity check: whether the damping of superelements acts on their lowest modes.
#pragma once

#include <string>
#include <vector>

#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Warnings on superelements whose lowest vibration is hardly damped, equal ones once. The vibration has the boundary
/// conditions of the scene (held_coordinates()), and less than a tenth of the damping ratio of the internal modes. The
/// reason is that `ratio_internal` damps only shapes whose boundary rests.
std::vector<std::string> damping_doubts(const Model& model);

/// Notes on superelements with `ratio` whose lowest vibration, with the boundary conditions of the scene, is hardly
/// damped. The reason is that `ratio` applies to the modes of the body without joints.
std::vector<std::string> damping_notes(const Model& model);

}  // namespace tisserand::mechanism
