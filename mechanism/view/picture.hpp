// SPDX-License-Identifier: GPL-3.0-or-later
// `mechanism picture`: states of runs as one PNG, drawn by the page of `mechanism view` in a browser without a window.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/view/browser.hpp"
#include "mechanism/view/view.hpp"

namespace tisserand::mechanism {

enum class Captions { written, none };

inline const std::vector<std::string> picture_views{"iso", "front", "back", "left", "right", "top", "bottom"};
inline const std::vector<std::string> picture_colourings{"body", "displacement", "deformation", "stress"};
inline const std::vector<std::string> picture_stress_units{"Pa", "kPa", "MPa", "GPa"};

struct PictureRequest {
  ViewRequest page;                    ///< runs and shapes; its own output is not written
  std::string output;                  ///< .png
  std::vector<double> times;           ///< states from left to right, in units of the runs; empty: the last instant
  int mode = 0;                        ///< number of a mode, from 1, instead of times; 0: none
  std::vector<double> phases_deg;      ///< phases of the mode, states from left to right; empty: 0
  std::array<int, 2> size{1200, 700};  ///< pixels, width and height
  std::string view = "iso";            ///< a name of picture_views, or "azimuth,elevation" of the camera in degrees
  double zoom = 1.0;                   ///< 1: the shown objects fill the picture
  std::optional<double> exaggeration;  ///< factor of deformations; absent: 1, or a round factor if motion is invisible
  std::optional<std::string> follow;   ///< body to follow, or "none"; absent: one, if all leave their place
  std::string stress_unit;             ///< one of picture_stress_units; empty: that of the scene, MPa if lengths are mm
  std::string colouring = "body";      ///< one of picture_colourings
  std::vector<std::string> traces;     ///< nodes whose paths are drawn
  std::vector<std::string> shown, hidden;  ///< names of picture_things()
  Captions captions = Captions::written;
  Sandbox sandbox = Sandbox::on;
};

/// Objects that can be shown or hidden: edges, grid, axes, ...
const std::vector<std::string>& picture_things();

/// Writes the picture, completely or not at all. The same page and browser give the same bytes. Returns one line about
/// it. Throws Error: no such time, mode, node or body, nothing visible, no browser (asked_of_page()).
std::string picture(const PictureRequest& request);

}  // namespace tisserand::mechanism
