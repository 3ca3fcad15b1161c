// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a scene that suggest typing errors or wrong units (table "Plausibility checks" in SCENE.md).
#pragma once

#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Sentences, one for each implausible number of the scene. `now`: evaluation of the model at the poses of the start.
/// Quantities with unnamed units are not checked.
std::vector<std::string> number_doubts(const formats::Scene& scene, const Model& model, const Evaluation& now);

/// Note on slender rigid bodies whose centre of mass is far from all that holds them, compared with the radius of
/// gyration. Empty if there is no such body. A weight on a light arm looks like this, and so does a centre of mass in
/// wrong units.
std::string far_centres(const Model& model);

}  // namespace tisserand::mechanism
