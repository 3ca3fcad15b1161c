// SPDX-License-Identifier: GPL-3.0-or-later
// Description of scene and model in a results file, for pictures of the run.
#pragma once

#include <string>

#include "formats/results/simulated_scene.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"

namespace tisserand::mechanism {

/// Values of a scene that was read from a file (formats::scene_values), with the identifiers of all files that it
/// names. Empty if a program made the scene, or if the text is longer than 16 MiB.
std::string scene_values(const formats::Scene& scene, const BodyFiles& files);

/// Text of the scene that results contain (formats::text_with_contents).
std::string scene_text(const formats::Scene& scene, const BodyFiles& files);

/// Description of the scene and its model for the results file. Requires that keep_chosen_places() was called, since
/// nodes are numbered as the stored places. `start`: state of the built model, before any motion.
formats::SimulatedScene simulated_scene(const formats::Scene& scene, const BodyFiles& files, const BuiltModel& built,
                                        const State& start);

}  // namespace tisserand::mechanism
