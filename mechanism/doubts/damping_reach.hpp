// Whether the damping of superelements reaches their lowest modes.
#pragma once

#include <string>
#include <vector>

#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// One per superelement, alike ones once, whose lowest vibration, held as others hold it (held_coordinates()), has less
/// than a tenth of the damping ratio that the scene asks for: `ratio_internal` damps shapes whose boundary rests, and
/// `ratio` those of the body without joints, which a joint changes.
std::vector<std::string> damping_doubts(const Model& model);

}  // namespace tisserand::mechanism
