// From scene and model to what a results file tells of them, for pictures of the run.
#pragma once

#include <string>

#include "formats/results/simulated_scene.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"

namespace tisserand::mechanism {

/// formats::scene_values of a scene that was read from a file, with the identifiers of all files that it names; empty if
/// a program made it, or if the text is longer than 16 MiB.
std::string scene_values(const formats::Scene& scene, const BodyFiles& files);

/// The text of it that results hold: formats::text_with_contents.
std::string scene_text(const formats::Scene& scene, const BodyFiles& files);

/// `start`: state as the model was built, before anything moved. Of a model whose places are those that the results
/// store (keep_chosen_places): nodes are counted as these.
formats::SimulatedScene simulated_scene(const formats::Scene& scene, const BodyFiles& files, const BuiltModel& built,
                                        const State& start);

}  // namespace tisserand::mechanism
