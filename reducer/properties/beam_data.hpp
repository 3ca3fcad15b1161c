// What a beam is made of: sections, material, theory, added mass.
#pragma once

#include <vector>

#include "formats/part/part.hpp"
#include "formats/sections/section.hpp"

namespace tisserand::reducer {

/// Whether bending turns mass: `without` drops ρI θ'² of bending and keeps the torsional inertia ρ(Iy + Iz).
enum class RotaryInertia { with, without };

/// Mass that loads the beam and does not stiffen it, from its first to its second end (linear between).
struct AddedMass {
  double first = 0.0;  ///< per length, at the first end
  double second = 0.0;
  double inertia = 0.0;   ///< about x through its own centre, per length, constant
  double offset_y = 0.0;  ///< of its centre from the axis
  double offset_z = 0.0;
};

/// All that decides the matrices of one element. The twelve coordinates are [u v w θx θy θz] of end 1, then of end 2,
/// in the element's axes: x from end 1 to end 2, y and z the axes of the section.
struct BeamElementData {
  formats::Section section;
  formats::Material material;
  double length = 0.0;
  formats::BeamTheory theory = formats::BeamTheory::timoshenko;
  formats::MassMatrix mass_matrix = formats::MassMatrix::consistent;
  RotaryInertia rotary_inertia = RotaryInertia::with;
  /// Tapered: sections at equal distances from end 1 to end 2 (at least two), whose constants are joined by the
  /// polynomial through all of them (properties/beam_taper.hpp makes them). Empty: `section` everywhere.
  std::vector<formats::Section> stations;
  AddedMass added_mass;
};

}  // namespace tisserand::reducer
