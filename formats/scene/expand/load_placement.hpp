// The components of a load in an assembly that is turned: sums of functions of time.
#pragma once

#include <Eigen/Core>

#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Replaces the three functions of time f in the node by `by` f. Numbers and expressions are summed; tables and files
/// only change their sign or place, else an error says what to do.
void turn_components(const Context& context, const Eigen::Matrix3d& by, YamlNode& value);

}  // namespace tisserand::formats
