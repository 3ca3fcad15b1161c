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

/// Whether a picture has captions.
enum class Captions { written, none };

inline const std::vector<std::string> picture_views{"iso", "front", "back", "left", "right", "top", "bottom"};
inline const std::vector<std::string> picture_colourings{"body", "displacement", "deformation", "stress"};
inline const std::vector<std::string> picture_stress_units{"Pa", "kPa", "MPa", "GPa"};

/// Request for a picture: runs, states, camera, colours and the output file.
struct PictureRequest {
  ViewRequest page;    ///< runs and shapes of the page that draws the picture; this page is not kept
  std::string output;  ///< path that ends in .png
  /// Instants of the drawn states from left to right, in units of the runs; empty: the last instant.
  std::vector<double> times;
  int mode = 0;                        ///< number of a mode, from 1, instead of times; 0: none
  std::vector<double> phases_deg;      ///< phases of the mode for the states from left to right [deg]; empty: 0
  std::array<int, 2> size{1200, 700};  ///< width and height [pixel]
  std::string view = "iso";            ///< camera: a name of picture_views, or "azimuth,elevation" in degrees
  double zoom = 1.0;                   ///< magnification; 1: the shown objects fill the picture
  /// Factor of deformations. Absent: 1, or a round factor if the motion would be invisible.
  std::optional<double> exaggeration;
  /// Name of the body that the camera follows, or "none". Absent: one is chosen if all bodies leave their place.
  std::optional<std::string> follow;
  /// Unit of stresses, one of picture_stress_units. Empty: that of the scene, or MPa if lengths are in mm.
  std::string stress_unit;
  std::string colouring = "body";          ///< colours of bodies, one of picture_colourings
  std::vector<std::string> traces;         ///< names of nodes whose paths are drawn
  std::vector<std::string> shown, hidden;  ///< objects to show and to hide, names of picture_things()
  Captions captions = Captions::written;
  Sandbox sandbox = Sandbox::on;
};

/// Names of the objects that can be shown or hidden: edges, grid, axes, ...
const std::vector<std::string>& picture_things();

/// Writes the picture file, completely or not at all. The same page and browser give the same bytes. Returns one line
/// about the picture. Throws Error if a time, mode, node or body does not exist, if nothing is visible, or if
/// asked_of_page() fails.
std::string picture(const PictureRequest& request);

}  // namespace tisserand::mechanism
