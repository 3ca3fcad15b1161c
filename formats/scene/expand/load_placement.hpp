// SPDX-License-Identifier: GPL-3.0-or-later
// Components of a load in a rotated assembly, as sums of functions of time.
#pragma once

#include <Eigen/Core>

#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Replaces the vector f of three functions of time in the node `value` by `by` times f. Numbers and expressions are
/// summed. Tables and files can only change sign or place: otherwise an error is recorded that names a remedy.
void turn_components(const Context& context, const Eigen::Matrix3d& by, YamlNode& value);

}  // namespace tisserand::formats
