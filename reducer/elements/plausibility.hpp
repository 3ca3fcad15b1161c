// Numbers of a part that hardly can be meant (PART.md, "Plausibility checks").
#pragma once

#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Warnings about thick shells, far spiders, far offsets, stiff springs, densities outside 10 to 30 000 kg/m³, wave
/// speeds √(E/ρ) outside 100 to 20 000 m/s and parts larger than 200 m or smaller than 10 µm: what millimetre meshes
/// with metre materials look like. `materials`: those that have names; what they say is not said again of the
/// properties made of them. Densities, speeds and sizes in units without names are not judged.
std::vector<std::string> plausibility_warnings(const Mesh& mesh, const Units& units,
                                               const std::vector<formats::Material>& materials);
inline std::vector<std::string> plausibility_warnings(const Mesh& mesh, const Units& units) {
  return plausibility_warnings(mesh, units, {});
}

/// The same about masses: a point mass 100 times that of all elements, a centre of mass beside the nodes by more than
/// their extent, and more than 1e6 kg. `rigid`: of the whole part.
std::vector<std::string> mass_warnings(const Mesh& mesh, const formats::RigidProperties& rigid, const Units& units);

}  // namespace tisserand::reducer
