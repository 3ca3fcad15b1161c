// SPDX-License-Identifier: GPL-3.0-or-later
// Two views and their labels on one canvas, by gnuplot.
#include "reducer/survey/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/gnuplot.hpp"
#include "common/output_path.hpp"
#include "common/program/version.hpp"
#include "common/text.hpp"
#include "formats/page/picture_mark.hpp"
#include "reducer/survey/labels.hpp"
#include "reducer/survey/page.hpp"
#include "reducer/survey/pieces.hpp"
#include "reducer/survey/projection.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int panel_width = 900, panel_height = 780, head = 70, foot = 70;  // pixels
constexpr std::size_t longest_label = 24;

struct Panel {
  PictureView view;
  PictureProjection projection;
  std::vector<SeenPlace> seen;
  std::vector<PictureLabel> labels;
};

std::string label_of(const FacePiece& piece) { return printable_line(piece.label, longest_label); }

/// Places labels in each panel on the face if they fit; the others next to it in the panel that shows it best. Returns
/// the labels of faces that are hidden, or too crowded for a name.
std::vector<std::string> place_labels(const std::vector<FacePiece>& pieces, std::array<Panel, 2>& panels) {
  std::array<LabelPlacer, 2> placers{LabelPlacer(panels[0].projection), LabelPlacer(panels[1].projection)};
  std::vector<std::size_t> left;
  for (std::size_t f = 0; f < pieces.size(); ++f) {
    if (pieces[f].label.empty()) continue;
    bool is_written = false;
    for (std::size_t p = 0; p < 2; ++p) {
      if (!fits_inside(panels[p].seen[f], label_of(pieces[f]))) continue;
      placers[p].write_inside(label_of(pieces[f]), panels[p].seen[f]);
      is_written = true;
    }
    if (!is_written) left.push_back(f);
  }
  std::vector<std::string> missing;
  for (const std::size_t f : left) {
    const std::size_t p = panels[0].seen[f].radius >= panels[1].seen[f].radius ? 0 : 1;
    const bool is_seen = panels[p].seen[f].radius >= 1.0;
    if (!is_seen || !placers[p].write_beside(label_of(pieces[f]), panels[p].seen[f]))
      missing.push_back(label_of(pieces[f]));
  }
  for (std::size_t p = 0; p < 2; ++p) panels[p].labels = placers[p].labels();
  return missing;
}

Panel panel_from(const Vector3d& eye, const std::vector<ColouredSurface>& surfaces,
                 const std::vector<Vector3d>& position, const std::vector<Vector3d>& seen) {
  const PictureView view = view_from(eye, seen, panel_width, panel_height);
  Panel panel{view, PictureProjection(surfaces, position, view, panel_width, panel_height), {}, {}};
  panel.seen = panel.projection.seen_places();
  return panel;
}

/// Gnuplot lines for the axes in the lower left corner of a panel.
std::string axes_script(const Panel& panel, double left) {
  constexpr double length = 42.0;
  constexpr std::array names{"x", "y", "z"};
  constexpr std::array colours{"#c23b3b", "#3c8d3c", "#3b62c2"};
  const Vector2d origin(left + 70.0, head + panel_height - 55.0);
  std::string script;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector2d d(panel.view.R_VW(0, axis), -panel.view.R_VW(1, axis));
    const Vector2d end = origin + length * d, name = origin + (length + 14.0) * d;
    script += fmt::format("set arrow from {:.1f},{:.1f} to {:.1f},{:.1f} front lw 2 lc rgb '{}'\n", origin.x(),
                          origin.y(), end.x(), end.y(), colours[axis]);
    script += fmt::format("set label '{}' at {:.1f},{:.1f} center front tc rgb '{}'\n", names[axis], name.x(), name.y(),
                          colours[axis]);
  }
  return script;
}

std::string labels_script(const Panel& panel, double left) {
  std::string script;
  for (const PictureLabel& label : panel.labels) {
    const Vector2d at = label.at + Vector2d(left, head), point = label.point + Vector2d(left, head);
    if (label.is_led) {
      // The line ends at the box around the text.
      const Vector2d away = point - at, half = 0.5 * text_size(label.text);
      const double share =
          std::min(half.x() / std::max(std::abs(away.x()), 1e-9), half.y() / std::max(std::abs(away.y()), 1e-9));
      const Vector2d end = at + std::min(1.0, share) * away;
      script += fmt::format("set arrow from {:.1f},{:.1f} to {:.1f},{:.1f} nohead front lw 1 lc rgb '#222222'\n",
                            end.x(), end.y(), point.x(), point.y());
    }
    script += fmt::format("set label {} at {:.1f},{:.1f} center front {} noenhanced tc rgb '#111111'\n",
                          gnuplot_quoted(label.text), at.x(), at.y(), label.is_led ? "boxed" : "");
  }
  return script;
}

/// Polygons of a panel as gnuplot data: corners and colour, in the order of painting.
std::string polygons_data(const Panel& panel, double left) {
  std::string data;
  for (const PaintedPolygon& polygon : panel.projection.polygons()) {
    const auto byte = [](double part) {
      return static_cast<unsigned>(std::lround(255.0 * std::clamp(part, 0.0, 1.0)));
    };
    const unsigned colour =
        (byte(polygon.colour[0]) << 16U) | (byte(polygon.colour[1]) << 8U) | byte(polygon.colour[2]);
    for (const Vector2d& corner : polygon.corners)
      data += fmt::format("{:.2f} {:.2f} {}\n", corner.x() + left, corner.y() + head, colour);
    data += '\n';
  }
  return data;
}

std::string faces_script(const std::array<Panel, 2>& panels, const std::array<std::string, 4>& texts, bool is_svg) {
  constexpr int width = 2 * panel_width, height = head + panel_height + foot;
  std::string script = fmt::format(
      "set terminal {} size {},{} font 'sans,15' background 'white'\nset encoding utf8\n"
      "unset border\nunset tics\nunset key\nset margins 0,0,0,0\nset xrange [0:{}]\nset yrange [{}:0]\n"
      "set style textbox opaque fillcolor rgb 'white' noborder margins 0.4,0.4\n",
      is_svg ? "svg" : "pngcairo", width, height, width, height);
  const auto write = [&script](const std::string& text, double x, double y, const char* style) {
    script += fmt::format("set label {} at {:.1f},{:.1f} {} front noenhanced\n",
                          gnuplot_quoted(printable_line(text, 300)), x, y, style);
  };
  write(texts[0], 0.5 * width, 24, "center font ',20'");
  write(texts[1], 0.5 * panel_width, 54, "center tc rgb '#555555'");
  write(texts[2], 1.5 * panel_width, 54, "center tc rgb '#555555'");
  write(texts[3], 0.5 * width, height - 0.5 * foot, "center tc rgb '#555555'");
  for (std::size_t p = 0; p < 2; ++p) {
    const double left = static_cast<double>(p) * panel_width;
    script += axes_script(panels[p], left) + labels_script(panels[p], left);
  }
  script += "$faces << END\n" + polygons_data(panels[0], 0.0) + polygons_data(panels[1], panel_width) + "END\n";
  return script +
         "plot $faces using 1:2:3 with filledcurves closed fillstyle solid noborder fillcolor rgb variable\nunset "
         "output\n";
}

/// Positions of the nodes of the pieces; other nodes of the file are ignored.
std::vector<Vector3d> positions_of(const std::vector<FacePiece>& pieces, const std::vector<Vector3d>& position) {
  std::set<int> nodes;
  for (const FacePiece& piece : pieces)
    for (const Cell& cell : piece.cells) nodes.insert(corners_of(cell).begin(), corners_of(cell).end());
  std::vector<Vector3d> result;
  for (const int node : nodes) result.push_back(position[node]);
  return result;
}

void draw_picture(const Survey& survey, const std::vector<FacePiece>& pieces, const std::string& title,
                  const std::string& output) {
  std::vector<ColouredSurface> surfaces;
  for (const FacePiece& piece : pieces) surfaces.push_back({piece.cells, piece.colour});
  const std::vector<Vector3d> seen = positions_of(pieces, survey.position);
  const Vector3d eye(0.75, -1.0, 0.75);
  std::array<Panel, 2> panels{panel_from(eye, surfaces, survey.position, seen),
                              panel_from(-eye, surfaces, survey.position, seen)};
  const std::vector<std::string> missing = place_labels(pieces, panels);
  const std::array<std::string, 4> texts{
      title, "from the front, right and above", "from behind, left and below",
      missing.empty() ? "" : "not shown, because they are hidden in both views or too small: " + listed(missing)};
  write_text_file(output,
                  formats::with_producer(gnuplot_picture(faces_script(panels, texts, output.ends_with(".svg")), output),
                                         producer("reducer")));
}

}  // namespace

void check_faces_output(const std::string& output) {
  if (is_stream(output)) return;
  for (const char* ending : {".html", ".png", ".svg"})
    if (output.ends_with(ending)) return;
  throw Error(
      "the picture of the faces must be a .html, .png or .svg file", output,
      "give -o a name with one of these endings: .html is a page that can be turned, the others show two views");
}

void draw_faces(const Survey& survey, const std::string& source, const std::string& output) {
  check_faces_output(output);
  const std::vector<FacePiece> pieces = face_pieces(survey);
  if (std::ranges::none_of(pieces, [](const FacePiece& piece) { return !piece.label.empty(); }))
    throw Error("there is nothing to draw: no faces, and no sets of shells or of nodes on faces", source,
                "use `reducer view` for a part of beams; without -o, `reducer groups` lists all groups and sets");
  const std::string title = std::filesystem::path(source).filename().string();
  if (output.ends_with(".html"))
    write_text_file(output, faces_page(survey, pieces, title, source));
  else
    draw_picture(survey, pieces, title, output);
}

}  // namespace tisserand::reducer
