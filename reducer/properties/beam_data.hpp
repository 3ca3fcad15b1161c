// SPDX-License-Identifier: GPL-3.0-or-later
// Data of a beam: sections, material, theory, added mass.
#pragma once

#include <vector>

#include "formats/part/part.hpp"
#include "formats/sections/section.hpp"

namespace tisserand::reducer {

/// Rotary inertia of bending: `without` drops ρI θ'² of bending and keeps the torsional inertia ρ(Iy + Iz).
enum class RotaryInertia { with, without };

/// Mass without stiffness on the beam, linear from its first to its second end.
struct AddedMass {
  double first = 0.0;  ///< per length, at the first end
  double second = 0.0;
  double inertia = 0.0;   ///< about x through its centre, per length, constant
  double offset_y = 0.0;  ///< offset of its centre from the axis
  double offset_z = 0.0;
};

/// Data that determine the matrices of one element. The twelve coordinates are [u v w θx θy θz] of end 1, then of end
/// 2, in the element's axes: x from end 1 to end 2, y and z the axes of the section.
struct BeamElementData {
  formats::Section section;
  formats::Material material;
  double length = 0.0;
  formats::BeamTheory theory = formats::BeamTheory::timoshenko;
  formats::MassMatrix mass_matrix = formats::MassMatrix::consistent;
  RotaryInertia rotary_inertia = RotaryInertia::with;
  /// Sections of a tapered beam at equal distances from end 1 to end 2 (at least two). Their constants vary by the
  /// polynomial through all of them (see properties/beam_taper.hpp). Empty: `section` everywhere.
  std::vector<formats::Section> stations;
  AddedMass added_mass;
};

}  // namespace tisserand::reducer
