// SPDX-License-Identifier: GPL-3.0-or-later
// Corners and limits of the shapes of sections/profiles.hpp.
#include "formats/sections/profiles.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/error.hpp"
#include "formats/sections/shapes.hpp"

namespace tisserand::formats {
namespace {

Ring rectangle(double left, double bottom, double right, double top) {
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

struct FlangedSizes {
  double height, width, web, flange;
};
FlangedSizes flanged(const std::vector<double>& s) { return {s[0], s[1], s[2], s[3]}; }

Ring i_ring(const std::vector<double>& s) {
  const double h = s[0], top = 0.5 * s[1], w = 0.5 * s[2], tf = s[3], bottom = 0.5 * s[4], bf = s[5];
  return {{-bottom, 0}, {bottom, 0}, {bottom, bf},   {w, bf},      {w, h - tf}, {top, h - tf},
          {top, h},     {-top, h},   {-top, h - tf}, {-w, h - tf}, {-w, bf},    {-bottom, bf}};
}

Ring channel_ring(const FlangedSizes& s) {
  return {{0, 0},
          {s.width, 0},
          {s.width, s.flange},
          {s.web, s.flange},
          {s.web, s.height - s.flange},
          {s.width, s.height - s.flange},
          {s.width, s.height},
          {0, s.height}};
}

Ring angle_ring(const FlangedSizes& s) {
  return {{0, 0}, {s.width, 0}, {s.width, s.flange}, {s.web, s.flange}, {s.web, s.height}, {0, s.height}};
}

Ring tee_ring(const FlangedSizes& s) {
  const double w = 0.5 * s.web, b = 0.5 * s.width, z = s.height - s.flange;
  return {{-w, 0}, {w, 0}, {w, z}, {b, z}, {b, s.height}, {-b, s.height}, {-b, z}, {-w, z}};
}

Ring zed_ring(const FlangedSizes& s) {
  const double left = s.web - s.width, z = s.height - s.flange;
  return {{left, 0},           {s.web, 0},    {s.web, z},    {s.width, z},
          {s.width, s.height}, {0, s.height}, {0, s.flange}, {left, s.flange}};
}

Ring hat_ring(const std::vector<double>& s) {
  const double h = s[0], b = 0.5 * s[1], brim = s[2], t = s[3];
  return {{-b - brim, 0}, {-b + t, 0}, {-b + t, h - t}, {b - t, h - t}, {b - t, 0}, {b + brim, 0},
          {b + brim, t},  {b, t},      {b, h},          {-b, h},        {-b, t},    {-b - brim, t}};
}

Ring cross_ring(const FlangedSizes& s) {
  const double b = 0.5 * s.width, h = 0.5 * s.height, w = 0.5 * s.web, f = 0.5 * s.flange;
  return {{w, -h}, {w, -f}, {b, -f}, {b, f}, {w, f}, {w, h}, {-w, h}, {-w, f}, {-b, f}, {-b, -f}, {-w, -f}, {-w, -h}};
}

/// Sizes whose sum must be less than an outer measure, as indices.
struct Limit {
  std::vector<std::size_t> parts;
  std::size_t whole;
};

std::vector<Limit> limits(std::string_view shape) {
  if (shape == "I") return {{{2}, 1}, {{2}, 4}, {{3, 5}, 0}};
  if (shape == "channel" || shape == "zed") return {{{2}, 1}, {{3, 3}, 0}};
  if (shape == "box") return {{{2, 3}, 0}, {{4, 5}, 1}};
  if (shape == "hat") return {{{3, 3}, 1}, {{3, 3}, 0}};
  return {{{2}, 1}, {{3}, 0}};
}

}  // namespace

const std::vector<Profile>& profiles() {
  static const std::vector<Profile> all{
      {"I",
       {"height", "width", "web", "flange", "bottom_width", "bottom_flange"},
       "outer `height` along z; `width` and `flange` thickness of the upper flange; `web` thickness; `bottom_width`, "
       "`bottom_flange` if the lower one differs: `{shape: I, height: 0.2, width: 0.1, web: 0.006, flange: 0.009}`"},
      {"channel",
       {"height", "width", "web", "flange"},
       "outer `height`, `width`; `web` (at the left), `flange` (to +y): `{shape: channel, height: 0.1, width: 0.05, "
       "web: 0.005, flange: 0.008}`"},
      {"angle",
       {"height", "width", "web", "flange"},
       "outer `height`, `width`; `web` stands at the left end of the `flange`: `{shape: angle, height: 0.06, width: "
       "0.04, web: 0.005, flange: 0.005}`"},
      {"tee",
       {"height", "width", "web", "flange"},
       "outer `height`, `width`; `web`, `flange` at the top: `{shape: tee, height: 0.06, width: 0.05, web: 0.005, "
       "flange: 0.006}`"},
      {"zed",
       {"height", "width", "web", "flange"},
       "outer `height`, `width` of each flange with the web; `web`, `flange`: upper one to +y, lower one to -y: "
       "`{shape: zed, height: 0.08, width: 0.04, web: 0.003, flange: 0.003}`"},
      {"box",
       {"height", "width", "top", "bottom", "left", "right"},
       "outer `height`, `width`; walls `top`, `bottom`, `left`, `right`: `{shape: box, height: 0.1, width: 0.06, top: "
       "0.004, bottom: 0.006, left: 0.003, right: 0.003}`"},
      {"hat",
       {"height", "width", "brim", "thickness"},
       "outer `height`, `width` of the top, `brim` of each side at the open bottom, `thickness`: `{shape: hat, height: "
       "0.05, width: 0.04, brim: 0.015, thickness: 0.002}`"},
      {"cross",
       {"height", "width", "web", "flange"},
       "outer `height`, `width`; `web` of the upright, `flange` of the horizontal: `{shape: cross, height: 0.1, width: "
       "0.08, web: 0.01, flange: 0.006}`"}};
  return all;
}

const Profile* find_profile(std::string_view shape) {
  const auto found = std::find_if(profiles().begin(), profiles().end(),
                                  [shape](const Profile& profile) { return profile.shape == shape; });
  return found == profiles().end() ? nullptr : &*found;
}

std::optional<std::string> profile_fault(std::string_view shape, const std::vector<double>& sizes) {
  const Profile* profile = find_profile(shape);
  TISSERAND_ENSURE(profile != nullptr, "shape '{}'", shape);
  if (sizes.size() != profile->keys.size())
    return fmt::format("{} sizes instead of {}", sizes.size(), profile->keys.size());
  for (std::size_t i = 0; i < sizes.size(); ++i)
    if (!(sizes[i] > 0.0) || !std::isfinite(sizes[i]))
      return fmt::format("{} {:g} must be positive", profile->keys[i], sizes[i]);
  for (const Limit& limit : limits(shape)) {
    double sum = 0.0;
    std::string words;
    for (const std::size_t part : limit.parts) {
      sum += sizes[part];
      words += fmt::format("{}{} {:g}", words.empty() ? "" : " + ", profile->keys[part], sizes[part]);
    }
    if (!(sum < sizes[limit.whole] * (1.0 - 1e-9)))
      return fmt::format("{} is not less than {} {:g}", words, profile->keys[limit.whole], sizes[limit.whole]);
  }
  return std::nullopt;
}

SectionPolygon profile_polygon(std::string_view shape, const std::vector<double>& sizes) {
  if (shape == "I") return {i_ring(sizes), {}};
  if (shape == "channel") return {channel_ring(flanged(sizes)), {}};
  if (shape == "angle") return {angle_ring(flanged(sizes)), {}};
  if (shape == "tee") return {tee_ring(flanged(sizes)), {}};
  if (shape == "zed") return {zed_ring(flanged(sizes)), {}};
  if (shape == "hat") return {hat_ring(sizes), {}};
  if (shape == "cross") return {cross_ring(flanged(sizes)), {}};
  const double height = sizes[0], width = sizes[1];
  return {rectangle(0, 0, width, height), {rectangle(sizes[4], sizes[3], width - sizes[5], height - sizes[2])}};
}

Section profile_section(std::string_view shape, const std::vector<double>& sizes) {
  Section section = polygon_section(profile_polygon(shape, sizes));
  section.shape = shape;
  section.sizes = sizes;
  return section;
}

Section shape_section(std::string_view shape, const std::vector<double>& sizes) {
  if (shape == "circle") return circle_section(sizes[0]);
  if (shape == "hollow_circle") return hollow_circle_section(sizes[0], sizes[1]);
  if (shape == "rectangle") return rectangle_section(sizes[0], sizes[1]);
  if (shape == "hollow_rectangle") return hollow_rectangle_section(sizes[0], sizes[1], sizes[2]);
  return profile_section(shape, sizes);
}

}  // namespace tisserand::formats
