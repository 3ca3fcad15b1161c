// SPDX-License-Identifier: GPL-3.0-or-later
// Kind, size and font of a picture, in the form of gnuplot's terminals.
#pragma once

#include <optional>
#include <string>

namespace tisserand::mechanism {

/// Width and height of a picture.
struct PictureSize {
  double width = 0.0, height = 0.0;  ///< size in pixels, or in millimetres on paper
  bool on_paper = false;             ///< whether the size is in millimetres
};

/// Font of a picture.
struct PictureFont {
  std::string name;  ///< name of the font; empty: the default
  /// Size of letters: points on paper, pixels on a screen. Absent: by the size of the picture.
  std::optional<double> size;
};

/// Parses a size of a picture: "1400x800", "1400x800px", "160x100mm", "16x10cm", "6.3x4in". Throws Error.
PictureSize parse_picture_size(const std::string& text);

/// Parses a font with or without a size: "9", "Helvetica", or "DejaVu Sans,9". Throws Error.
PictureFont parse_picture_font(const std::string& text);

/// Drawing area of a picture, for gnuplot.
struct Canvas {
  std::string terminal;    ///< command for gnuplot
  double title_size = 20;  ///< font size of titles, in the units of the terminal
  double columns = 0.0;    ///< approximate number of letters in the width
  double lines = 0.0;      ///< approximate number of lines in the height
};

/// Drawing area for the picture file `picture`, by its ending. .png and .svg are in pixels (.png on paper at 300 pixels
/// per inch), .pdf and .eps on paper (a pixel is 1/96 inch). Without `size` it is 1400 x 800 pixels or 160 x 100 mm,
/// and higher for several panels and long legends. `rows`: rows of letters in the legends. Throws Error for another
/// ending.
Canvas canvas_of(const std::string& picture, const std::optional<PictureSize>& size, const PictureFont& font,
                 std::size_t panels, std::size_t rows);

}  // namespace tisserand::mechanism
