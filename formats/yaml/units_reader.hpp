// SPDX-License-Identifier: GPL-3.0-or-later
// The `units` key of a part or scene.
#pragma once

#include "common/units.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Reads the key `units`: `consistent`, or {length: m, mass: kg, time: s} with all three. Returns SI if the key is
/// absent.
Units read_units(const MapReader& map);

}  // namespace tisserand::formats
