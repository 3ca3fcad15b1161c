// Tyres at the ends of their roads.
#pragma once

#include <string>

#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// After an evaluation of an accepted state: why the run must end, since a tyre has come to an end of its road; or
/// nothing.
std::string off_road(const Model& model, const State& state, const Evaluation& evaluation);

}  // namespace tisserand::mechanism
