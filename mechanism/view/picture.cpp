// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of a request to the call of the page that draws it.
#include "mechanism/view/picture.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <numbers>

#include "common/base64.hpp"
#include "common/error.hpp"
#include "common/output_path.hpp"
#include "common/program/version.hpp"
#include "common/text.hpp"
#include "formats/page/picture_mark.hpp"
#include "formats/results/results.hpp"
#include "mechanism/view/browser.hpp"

namespace tisserand::mechanism {
namespace {

using formats::Json;
constexpr double radian = std::numbers::pi / 180.0;
constexpr int smallest_side = 32, largest_side = 8192;

/// Names for users, and the settings of the page.
const std::map<std::string, std::string> settings_of_things{
    {"arrows", "arrows"}, {"axes", "worldAxes"},    {"body-axes", "bodyAxes"},
    {"edges", "edges"},   {"elements", "elements"}, {"grid", "grid"},
    {"joints", "joints"}, {"nodes", "nodes"},       {"springs", "springs"}};

/// Azimuth and elevation [rad] from "-30,20"; a name is kept.
Json view_of(const std::string& text) {
  if (std::ranges::find(picture_views, text) != picture_views.end()) return text;
  double azimuth = 0.0, elevation = 0.0;
  const char *end = text.data() + text.size(), *comma = std::find(text.data(), end, ',');
  const auto first = std::from_chars(text.data(), comma, azimuth);
  const auto second = comma == end ? first : std::from_chars(comma + 1, end, elevation);
  if (comma == end || first.ec != std::errc() || first.ptr != comma || second.ec != std::errc() || second.ptr != end ||
      !(std::abs(elevation) <= 90.0) || !(std::abs(azimuth) <= 360.0))
    throw Error(fmt::format("'{}' is not a view", printable_line(text, 60)), "picture",
                fmt::format("give {}, or azimuth,elevation of the camera in degrees, for example -50,25",
                            join(picture_views, ", ")));
  return {azimuth * radian, elevation * radian};
}

/// Times of the states, each within the first run.
std::vector<double> times_of(const PictureRequest& request, const formats::ResultsReader& run) {
  if (run.rows() == 0) return {0.0};  // the page reports it
  const Eigen::MatrixXd ends = run.read_dataset("time", {0, run.rows() - 1});
  if (request.times.empty()) return {ends(1, 0)};
  const std::string unit = after_time(run.layout().units);
  for (const double time : request.times)
    if (!(time >= ends(0, 0) && time <= ends(1, 0)))
      throw Error(fmt::format("has no instant t = {:.6g}{}: it goes from {:.6g} to {:.6g}{}", time, unit, ends(0, 0),
                              ends(1, 0), unit),
                  run.path(), "give --time within the run");
  return request.times;
}

void require_nodes(const std::vector<std::string>& names, const formats::ResultsReader& run) {
  std::vector<std::string> known = run.layout().nodes;
  for (const auto& alias : run.layout().node_aliases) known.push_back(alias.name);
  for (const std::string& name : names)
    if (std::ranges::find(known, name) == known.end())
      throw Error(fmt::format("has no node '{}'", printable_line(name, 100)), run.path(),
                  "nodes are, for example: " + listed(nearest_names(name, known)));
}

/// Name of the body that the camera follows; "": it does not move.
std::string followed_of(const std::string& name, const formats::ResultsReader& run) {
  if (name == "none") return "";
  std::vector<std::string> known;
  for (const formats::SimulatedBody& body : run.layout().simulated.bodies) known.push_back(body.name);
  if (std::ranges::find(known, name) == known.end())
    throw Error(fmt::format("has no body '{}' for the camera to follow", printable_line(name, 100)), run.path(),
                "give --follow none, or a body, for example: " + listed(nearest_names(name, known)));
  return name;
}

Json settings_of(const PictureRequest& request) {
  Json settings{{"colouring", request.colouring}, {"arrows", false}};
  if (request.exaggeration) settings["exaggeration"] = *request.exaggeration;
  if (!request.stress_unit.empty()) settings["stressUnit"] = request.stress_unit;
  for (const std::string& thing : request.shown) settings[settings_of_things.at(thing)] = true;
  for (const std::string& thing : request.hidden) settings[settings_of_things.at(thing)] = false;
  return settings;
}

Json still_of(const PictureRequest& request, const formats::ResultsReader& run) {
  Json still{{"width", request.size[0]},
             {"height", request.size[1]},
             {"times", Json::array()},
             {"view", view_of(request.view)},
             {"zoom", request.zoom},
             {"traces", request.traces},
             {"captions", request.captions == Captions::written},
             {"settings", settings_of(request)}};
  for (const int side : request.size)
    if (side < smallest_side || side > largest_side)
      throw Error(
          fmt::format("a picture of {} x {} pixels is too small or too large", request.size[0], request.size[1]),
          "picture", fmt::format("give --size with {} to {} pixels a side", smallest_side, largest_side));
  require_nodes(request.traces, run);
  if (request.follow) still["follow"] = followed_of(*request.follow, run);
  if (request.mode == 0) {
    still["times"] = times_of(request, run);
    return still;
  }
  if (request.mode > static_cast<int>(run.modes()))
    throw Error(fmt::format("holds {} modes, but not mode {}", run.modes(), request.mode), run.path(),
                "modes come from `analysis: modes`");
  still["mode"] = request.mode - 1;
  still["phases"] = Json::array();
  for (const double phase : request.phases_deg.empty() ? std::vector<double>{0.0} : request.phases_deg)
    still["phases"].push_back(phase * radian);
  return still;
}

/// Page file beside the picture, removed after drawing.
class PageFile {
 public:
  PageFile(const std::string& beside, const std::string& text)
      : path_(temporary_beside(is_stream(beside) ? "picture" : beside) + ".html") {
    write_text_file(path_, text);
  }
  ~PageFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  PageFile(const PageFile&) = delete;
  PageFile& operator=(const PageFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

const std::vector<std::string>& picture_things() {
  static const std::vector<std::string> things = [] {
    std::vector<std::string> names;
    for (const auto& [name, setting] : settings_of_things) names.push_back(name);
    return names;
  }();
  return things;
}

std::string picture(const PictureRequest& request) {
  if (request.page.shown.files.empty())
    throw Error("no results file is given", "picture", "name one or more *.results.h5");
  if (!request.output.ends_with(".png") && !is_stream(request.output))
    throw Error("pictures are PNG files", request.output, "end its name with .png");
  const Json still = still_of(request, formats::ResultsReader(request.page.shown.files[0]));
  ViewRequest shown = request.page;
  shown.shapes.stress = shown.shapes.stress || request.colouring == "stress";
  const PageFile page(request.output, page_of(shown));
  const std::string png =
      base64_decoded(asked_of_page(page.path(), "tisserand.still(" + still.dump() + ")", request.sandbox));
  if (png.empty())
    throw Error("the picture would be empty: no body is in view", request.output,
                "change --view, --zoom, --exaggerate, --follow or --hide; `mechanism view` shows where the bodies are");
  TISSERAND_ENSURE(png.starts_with("\x89PNG"), "the page gave {} bytes that are no PNG", png.size());
  write_text_file(request.output, formats::with_producer(png, producer("mechanism")));
  return fmt::format("picture: {} ({} x {} pixels, {:.0f} kB)\n", request.output, request.size[0], request.size[1],
                     1e-3 * static_cast<double>(png.size()));
}

}  // namespace tisserand::mechanism
