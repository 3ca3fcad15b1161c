// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings about implausible numbers of a part (PART.md, "Numbers that are doubted").
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Warnings about thick shells, far spiders, far offsets, stiff springs, densities outside 10 to 30 000 kg/m³, and wave
/// speeds √(E/ρ) outside 100 to 20 000 m/s. Also about parts larger than 200 m or smaller than 10 µm. Typical cause: a
/// millimetre mesh with metre materials. `materials` are those with names; their warnings are not repeated for their
/// properties. Densities, speeds and sizes in unnamed units are not judged.
std::vector<std::string> plausibility_warnings(const Mesh& mesh, const Units& units,
                                               const std::vector<formats::Material>& materials);
inline std::vector<std::string> plausibility_warnings(const Mesh& mesh, const Units& units) {
  return plausibility_warnings(mesh, units, {});
}

/// Warnings about a point mass 100 times that of all elements, and a mass of 1e6 kg or more. Also about a centre of
/// mass outside the nodes by more than their extent. `rigid` belongs to the whole part.
std::vector<std::string> mass_warnings(const Mesh& mesh, const formats::RigidProperties& rigid, const Units& units);

}  // namespace tisserand::reducer
