// SPDX-License-Identifier: GPL-3.0-or-later
// Reading of the files from which bodies are built.
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "formats/hdf5/apart.hpp"
#include "mechanism/build/build_model.hpp"
#include "mechanism/build/part_loads.hpp"
#include "mechanism/build/superelements.hpp"

namespace tisserand::mechanism {
namespace {

/// Whether a companion file exists that the body may use, or of which a load names a case.
bool reads_companion(const formats::Scene& scene, const formats::SuperelementBodySpec& spec) {
  return (may_use_companion(spec) || bears_part_load(scene, spec.name)) &&
         std::filesystem::exists(formats::companion_path(spec.file));
}

std::vector<std::string> paths_of(const formats::Scene& scene) {
  std::set<std::string> paths;
  for (const formats::BodySpec& body : scene.bodies)
    if (const auto* superelement = std::get_if<formats::SuperelementBodySpec>(&body)) {
      paths.insert(superelement->file);
      if (reads_companion(scene, *superelement)) paths.insert(formats::companion_path(superelement->file));
    } else if (const auto* modal = std::get_if<formats::ModalBodySpec>(&body)) {
      paths.insert(modal->file);
    }
  return {paths.begin(), paths.end()};
}

BodyFiles read_each(const formats::Scene& scene) {
  BodyFiles files;
  std::vector<Error> errors;
  std::set<std::string> superelements, companions,
      modal_bodies;  // including unreadable ones, which are reported once
  for (const formats::BodySpec& body : scene.bodies) {
    const auto* superelement = std::get_if<formats::SuperelementBodySpec>(&body);
    const auto* modal = std::get_if<formats::ModalBodySpec>(&body);
    try {
      if (superelement != nullptr && superelements.insert(superelement->file).second)
        files.superelements[superelement->file] = formats::read_superelement(superelement->file);
      if (superelement != nullptr && reads_companion(scene, *superelement) &&
          files.superelements.contains(superelement->file) && companions.insert(superelement->file).second)
        files.companions[superelement->file] = formats::read_companion(
            formats::companion_path(superelement->file), files.superelements.at(superelement->file).superelement);
      if (modal != nullptr && modal_bodies.insert(modal->file).second)
        files.modal_bodies[modal->file] = formats::read_modal_body(modal->file);
    } catch (const Error& error) {
      errors.push_back(error);
    }
  }
  if (!errors.empty()) throw merge_errors(errors);
  return files;
}

}  // namespace

BodyFiles read_body_files(const formats::Scene& scene) {
  const std::vector<std::string> paths = paths_of(scene);
  if (paths.size() > 1) {
    const formats::hdf5::Together together(paths);
    try {
      return read_each(scene);
    } catch (const Error&) {
      if (!together.failed()) throw;
    }
  }
  return read_each(scene);
}

}  // namespace tisserand::mechanism
