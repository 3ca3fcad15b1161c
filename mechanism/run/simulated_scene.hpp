// From scene and model to what a results file tells of them, for pictures of the run.
#pragma once

#include "formats/results/simulated_scene.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"

namespace tisserand::mechanism {

/// `start`: state as the model was built, before anything moved. Of a model whose places are those that the results
/// store (keep_chosen_places): nodes are counted as these.
formats::SimulatedScene simulated_scene(const formats::Scene& scene, const BodyFiles& files, const BuiltModel& built,
                                        const State& start);

}  // namespace tisserand::mechanism
