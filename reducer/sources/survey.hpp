// What a part or mesh file consists of: the names and numbers by which part.yaml can refer to it.
#pragma once

#include <string>

#include "formats/part/part.hpp"

namespace tisserand::reducer {

/// A table of entities, groups and sets with elements, size, centre and bounding box. Geometry is meshed coarsely, so
/// sizes of curved faces are approximate.
std::string survey(const formats::Part& part);

/// A part that consists of a mesh or geometry file alone, in its own units.
formats::Part part_of_file(const std::string& file);

}  // namespace tisserand::reducer
