// SPDX-License-Identifier: GPL-3.0-or-later
// File endings and sizes as terminals of gnuplot.
#include "mechanism/histories/picture_format.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/gnuplot.hpp"
#include "common/output_path.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

constexpr double millimetres_per_inch = 25.4, pixels_per_inch = 96.0, print_pixels_per_inch = 300.0,
                 points_per_inch = 72.0;

std::optional<double> number_at(std::string_view text) {
  double value = 0.0;
  const auto [rest, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || rest != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

struct LengthUnit {
  std::string_view name;
  double factor;
  bool on_paper;
};
constexpr std::array length_units{LengthUnit{"mm", 1.0, true}, LengthUnit{"cm", 10.0, true},
                                  LengthUnit{"in", millimetres_per_inch, true}, LengthUnit{"px", 1.0, false}};

enum class PictureKind { png, svg, pdf, eps };

PictureKind kind_of(const std::string& picture) {
  if (picture.ends_with(".png") || is_stream(picture)) return PictureKind::png;
  if (picture.ends_with(".svg")) return PictureKind::svg;
  if (picture.ends_with(".pdf")) return PictureKind::pdf;
  if (picture.ends_with(".eps")) return PictureKind::eps;
  throw Error("'" + picture + "' is not a .png, .svg, .pdf or .eps file", "plot",
              "give -o a name that ends in .png, .svg, .pdf or .eps");
}

}  // namespace

PictureSize parse_picture_size(const std::string& text) {
  std::string_view rest = text;
  PictureSize size;
  double factor = 1.0;
  for (const LengthUnit& unit : length_units)
    if (rest.ends_with(unit.name)) {
      rest.remove_suffix(unit.name.size());
      factor = unit.factor;
      size.on_paper = unit.on_paper;
      break;
    }
  const std::size_t middle = rest.find('x');
  const auto width = number_at(rest.substr(0, middle));
  const auto height = middle == std::string_view::npos ? std::nullopt : number_at(rest.substr(middle + 1));
  if (!width || !height)
    throw Error(fmt::format("'{}' is not a size", printable_line(text, 60)), "--size",
                "write width x height, such as 1400x800 (pixels), 160x100mm, 16x10cm or 6.3x4in");
  size.width = *width * factor;
  size.height = *height * factor;
  const double least = size.on_paper ? 30.0 : 150.0, most = size.on_paper ? 1200.0 : 10000.0;
  if (std::min(size.width, size.height) < least || std::max(size.width, size.height) > most)
    throw Error(fmt::format("a picture of {} is too small or too large", text), "--size",
                fmt::format("choose sides from {:g} to {:g} {}", least, most, size.on_paper ? "mm" : "pixels"));
  return size;
}

PictureFont parse_picture_font(const std::string& text) {
  PictureFont font;
  const std::size_t comma = text.rfind(',');
  const std::string last = comma == std::string::npos ? text : text.substr(comma + 1);
  font.size = number_at(last);
  if (!font.size && comma == std::string::npos)
    font.name = text;
  else if (comma != std::string::npos)
    font.name = text.substr(0, comma);
  const bool has_bad_size = font.size ? !(*font.size >= 3.0 && *font.size <= 200.0) : comma != std::string::npos;
  if (has_bad_size || font.name.find(',') != std::string::npos || (font.name.empty() && !font.size))
    throw Error(fmt::format("'{}' is not a font", printable_line(text, 60)), "--font",
                "write a name, a size from 3 to 200, or both: 'DejaVu Sans,9'");
  return font;
}

Canvas canvas_of(const std::string& picture, const std::optional<PictureSize>& size, const PictureFont& font,
                 std::size_t panels, std::size_t rows) {
  const PictureKind kind = kind_of(picture);
  const bool is_vector_print = kind == PictureKind::pdf || kind == PictureKind::eps;
  const bool on_paper = size ? size->on_paper : is_vector_print;
  // pixels of a screen; paper has 96 per inch
  const double per_millimetre = pixels_per_inch / millimetres_per_inch;
  double width = on_paper ? 160.0 * per_millimetre : 1400.0;
  if (size) width = size->width * (on_paper ? per_millimetre : 1.0);
  const double usual = kind == PictureKind::png ? 22.0 : 17.0;  // for a picture of 1400 pixels width
  const double letters = on_paper ? 9.0 * pixels_per_inch / points_per_inch : std::max(11.0, usual * width / 1400.0);
  const double pixels =
      !font.size ? letters : *font.size * (on_paper || is_vector_print ? pixels_per_inch / points_per_inch : 1.0);
  double height =
      (on_paper ? 100.0 * per_millimetre : 800.0) * (panels == 1 ? 1.0 : 0.25 + 0.5 * static_cast<double>(panels));
  height += static_cast<double>(rows) * 1.3 * pixels;
  if (size) height = size->height * (on_paper ? per_millimetre : 1.0);
  const double line = on_paper ? 0.75 : 1.4 * std::max(0.7, width / 1400.0);
  const std::string name = font.name.empty() ? "sans" : font.name;
  const auto quoted = [&](double points) { return gnuplot_quoted(fmt::format("{},{:.6g}", name, points)); };
  Canvas canvas;
  canvas.columns = width / (0.6 * pixels);
  canvas.lines = height / (1.3 * pixels);
  // The cairo terminals take font sizes in points of 1/72 inch but draw them at 96 per inch.
  constexpr double cairo = points_per_inch / pixels_per_inch;
  if (is_vector_print) {
    const double points = pixels * points_per_inch / pixels_per_inch * cairo;
    canvas.terminal =
        fmt::format("set terminal {} size {:.6g}in,{:.6g}in font {} fontscale 1 linewidth {:.4g} background 'white'\n",
                    kind == PictureKind::pdf ? "pdfcairo" : "epscairo", width / pixels_per_inch,
                    height / pixels_per_inch, quoted(points), line);
    canvas.title_size = 1.15 * points;
    return canvas;
  }
  const double scale = kind == PictureKind::png && on_paper ? print_pixels_per_inch / pixels_per_inch : 1.0;
  const double size_of_font = scale * pixels * (kind == PictureKind::png ? cairo : 1.0);
  canvas.terminal = fmt::format("set terminal {} size {:.0f},{:.0f} font {} linewidth {:.4g} background 'white'\n",
                                kind == PictureKind::png ? "pngcairo" : "svg", scale * width, scale * height,
                                quoted(size_of_font), scale * line);
  canvas.title_size = 1.15 * size_of_font;
  return canvas;
}

}  // namespace tisserand::mechanism
