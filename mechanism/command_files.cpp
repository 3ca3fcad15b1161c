// SPDX-License-Identifier: GPL-3.0-or-later
// Default file names from the stems of given names; results file of a restarted run.
#include "mechanism/command_files.hpp"

#include <variant>

#include "common/error.hpp"
#include "common/output_path.hpp"
#include "formats/companion/companion.hpp"
#include "formats/recovery/recovery.hpp"

namespace tisserand::mechanism {
namespace {

/// Path without each of the endings in turn.
std::string stem_of(std::string path, const std::vector<std::string>& endings) {
  for (const std::string& ending : endings) path = without_ending(path, {ending});
  return path;
}

}  // namespace

std::string default_results(const std::string& scene) {
  return stem_of(scene, {".yaml", ".yml", ".scene"}) + ".results.h5";
}

std::string default_page(const std::vector<std::string>& results, const char* ending) {
  return (results.empty() ? "run" : stem_of(results.front(), {".part", ".h5", ".results"})) + ending;
}

std::vector<std::string> inputs(const formats::Scene& scene) {
  std::vector<std::string> files = scene.files;
  files.push_back(scene.file);
  for (const formats::BodySpec& body : scene.bodies)
    if (const auto* spec = std::get_if<formats::SuperelementBodySpec>(&body))
      files.insert(files.end(), {spec->file, formats::companion_path(spec->file), formats::recovery_path(spec->file)});
    else if (const auto* modal = std::get_if<formats::ModalBodySpec>(&body))
      files.insert(files.end(), {modal->file, formats::recovery_path(modal->file)});
  return files;
}

std::string output_of(const std::string& asked, Joining joining, const std::optional<RestartFile>& restart) {
  const bool appends = joining == Joining::appended;
  if (!restart && appends)
    throw Error("--append needs --restart", "",
                "name the checkpoint or the results file of the run to continue with --restart");
  if (!restart) return asked;
  if (appends) return asked.empty() ? restart->results : asked;
  if (asked.empty())
    throw Error("--restart needs the name of a new results file", "",
                "name it with -o, or store the rows of both runs in one file with --append");
  require_apart(*restart, asked);
  return asked;
}

}  // namespace tisserand::mechanism
