// Stems of given names with the endings of what is made of them.
#include "mechanism/command_files.hpp"

#include <variant>

#include "common/error.hpp"
#include "formats/companion/companion.hpp"
#include "formats/recovery/recovery.hpp"

namespace tisserand::mechanism {
namespace {

std::string stem_of_results(std::string path) {
  for (const char* known : {".part", ".h5", ".results"})
    if (path.ends_with(known)) path.resize(path.size() - std::string(known).size());
  return path;
}

}  // namespace

std::string default_results(const std::string& scene) {
  std::string stem = scene;
  for (const char* ending : {".yaml", ".yml", ".scene"})
    if (stem.ends_with(ending)) stem.resize(stem.size() - std::string(ending).size());
  return stem + ".results.h5";
}

std::string default_page(const std::vector<std::string>& results, const char* ending) {
  return (results.empty() ? "run" : stem_of_results(results.front())) + ending;
}

std::vector<std::string> inputs(const formats::Scene& scene) {
  std::vector<std::string> files = scene.files;
  files.push_back(scene.file);
  for (const formats::BodySpec& body : scene.bodies)
    if (const auto* spec = std::get_if<formats::SuperelementBodySpec>(&body))
      files.insert(files.end(),
                   {spec->file, formats::companion_path(spec->file), formats::recovery_path(spec->file)});
    else if (const auto* modal = std::get_if<formats::ModalBodySpec>(&body))
      files.insert(files.end(), {modal->file, formats::recovery_path(modal->file)});
  return files;
}

std::string output_of(const std::string& asked, Joining joining, const std::optional<RestartFile>& restart) {
  const bool appends = joining == Joining::appended;
  if (!restart && appends)
    throw Error("--append needs a run to go on from", "", "name its checkpoint or results file with --restart");
  if (!restart) return asked;
  if (appends) return asked.empty() ? restart->results : asked;
  if (asked.empty())
    throw Error("--restart needs a results file of its own", "",
                "name it with -o, so that what was computed before is kept, or join both with --append");
  require_apart(*restart, asked);
  return asked;
}

}  // namespace tisserand::mechanism
