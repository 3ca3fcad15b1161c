// SPDX-License-Identifier: GPL-3.0-or-later
// Reads `shape` of a body in scene.yaml: one solid or a list.
#include <filesystem>

#include "formats/scene/check_parts.hpp"
#include "formats/scene/reader.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/geometry.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

constexpr std::size_t most_points = 100'000;

struct ShapeRow {
  const char* word;
  ShapeKind kind;
  std::string_view noun;
};
constexpr ShapeRow shape_rows[] = {
    {"box", ShapeKind::box, "shape_box"},          {"cylinder", ShapeKind::cylinder, "shape_cylinder"},
    {"sphere", ShapeKind::sphere, "shape_sphere"}, {"cone", ShapeKind::cone, "shape_cone"},
    {"tube", ShapeKind::tube, "shape_tube"},       {"mesh", ShapeKind::mesh, "shape_mesh"}};

std::vector<Eigen::Vector3d> read_points(const Context& context, const YamlNode& node) {
  std::vector<Eigen::Vector3d> points;
  if (node.kind != YamlKind::sequence || node.children.size() < 2 || node.children.size() > most_points) {
    context.fail(node.place, fmt::format("points must be a list of 2 to {} points", most_points),
                 "write [[0, 0, 0], [1, 0, 0]]");
    return points;
  }
  for (const YamlNode& child : node.children) points.push_back(read_vector(context, child, "a point"));
  return points;
}

/// Reads one factor, or one for each axis.
Eigen::Vector3d read_scale(const Context& context, const YamlNode& node) {
  if (node.kind == YamlKind::sequence) return read_vector(context, node, "scale");
  return Eigen::Vector3d::Constant(read_number(context, node, "scale"));
}

void read_one(const Context& context, const YamlNode& node, const SceneDefinitions& definitions,
              std::vector<ShapeSpec>& shapes) {
  const YamlNode* type = node.kind == YamlKind::map ? find_child(node, "type") : nullptr;
  if (type == nullptr) {
    context.fail(
        node.place,
        node.kind == YamlKind::map ? "missing key 'type'" : fmt::format("must be a map, not {}", describe(node)),
        "write {type: box, size: [0.1, 0.2, 0.3]}");
    return;
  }
  const auto index = read_word(context, *type, "type", texts_of(shape_rows, &ShapeRow::word));
  if (!index) return;
  const MapReader map(context, node, shape_rows[*index].noun, "shape.");
  ShapeSpec shape;
  shape.kind = shape_rows[*index].kind;
  shape.where = context.entry;
  read_fields(map, shape);
  if (shape.kind != ShapeKind::cone) shape.end_radius = shape.radius;
  if (shape.kind == ShapeKind::tube)
    if (const YamlNode* points = map.require("points")) shape.points = read_points(context, *points);
  if (shape.kind == ShapeKind::mesh) {
    shape.units = definitions.units;
    if (!shape.file.empty()) shape.file = (context.reader.folder() / shape.file).lexically_normal().string();
    if (const YamlNode* scale = map.find("scale")) shape.scale = read_scale(context, *scale);
  }
  shapes.push_back(std::move(shape));
}

bool ends_in(const std::string& file, std::string_view ending) {
  const std::string own = std::filesystem::path(file).extension().string();
  return own.size() == ending.size() &&
         std::ranges::equal(own, ending, [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
}

}  // namespace

std::vector<ShapeSpec> read_shapes(const MapReader& body, const SceneDefinitions& definitions) {
  std::vector<ShapeSpec> shapes;
  const YamlNode* node = body.find("shape");
  if (node == nullptr) return shapes;
  for (const YamlNode& one : items_of(*node)) read_one(body.context().inside("shape"), one, definitions, shapes);
  return shapes;
}

void check_shape(const ShapeSpec& shape, const Subject& subject) {
  const auto apart = [&](const char* key, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    if (!a.allFinite() || !b.allFinite() || (b - a).isZero(0.0))
      subject.add(key, fmt::format("{}: two points coincide", key), "give different points");
  };
  subject.finite("position", shape.position);
  switch (shape.kind) {
    case ShapeKind::box:
      for (const double side : shape.size) subject.positive("size", side);
      return;
    case ShapeKind::sphere:
      subject.positive("radius", shape.radius);
      return;
    case ShapeKind::cylinder:
      subject.positive("radius", shape.radius);
      apart("to", shape.from, shape.to);
      return;
    case ShapeKind::cone:
      if (!(shape.radius >= 0.0 && shape.end_radius >= 0.0 && shape.radius + shape.end_radius > 0.0))
        subject.add("radius", fmt::format("radii {:g} and {:g} must be positive; only one may be 0", shape.radius,
                                          shape.end_radius));
      apart("to", shape.from, shape.to);
      return;
    case ShapeKind::tube:
      subject.positive("radius", shape.radius);
      for (std::size_t i = 1; i < shape.points.size(); ++i) apart("points", shape.points[i - 1], shape.points[i]);
      return;
    case ShapeKind::mesh:
      if (!ends_in(shape.file, ".stl") && !ends_in(shape.file, ".obj") && !shape.file.ends_with(".recovery.h5"))
        subject.add(
            "file", fmt::format("'{}' is not an .stl, .obj or .recovery.h5 file", shape.file),
            "export the surface as STL or OBJ, or let `reducer` write the recovery file of a part (recovery: yes)");
      for (const double factor : shape.scale)
        if (!(factor != 0.0) || !std::isfinite(factor))
          subject.add("scale", fmt::format("scale {:g} must not be 0", factor),
                      "write 1 to keep the sizes of the file");
      return;
  }
}

std::vector<KeySet> shape_of_body_key_sets() {
  const Field radius = plain<&ShapeSpec::radius>("radius", "positive", "", "required"),
              from = plain<&ShapeSpec::from>("from", "vector", "", "required"),
              to = plain<&ShapeSpec::to>("to", "vector", "", "required"),
              position = plain<&ShapeSpec::position>("position", "vector", ""),
              orientation = plain<&ShapeSpec::orientation>("orientation", "rotation", "");
  return {
      {"shape_box",
       {{"type", "'box'",
         "`size` along its axes, `position` of its centre, `orientation`: `{type: box, size: [1, 0.2, 0.2]}`",
         "required"},
        plain<&ShapeSpec::size>("size", "[positive]3", "", "required"),
        position,
        orientation}},
      {"shape_cylinder",
       {{"type", "'cylinder'",
         "axis `from`, `to`, `radius`: `{type: cylinder, from: [0, 0, 0], to: [0, 0, 1], radius: 0.1}`", "required"},
        from,
        to,
        radius}},
      {"shape_sphere",
       {{"type", "'sphere'", "`radius`, `position` of its centre: `{type: sphere, radius: 0.2}`", "required"},
        radius,
        position}},
      {"shape_cone",
       {{"type", "'cone'", "as a cylinder, with `radius` at `from` and `end_radius` at `to` (default 0)", "required"},
        from,
        to,
        plain<&ShapeSpec::radius>("radius", "not_negative", "", "required"),
        plain<&ShapeSpec::end_radius>("end_radius", "not_negative", "")}},
      {"shape_tube",
       {{"type", "'tube'",
         "`points` of its axis, `radius`: `{type: tube, points: [[0, 0, 0], [1, 0, 0], [1, 1, 0]], radius: 0.02}`",
         "required"},
        {"points", "[vector]2..", "", "required"},
        radius}},
      {"shape_mesh",
       {{"type", "'mesh'",
         "`file` of triangles (STL, OBJ), or the surface of a part from its recovery file (`bracket.recovery.h5`, in "
         "its own units); `scale` (default 1, or one per axis; negative ones mirror), `position` of its origin, "
         "`orientation`: `{type: mesh, file: wheel.stl, scale: 0.001}`",
         "required"},
        plain<&ShapeSpec::file>("file", "text+", "", "required"),
        {"scale", "number | [number]3", ""},
        position,
        orientation}}};
}

NamedType shape_of_body_type() {
  static const std::string kinds = [] {
    std::string text;
    for (const ShapeRow& row : shape_rows) text += fmt::format("{}{}", text.empty() ? "" : " | ", row.noun);
    return text;
  }();
  return {"shape_of_body", kinds};
}

Field shape_field() {
  return {"shape", "shape_of_body | [shape_of_body]", "what pictures show: see [shapes](#shapes)", "none"};
}

}  // namespace tisserand::formats
