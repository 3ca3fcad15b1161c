// SPDX-License-Identifier: GPL-3.0-or-later
// Components of a load in a rotated assembly, as sums of functions of time.
#pragma once

#include <Eigen/Core>

#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Replaces the three functions of time f in the node by `by` f. Numbers and expressions are summed. Tables and files
/// can only change sign or place; otherwise an error names a remedy.
void turn_components(const Context& context, const Eigen::Matrix3d& by, YamlNode& value);

}  // namespace tisserand::formats
