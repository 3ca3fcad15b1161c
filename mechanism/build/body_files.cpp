// The files that bodies are made from.
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "formats/hdf5/file.hpp"
#include "mechanism/build/build_model.hpp"
#include "mechanism/build/part_loads.hpp"
#include "mechanism/build/superelements.hpp"

namespace tisserand::mechanism {
namespace {

using TryToRead = void (*)(const std::string& path);

/// Whether a companion file is there that the body may use, or of which a load names a case.
bool reads_companion(const formats::Scene& scene, const formats::SuperelementBodySpec& spec) {
  return (may_use_companion(spec) || bears_part_load(scene, spec.name)) &&
         std::filesystem::exists(formats::companion_path(spec.file));
}

/// All files of a scene, and how each is tried.
std::map<std::string, std::set<TryToRead>> trials(const formats::Scene& scene) {
  std::map<std::string, std::set<TryToRead>> list;
  for (const formats::BodySpec& body : scene.bodies)
    if (const auto* superelement = std::get_if<formats::SuperelementBodySpec>(&body)) {
      list[superelement->file].insert(formats::try_superelement);
      if (reads_companion(scene, *superelement))
        list[formats::companion_path(superelement->file)].insert(formats::try_companion);
    } else if (const auto* modal = std::get_if<formats::ModalBodySpec>(&body))
      list[modal->file].insert(formats::try_modal_body);
  return list;
}

/// Whether a child process could read all of them.
bool rehearse(const formats::Scene& scene) {
  const std::map<std::string, std::set<TryToRead>> list = trials(scene);
  std::vector<std::string> paths;
  for (const auto& [path, kinds] : list) paths.push_back(path);
  return formats::hdf5::survives(paths, [&list](const std::string& path) {
    for (const TryToRead kind : list.at(path)) {
      try {
        kind(path);
      } catch (const Error&) {
        // Met again, and told, where the file is read.
      }
    }
  });
}

}  // namespace

BodyFiles read_body_files(const formats::Scene& scene) {
  BodyFiles files;
  const bool rehearsed = rehearse(scene);
  const auto read_superelement = rehearsed ? formats::read_rehearsed_superelement : formats::read_superelement;
  const auto read_modal_body = rehearsed ? formats::read_rehearsed_modal_body : formats::read_modal_body;
  std::vector<Error> errors;
  const auto read_companion = rehearsed ? formats::read_rehearsed_companion : formats::read_companion;
  std::set<std::string> superelements, companions,
      modal_bodies;  // also those that cannot be read, which are named once
  for (const formats::BodySpec& body : scene.bodies) {
    const auto* superelement = std::get_if<formats::SuperelementBodySpec>(&body);
    const auto* modal = std::get_if<formats::ModalBodySpec>(&body);
    try {
      if (superelement != nullptr && superelements.insert(superelement->file).second)
        files.superelements[superelement->file] = read_superelement(superelement->file);
      if (superelement != nullptr && reads_companion(scene, *superelement) &&
          files.superelements.contains(superelement->file) && companions.insert(superelement->file).second)
        files.companions[superelement->file] = read_companion(formats::companion_path(superelement->file),
                                                              files.superelements.at(superelement->file).superelement);
      if (modal != nullptr && modal_bodies.insert(modal->file).second)
        files.modal_bodies[modal->file] = read_modal_body(modal->file);
    } catch (const Error& error) {
      errors.push_back(error);
    }
  }
  if (!errors.empty()) throw merge_errors(errors);
  return files;
}

}  // namespace tisserand::mechanism
