// SPDX-License-Identifier: GPL-3.0-or-later
// Rows and columns of the table of forms.
#include "reducer/survey/form_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace tisserand::reducer {
namespace {

using FormCells = std::array<std::string, 6>;

std::string side_text(const FaceFacts& facts) {
  if (facts.form.kind == FormKind::plane) return facts.is_outward ? "outward" : "";
  switch (facts.side) {
    case FaceSide::convex:
      return "convex";
    case FaceSide::concave:
      return "concave";
    case FaceSide::unknown:
      break;
  }
  return "";
}

/// Sizes of a form: "4", "20, 5" for a torus, "30 deg" for a cone.
std::string radius_text(const SurfaceForm& form) {
  switch (form.kind) {
    case FormKind::cylinder:
    case FormKind::sphere:
      return fmt::format("{:.6g}", form.radius);
    case FormKind::torus:
      return fmt::format("{:.6g}, {:.6g}", form.radius, form.minor_radius);
    case FormKind::cone:
      return fmt::format("{:.6g} deg", form.half_angle * 180.0 / std::numbers::pi);
    case FormKind::plane:
    case FormKind::curved:
      break;
  }
  return "";
}

bool has_axis(FormKind kind) { return kind != FormKind::sphere && kind != FormKind::curved; }
bool has_point(FormKind kind) { return kind != FormKind::plane && kind != FormKind::curved; }

/// Direction as text, with 0 for components that are only round-off.
std::string direction_text(const Eigen::Vector3d& axis) {
  return point_text(axis.unaryExpr([](double v) { return std::abs(v) < 1e-7 ? 0.0 : v; }));
}

/// Point as text, with 0 for coordinates that are only round-off relative to the face.
std::string place_text(const SurveyedFace& face) {
  const double small = 1e-7 * (std::sqrt(face.facts.area) + face.facts.center.norm());
  return point_text(face.facts.form.point.unaryExpr([small](double v) { return std::abs(v) < small ? 0.0 : v; }));
}

FormCells form_row(const SurveyedFace& face) {
  const SurfaceForm& form = face.facts.form;
  return {face.name,
          form_word(form.kind),
          side_text(face.facts),
          radius_text(form),
          has_axis(form.kind) ? direction_text(form.axis) : "",
          has_point(form.kind) ? place_text(face) : ""};
}

}  // namespace

std::string point_text(const Eigen::Vector3d& x) {
  const Eigen::Vector3d y = x.unaryExpr([](double v) { return std::abs(v) < 1e-12 ? 0.0 : v; });
  return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", y.x(), y.y(), y.z());
}

std::string form_text(const FaceFacts& facts, const Units& units) {
  const std::string side = side_text(facts), radius = radius_text(facts.form);
  std::string text = form_word(facts.form.kind);
  if (!side.empty() && facts.form.kind != FormKind::plane) text += ", " + side;
  if (radius.empty()) return text;
  const bool is_cone = facts.form.kind == FormKind::cone;
  return text + (is_cone ? ", half angle " : ", radius ") + radius + (is_cone ? "" : after_number(units.length.label));
}

std::string form_table(const std::vector<SurveyedFace>& faces, const std::string& title, const Units& units) {
  if (faces.empty()) return "";
  const std::string unit = units.named() ? fmt::format(" [{}]", units.length.label) : "";
  std::vector<FormCells> rows{{title, "form", "side", "radius" + unit, "normal or axis", "point" + unit}};
  for (const SurveyedFace& face : faces) rows.push_back(form_row(face));
  std::array<std::size_t, 6> width{10, 8, 7, 0, 0, 0};
  for (const FormCells& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
  std::string text;
  for (const FormCells& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) line += fmt::format("{:<{}}  ", row[c], width[c]);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text + "\n";
}

}  // namespace tisserand::reducer
