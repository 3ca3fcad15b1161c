// Numbers of a scene that look like slips of the pen or of units (the table "Plausibility checks" in SCENE.md).
#pragma once

#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// One sentence for each number of the scene that hardly can be meant. `now`: at the poses of the start. What depends
/// on units is not judged where they have no names.
std::vector<std::string> number_doubts(const formats::Scene& scene, const Model& model, const Evaluation& now);

/// A note on rigid bodies whose centre of mass is far from all that holds them, against their radius of gyration; empty
/// if there is none. A weight on a light arm is like that, and a centre of mass in other units too.
std::string far_centres(const Model& model);

}  // namespace tisserand::mechanism
