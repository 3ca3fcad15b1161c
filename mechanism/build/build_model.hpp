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

/// Loaded superelement files by path, so that each file is read once.
using SuperelementFiles = std::map<std::string, formats::LoadedSuperelement>;

/// Contents of all files from which the bodies of a scene are built. Each file is read once. A SuperelementFiles alone
/// converts to it.
struct BodyFiles {
  BodyFiles() = default;
  BodyFiles(SuperelementFiles files) : superelements(std::move(files)) {}
  SuperelementFiles superelements;
  std::map<std::string, formats::Companion> companions;          ///< companions by the path of their superelement
  std::map<std::string, formats::LoadedModalBody> modal_bodies;  ///< modal body files by path
};

/// Reads the superelement, companion and modal body files of a scene, each once. Throws one Error that lists all
/// unreadable files.
BodyFiles read_body_files(const formats::Scene& scene);

/// Velocity of a body at the start, as the scene gives it, in world axes. Absent components are free.
struct BodyStart {
  std::string name;
  /// Origin of the part frame, on the first node of the body or on the carrier that an eliminated virtual body follows.
  Marker origin;
  bool follows = false;                     ///< whether it is an eliminated virtual body, which moves with its carrier
  std::optional<Eigen::Vector3d> velocity;  ///< velocity of `origin`
  std::optional<Eigen::Vector3d> angular_velocity;
  /// Whether `initial` of the scene gives the velocity, which then also counts if the run continues from an analysis at
  /// rest.
  bool kept = false;
};

/// Joint coordinate whose value or rate at the start the scene gives.
struct CoordinateStart {
  std::string name;
  int coordinate = 0;  ///< index of its row in Model::coordinates
  std::optional<double> value;
  std::optional<double> rate;
};

/// Model of a scene, with its state and what the scene gives for the start.
struct BuiltModel {
  Model model;
  /// State with the positions and velocities of the scene, not yet projected on the constraints. Absent velocities are
  /// zero.
  State state;
  std::vector<BodyStart> starts;         ///< start velocities of all bodies
  std::vector<CoordinateStart> initial;  ///< joint coordinates with a value or rate at the start
  std::vector<std::string> notes;        ///< sentences on conversions, omitted modes and warnings
};

/// Builds model and start state of a scene. If the scene has effect switches (key `effects`), the model contains only
/// the effects that are on. Throws Error that lists all errors: unknown names, joints on nodes without rotations, and
/// so on.
BuiltModel build_model(const formats::Scene& scene, const BodyFiles& files);

}  // namespace tisserand::mechanism
