// SPDX-License-Identifier: GPL-3.0-or-later
// Data of a beam: sections, material, theory, added mass.
#pragma once

#include <vector>

#include "formats/part/part.hpp"
#include "formats/sections/section.hpp"

namespace tisserand::reducer {

/// Treatment of rotary inertia. `without` omits ρI θ'² of bending and keeps the torsional inertia ρ(Iy + Iz).
enum class RotaryInertia { with, without };

/// Mass without stiffness that a beam carries, linear from its first to its second end.
struct AddedMass {
  double first = 0.0;  ///< mass per length at the first end
  double second = 0.0;
  double inertia = 0.0;   ///< inertia about x through its centre, per length, constant
  double offset_y = 0.0;  ///< offset of its centre from the beam axis
  double offset_z = 0.0;
};

/// Section, material, length and options of one beam element, which determine its matrices. The twelve coordinates are
/// [u v w θx θy θz] of end 1, then of end 2, in the axes of the element: x from end 1 to end 2, y and z the axes of
/// the section.
struct BeamElementData {
  formats::Section section;
  formats::Material material;
  double length = 0.0;
  formats::BeamTheory theory = formats::BeamTheory::timoshenko;
  formats::MassMatrix mass_matrix = formats::MassMatrix::consistent;
  RotaryInertia rotary_inertia = RotaryInertia::with;
  /// Sections of a tapered beam at equal distances from end 1 to end 2, at least two. Their constants vary by the
  /// polynomial through all of them (properties/beam_taper.hpp). If there are none, `section` holds everywhere.
  std::vector<formats::Section> stations;
  AddedMass added_mass;
};

}  // namespace tisserand::reducer
