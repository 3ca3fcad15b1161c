// Numbers of a scene that look like slips of the pen or of units (the table "Numbers that are doubted" in SCENE.md).
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

}  // namespace tisserand::mechanism
