// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings about implausible numbers of a part (PART.md, "Numbers that are doubted").
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Warnings about implausible numbers of a mesh: thick shells, spiders far from the part, offsets of many thicknesses,
/// and springs that are too stiff. Further warnings name densities outside 10 to 30 000 kg/m³, wave speeds √(E/ρ)
/// outside 100 to 20 000 m/s, and parts larger than 200 m or smaller than 10 µm. A typical cause is a mesh in
/// millimetres with materials in metres. `materials`: materials with names; their warnings are not repeated for the
/// properties that use them. Densities, speeds and sizes in unnamed units are not judged.
std::vector<std::string> plausibility_warnings(const Mesh& mesh, const Units& units,
                                               const std::vector<formats::Material>& materials);
inline std::vector<std::string> plausibility_warnings(const Mesh& mesh, const Units& units) {
  return plausibility_warnings(mesh, units, {});
}

/// Warnings about implausible masses of the whole part. They name a point mass over 100 times the mass of all
/// elements, a mass of 1e6 kg or more, and a centre of mass outside the nodes by more than their extent. `rigid`:
/// rigid properties of the whole part.
std::vector<std::string> mass_warnings(const Mesh& mesh, const formats::RigidProperties& rigid, const Units& units);

}  // namespace tisserand::reducer
