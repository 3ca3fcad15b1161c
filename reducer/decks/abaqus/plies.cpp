// SPDX-License-Identifier: GPL-3.0-or-later
// *SHELL SECTION, COMPOSITE: layers with angles or their own orientations.
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "reducer/decks/abaqus/materials.hpp"
#include "reducer/decks/abaqus/sections.hpp"
#include "reducer/decks/abaqus/sets.hpp"

namespace tisserand::reducer::abaqus {
namespace {

/// +1 if the normals of all shells of the set are on the side of `axis`, -1 if all are on the other side. Throws Error
/// for both, since the sense of angles follows the normal.
double side_of_normals(Model& model, int scope, const Block& block, const Eigen::Vector3d& axis) {
  const std::string where = model.where(block);
  const auto elements = find_elements(model, scope, block.name_of("ELSET"), where);
  double side = 0.0;
  for (const int row : elements.value_or(std::vector<int>())) {
    const RawElement& element = model.elements[row];
    if (element.type->kind != ElementKind::shell) continue;
    const int* nodes = model.nodes_of(element);
    const auto x = [&](int k) -> const Eigen::Vector3d& { return model.positions[nodes[k]]; };
    const double height = (x(2) - x(0)).cross(x(element.count - 1) - x(1)).dot(axis);
    if (side * height < 0.0)
      throw Error(fmt::format("the layers use orientations, but normals of the set point to both sides of their axis, "
                              "for example that of {}",
                              model.element_text(element)),
                  where, "give all elements of the set normals to the same side, or give angles in degrees");
    if (height != 0.0) side = height > 0.0 ? 1.0 : -1.0;
  }
  return side == 0.0 ? 1.0 : side;
}

/// Reads the layers one by one. Angles count from the orientation of the section, or else of the first layer.
class Composite {
 public:
  Composite(Model& model, int scope, const Block& block) : model_(model), scope_(scope), block_(block) {}

  std::optional<Layers> read() {
    if (const std::string* name = block_.find("ORIENTATION"); name != nullptr) set_base(*name, block_);
    Layers layers;
    for (const Line& line : block_.data)
      if (const std::optional<Ply> ply = read_ply(line)) layers.plies.push_back(*ply);
    if (layers.plies.empty() || layers.plies.size() != block_.data.size()) return std::nullopt;
    check_plies(layers.plies, model_.where(block_));
    if (base_) layers.x = base_->x;
    return layers;
  }

 private:
  template <class Place>
  std::optional<Projection> look_up(std::string_view name, const Place& place) {
    const Orientation* found = find_orientation(model_, scope_, std::string(name), model_.where(place));
    return found == nullptr ? std::nullopt : std::optional<Projection>(projection_of(*found, name));
  }

  template <class Place>
  void set_base(std::string_view name, const Place& place) {
    base_ = look_up(name, place);
    if (base_) side_ = side_of_normals(model_, scope_, block_, base_->normal);
  }

  /// Angle of an orientation, right-handed about the normal of the shell.
  std::optional<double> angle_of(std::string_view name, const Line& line) {
    if (!base_) {
      set_base(name, line);
      return base_ ? std::optional<double>(0.0) : std::nullopt;
    }
    const std::optional<Projection> own = look_up(name, line);
    if (!own) return std::nullopt;
    if (own->normal.dot(base_->normal) < 1.0 - 1e-12)
      throw Error(fmt::format("orientation '{}' of a layer has a different axis from the layers before it", name),
                  model_.where(line), "give the orientations of all layers the same axis near the normal");
    return side_ * std::atan2(base_->x.cross(own->x).dot(base_->normal), base_->x.dot(own->x));
  }

  /// Layer: thickness, points, material, angle in degrees or orientation; the number of points is ignored.
  std::optional<Ply> read_ply(const Line& line) {
    const std::vector<std::string_view> fields = split(line.text);
    const std::string where = model_.where(line);
    const std::optional<double> thickness = fields.empty() ? std::nullopt : to_number(fields[0]);
    if (!thickness || !(*thickness > 0.0) || fields.size() < 3)
      return model_.refuse(fmt::format("{}: '{}' is not a layer", block_.title, line.text.substr(0, 60)), where,
                           "write thickness, number of points, material, angle in degrees");
    const AbaqusMaterial* material = find_material(model_, std::string(fields[2]), where);
    if (material == nullptr) return std::nullopt;
    Ply ply = ply_of(*material);
    ply.thickness = *thickness;
    if (fields.size() < 4 || fields[3].empty()) return ply;
    const std::optional<double> degrees = to_number(fields[3]);
    const std::optional<double> angle = degrees ? *degrees * M_PI / 180.0 : angle_of(fields[3], line);
    if (!angle) return std::nullopt;
    ply.angle = *angle;
    return ply;
  }

  Model& model_;
  int scope_;
  const Block& block_;
  std::optional<Projection> base_;
  double side_ = 1.0;
};

}  // namespace

Projection projection_of(const Orientation& orientation, std::string_view name) {
  if (!orientation.is_rectangular || !orientation.normal_axis)
    throw Error(
        fmt::format("orientation '{}' {}", name,
                    orientation.is_rectangular ? "has no second data line, which Abaqus and CalculiX read differently"
                                               : "is not rectangular with DEFINITION=COORDINATES"),
        orientation.where, "give rectangular axes and a second line such as '3, 0.'");
  const int axis = *orientation.normal_axis;
  return {orientation.axes.col(axis), orientation.axes.col((axis + 1) % 3)};
}

std::optional<Layers> read_layers(Model& model, int scope, const Block& block) {
  return Composite(model, scope, block).read();
}

}  // namespace tisserand::reducer::abaqus
