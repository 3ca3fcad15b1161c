// Checks of the mesh before anything is assembled: shapes of elements and whether numbers are physically plausible.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/units.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Asks every element for faults of its shape. Throws one Error with the first ten and their number; returns warnings.
std::vector<std::string> check_shapes(const Mesh& mesh, const std::string& where);

/// Elements whose shape check_shapes() refuses: beams, then shells, then solids are counted.
std::vector<int> faulty_elements(const Mesh& mesh);

/// Warnings about thick shells, densities outside 10 to 30 000 kg/m³, wave speeds √(E/ρ) outside 100 to 20 000 m/s and
/// parts larger than 200 m or smaller than 10 µm: what millimetre meshes with metre materials look like. `materials`:
/// those that have names; what they say is not said again of the properties made of them. Units without names are not
/// judged.
std::vector<std::string> plausibility_warnings(const Mesh& mesh, const Units& units,
                                               const std::vector<formats::Material>& materials);
inline std::vector<std::string> plausibility_warnings(const Mesh& mesh, const Units& units) {
  return plausibility_warnings(mesh, units, {});
}

/// Springs 1e8 times as stiff as the stiffest of up to a thousand elements of each kind: the part is lost in their
/// digits.
std::vector<std::string> stiff_spring_doubts(const Mesh& mesh);

/// The same for a mass above 1e6 kg: a bracket in millimetres taken for metres weighs 1e9 times too much.
std::optional<std::string> mass_doubt(double mass, const Units& units);

}  // namespace tisserand::reducer
