// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes, positions and pools from the bodies of a scene; virtual bodies are kept or eliminated.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "mechanism/build/build_model.hpp"
#include "mechanism/build/markers.hpp"
#include "mechanism/build/mirrored_files.hpp"
#include "mechanism/bodies/modal/reference_model.hpp"
#include "mechanism/build/part_loads.hpp"
#include "mechanism/build/superelements.hpp"

namespace tisserand::mechanism {

/// Note on one or several bodies, which fits in one line of the report.
struct BodyNote {
  std::string text;
  std::vector<std::string> bodies;  ///< names of the bodies, quoted
};

/// Data that grow while a model is built. Errors are collected and thrown together.
struct Construction {
  explicit Construction(const formats::Scene& from) : scene(from) {}

  const formats::Scene& scene;
  Model model;
  MarkerTable markers;
  std::vector<Eigen::Quaterniond> frames;  ///< orientations of the floating frames of the superelements at the start
  std::vector<BodyStart> starts;           ///< start velocities of all bodies
  /// Resultants of load cases on rigid bodies, by the name of the body.
  std::map<std::string, std::vector<PartResultant>> part_resultants;
  std::set<std::string> vanished;  ///< names of joints that disappear with eliminated virtual bodies
  std::vector<RigidArm> arms;      ///< rigid arms of joints
  /// Reference models of modal bodies whose files hold residual flexibility.
  std::vector<ReferenceModel> reference_models;
  std::set<double> breakpoints;
  std::vector<std::string> notes;
  std::vector<BodyNote> body_notes;
  std::vector<Error> errors;

  /// Adds the body to the note with this text, or adds a new note.
  void note_body(const std::string& name, const std::string& text) {
    auto same = std::ranges::find(body_notes, text, &BodyNote::text);
    if (same == body_notes.end()) same = body_notes.insert(same, {text, {}});
    same->bodies.push_back("'" + name + "'");
  }

  template <class Action>
  /// Runs the action and stores the Error that it throws, if any.
  void collect(Action action) {
    try {
      action();
    } catch (const Error& error) {
      errors.push_back(error);
    }
  }
  /// Throws all stored errors as one Error.
  void throw_errors() const {
    if (!errors.empty()) throw merge_errors(errors);
  }
};

/// Builds all bodies of the scene, virtual ones last, and measures its characteristic length, the extent of the nodes.
/// A scene far from the origin gets an origin of its own (Model::origin) and a note, because 1e6 m away doubles are
/// 1e-10 m apart. Throws Error.
Construction with_bodies(const formats::Scene& scene, const BodyFiles& files);

/// Eliminates virtual bodies: replaces positions on them by positions on their carriers. The fixed joints that tie them
/// disappear.
void eliminate_virtual_bodies(Construction& c);

}  // namespace tisserand::mechanism
