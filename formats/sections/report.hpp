// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of sections as a text table, which `reducer section part.yaml` prints.
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/sections/section.hpp"

namespace tisserand::formats {

/// Principal second moments of area I1 >= I2 about the centroid, and the angle from y to the axis of I1 [rad], in
/// (−π/2, π/2].
struct PrincipalMoments {
  double larger = 0.0;
  double smaller = 0.0;
  double angle = 0.0;
};
PrincipalMoments principal_moments(const Section& section);

/// Text with one block of lines per section: name, shape and sizes, then every constant with its unit, six digits.
std::string section_report(const std::vector<Section>& sections, const Units& units);

}  // namespace tisserand::formats
