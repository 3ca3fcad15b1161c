// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of a model from load cases of companion files.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/companion/companion.hpp"
#include "formats/scene/scene.hpp"
#include "formats/superelement/superelement.hpp"

namespace tisserand::mechanism {

struct Construction;

/// Resultant of a load case on a rigid body, part axes, units of the scene.
struct PartResultant {
  std::string name;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< moment about the centre of mass
};

/// Whether a load of the scene names a load case of the body.
bool bears_part_load(const formats::Scene& scene, const std::string& body);

/// Load cases that loads name, ascending, by the file of their bodies; all bodies of a file share them.
std::map<std::string, std::vector<std::string>> load_cases_by_file(const formats::Scene& scene);

/// Throws Error for each load on the body whose load case is not in the companion (null: no companion).
void require_load_cases(const formats::Scene& scene, const formats::SuperelementBodySpec& spec,
                        const formats::Companion* companion);

/// Vectors Rᵀ Φᵀ f of all load cases for the rigid motions R about `center` (file units). units: file -> scene.
std::vector<PartResultant> part_resultants(const formats::Companion& companion, const formats::Superelement& element,
                                           const Eigen::Vector3d& center, const UnitConversion& units);

/// Adds a part load; requires all bodies. Throws Error for functions that cannot be parsed.
void add_part_load(const formats::PartLoadSpec& spec, Construction& c);

}  // namespace tisserand::mechanism
