// Whether the damping of superelements reaches their lowest modes.
#pragma once

#include <string>
#include <vector>

#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// One per superelement, alike ones once, whose lowest vibration, held as others hold it (held_coordinates()), has less
/// than a tenth of the damping ratio of its internal modes: `ratio_internal` damps shapes whose boundary rests, and no
/// others.
std::vector<std::string> damping_doubts(const Model& model);

/// The same of `ratio`, which is that of the modes of the body without joints.
std::vector<std::string> damping_notes(const Model& model);

}  // namespace tisserand::mechanism
