// From the scene and its superelement files to the constant model and the state before projection.
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

/// Superelement files by path, each read once.
using SuperelementFiles = std::map<std::string, formats::LoadedSuperelement>;

/// All files that bodies are made from, each read once; made from superelements alone where there is nothing else.
struct BodyFiles {
  BodyFiles() = default;
  BodyFiles(SuperelementFiles files) : superelements(std::move(files)) {}
  SuperelementFiles superelements;
  std::map<std::string, formats::Companion> companions;  ///< by the path of their superelement, of bodies that use them
  std::map<std::string, formats::LoadedModalBody> modal_bodies;
};

/// Reads the superelement, companion and modal body files of a scene, each once. Throws Error: all that cannot be read,
/// each once.
BodyFiles read_body_files(const formats::Scene& scene);

/// What a scene says of the velocity of a body at the start, world axes; what is absent is free.
struct BodyStart {
  std::string name;
  Marker origin;  ///< of the part frame, on the first node of the body or on the carrier that a virtual body follows
  bool follows = false;                     ///< an eliminated virtual body: moves as its carrier does
  std::optional<Eigen::Vector3d> velocity;  ///< of the origin
  std::optional<Eigen::Vector3d> angular_velocity;
  bool kept = false;  ///< given by `initial`: also where the run goes on from an analysis at rest
};

/// A coordinate whose value or rate the scene gives at the start.
struct CoordinateStart {
  std::string name;
  int coordinate = 0;  ///< row of Model::coordinates
  std::optional<double> value;
  std::optional<double> rate;
};

struct BuiltModel {
  Model model;
  State state;  ///< positions and velocities of the scene, absent ones zero; not yet projected on the constraints
  std::vector<BodyStart> starts;  ///< of every body
  std::vector<CoordinateStart> initial;
  std::vector<std::string> notes;  ///< conversions, cut modes, warnings: whole sentences
};

/// Of a scene with switches: what is on (build/effects.hpp). Throws Error (all that are found) for names that do not
/// exist, joints on nodes without rotations, and so on.
BuiltModel build_model(const formats::Scene& scene, const BodyFiles& files);

}  // namespace tisserand::mechanism
