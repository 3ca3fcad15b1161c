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

/// Resultant force and moment of a load case on a rigid body, in part axes and units of the scene.
struct PartResultant {
  std::string name;  ///< name of the load case
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< moment about the centre of mass
};

/// Whether a load of the scene applies a load case of the companion file to the body.
bool bears_part_load(const formats::Scene& scene, const std::string& body);

/// Names of the load cases that loads of the scene apply, in ascending order, by path of the superelement file. All
/// bodies of a file share them.
std::map<std::string, std::vector<std::string>> load_cases_by_file(const formats::Scene& scene);

/// Throws Error for each load on the body whose load case the companion does not hold. `companion`: null if there is
/// none.
void require_load_cases(const formats::Scene& scene, const formats::SuperelementBodySpec& spec,
                        const formats::Companion* companion);

/// Resultants Rᵀ f of all load cases of a companion file. f are the forces of a load case on the coordinates of
/// `element`. R are the rigid motions about `center` (units of the file). `units`: from the units of the file to those
/// of the scene.
std::vector<PartResultant> part_resultants(const formats::Companion& companion, const formats::Superelement& element,
                                           const Eigen::Vector3d& center, const UnitConversion& units);

/// Adds a load case of a companion file as a load. Requires that all bodies were added. Throws Error for functions that
/// cannot be parsed.
void add_part_load(const formats::PartLoadSpec& spec, Construction& c);

}  // namespace tisserand::mechanism
