// SPDX-License-Identifier: GPL-3.0-or-later
// The constant model and the state before projection, from the scene and its superelement files.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "formats/companion/companion.hpp"
#include "formats/modal_body/modal_body.hpp"
#include "formats/scene/scene.hpp"
#include "formats/superelement/superelement.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Superelement files by path; each is read once.
using SuperelementFiles = std::map<std::string, formats::LoadedSuperelement>;

/// All files from which bodies are built; each is read once. Superelements alone convert to it.
struct BodyFiles {
  BodyFiles() = default;
  BodyFiles(SuperelementFiles files) : superelements(std::move(files)) {}
  SuperelementFiles superelements;
  std::map<std::string, formats::Companion> companions;  ///< companions by the path of their superelement
  std::map<std::string, formats::LoadedModalBody> modal_bodies;
};

/// Reads the superelement, companion and modal body files of a scene, each once. Throws one Error that lists all
/// unreadable files, each once.
BodyFiles read_body_files(const formats::Scene& scene);

/// Velocity of a body at the start as the scene gives it, world axes; absent components are free.
struct BodyStart {
  std::string name;
  Marker origin;         ///< part frame, on the first node of the body or on the carrier that a virtual body follows
  bool follows = false;  ///< an eliminated virtual body, which moves with its carrier
  std::optional<Eigen::Vector3d> velocity;  ///< velocity of the origin
  std::optional<Eigen::Vector3d> angular_velocity;
  bool kept = false;  ///< given by `initial`: also used if the run continues from an analysis at rest
};

/// Joint coordinate with a value or rate at the start.
struct CoordinateStart {
  std::string name;
  int coordinate = 0;  ///< row of Model::coordinates
  std::optional<double> value;
  std::optional<double> rate;
};

struct BuiltModel {
  Model model;
  State state;                    ///< positions and velocities of the scene, absent ones zero; not yet projected
  std::vector<BodyStart> starts;  ///< start velocities of every body
  std::vector<CoordinateStart> initial;
  std::vector<std::string> notes;  ///< conversions, cut modes, warnings: whole sentences
};

/// Builds the model; of a scene with switches, with the active effects (build/effects.hpp). Throws Error that lists all
/// errors: unknown names, joints on nodes without rotations, and so on.
BuiltModel build_model(const formats::Scene& scene, const BodyFiles& files);

}  // namespace tisserand::mechanism
