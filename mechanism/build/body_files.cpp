// The files that bodies are made from.
#include <algorithm>
#include <set>

#include "common/error.hpp"
#include "mechanism/build/build_model.hpp"

namespace tisserand::mechanism {
namespace {

/// Each once, in the order of the bodies.
std::vector<std::string> superelement_files(const formats::Scene& scene) {
  std::vector<std::string> files;
  for (const formats::BodySpec& body : scene.bodies)
    if (const auto* spec = std::get_if<formats::SuperelementBodySpec>(&body))
      if (std::find(files.begin(), files.end(), spec->file) == files.end()) files.push_back(spec->file);
  return files;
}

}  // namespace

BodyFiles read_body_files(const formats::Scene& scene) {
  BodyFiles files;
  const bool rehearsed = formats::rehearse_superelements(superelement_files(scene));
  const auto read_superelement = rehearsed ? formats::read_rehearsed_superelement : formats::read_superelement;
  std::vector<Error> errors;
  std::set<std::string> superelements, modal_bodies;  // also those that cannot be read, which are named once
  for (const formats::BodySpec& body : scene.bodies) {
    const auto* superelement = std::get_if<formats::SuperelementBodySpec>(&body);
    const auto* modal = std::get_if<formats::ModalBodySpec>(&body);
    try {
      if (superelement != nullptr && superelements.insert(superelement->file).second)
        files.superelements[superelement->file] = read_superelement(superelement->file);
      if (modal != nullptr && modal_bodies.insert(modal->file).second)
        files.modal_bodies[modal->file] = formats::read_modal_body(modal->file);
    } catch (const Error& error) {
      errors.push_back(error);
    }
  }
  if (!errors.empty()) throw merge_errors(errors);
  return files;
}

}  // namespace tisserand::mechanism
