// Kind, size and font of a picture, as gnuplot's terminals take them.
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
  std::optional<double> size;  ///< points on paper, pixels on a screen; absent: what suits the size
};

/// "1400x800", "1400x800px", "160x100mm", "16x10cm", "6.3x4in". Throws Error.
PictureSize parse_picture_size(const std::string& text);

/// "9", "Helvetica", or "DejaVu Sans,9". Throws Error.
PictureFont parse_picture_font(const std::string& text);

/// What a picture is drawn on.
struct Canvas {
  std::string terminal;    ///< gnuplot's line
  double title_size = 20;  ///< of fonts, in the units of the terminal
  double columns = 0.0;    ///< letters of the font that the width holds, about
  double lines = 0.0;      ///< lines of it that the height holds, about
};

/// By the ending of the picture: .png and .svg in pixels (.png on paper at 300 pixels per inch), .pdf and .eps on paper
/// (a pixel is 1/96 inch). `size` absent: 1400 x 800 pixels, or 160 x 100 mm; more height for several panels and long
/// legends (`rows` of letters). Throws Error for another ending.
Canvas canvas_of(const std::string& picture, const std::optional<PictureSize>& size, const PictureFont& font,
                 std::size_t panels, std::size_t rows);

}  // namespace tisserand::mechanism
