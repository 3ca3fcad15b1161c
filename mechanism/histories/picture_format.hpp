// SPDX-License-Identifier: GPL-3.0-or-later
// Kind, size and font of a picture, in the form of gnuplot's terminals.
#pragma once

#include <optional>
#include <string>

namespace tisserand::mechanism {

struct PictureSize {
  double width = 0.0, height = 0.0;  ///< pixels, or millimetres on paper
  bool on_paper = false;
};

struct PictureFont {
  std::string name;            ///< empty: the default
  std::optional<double> size;  ///< points on paper, pixels on a screen; absent: by the size of the picture
};

/// Parses "1400x800", "1400x800px", "160x100mm", "16x10cm", "6.3x4in". Throws Error.
PictureSize parse_picture_size(const std::string& text);

/// Parses "9", "Helvetica", or "DejaVu Sans,9". Throws Error.
PictureFont parse_picture_font(const std::string& text);

/// Drawing area of a picture.
struct Canvas {
  std::string terminal;    ///< command for gnuplot
  double title_size = 20;  ///< font size of titles, in the units of the terminal
  double columns = 0.0;    ///< approximate number of letters in the width
  double lines = 0.0;      ///< approximate number of lines in the height
};

/// Canvas by the ending of the picture. .png and .svg are in pixels (.png on paper at 300 pixels per inch), .pdf and
/// .eps on paper (a pixel is 1/96 inch). Without `size`: 1400 x 800 pixels, or 160 x 100 mm, higher for several panels
/// and long legends (`rows` of letters). Throws Error for another ending.
Canvas canvas_of(const std::string& picture, const std::optional<PictureSize>& size, const PictureFont& font,
                 std::size_t panels, std::size_t rows);

}  // namespace tisserand::mechanism
