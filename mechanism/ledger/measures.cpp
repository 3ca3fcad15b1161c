// SPDX-License-Identifier: GPL-3.0-or-later
// Names, columns and sizes of the measures of a ledger.
#include "mechanism/ledger/measures.hpp"

#include <map>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "common/text.hpp"
#include "formats/results/blocks.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Vector3d;

/// Name of the deformable body of a place: "rod/mid" -> "rod". Empty if the body does not deform.
std::string flexible_body_of(const std::string& place, const std::map<std::string, bool>& flexible) {
  for (std::string name = place; !name.empty();) {
    if (const auto found = flexible.find(name); found != flexible.end()) return found->second ? name : "";
    const std::size_t slash = name.rfind('/');
    if (slash == std::string::npos) break;
    name.resize(slash);
  }
  return "";
}

/// Whether each body deforms in the model of the layout. With is_left_out, whether it may deform in either of two
/// models.
std::map<std::string, bool> flexible_bodies(const formats::Scene& scene, const formats::ResultsLayout& layout,
                                            Measures::Missing missing) {
  const bool in_either = missing == Measures::Missing::is_left_out;
  std::map<std::string, bool> flexible;
  for (const formats::BodySpec& body : scene.bodies)
    flexible[std::visit([](const auto& spec) { return spec.name; }, body)] =
        std::holds_alternative<formats::BeamBodySpec>(body) ||
        (in_either && !std::holds_alternative<formats::RigidBodySpec>(body));
  if (in_either) return flexible;
  for (const std::string& name : layout.superelements) flexible[name] = true;
  for (std::size_t i = 0; i < layout.modal_bodies.size(); ++i)
    flexible[layout.modal_bodies[i]] = layout.modal_offset[i + 1] > layout.modal_offset[i];
  return flexible;
}

Eigen::Quaterniond rotation_of(const formats::ResultsRow& row, int node) {
  return quaternion(row.node_rotation.col(node));
}

/// Position R₁ᵀ (x − x₁) in axes of the base node. It is constant in a rigid body.
Vector3d seen_from(const formats::ResultsRow& row, int base, int node) {
  return rotation_of(row, base).conjugate() * Vector3d(row.node_position.col(node) - row.node_position.col(base));
}

}  // namespace

Measures::Measures(const formats::Scene& scene, const formats::ResultsLayout& layout,
                   const std::vector<std::string>& channels, Missing missing) {
  if (channels.empty()) add_defaults(scene, layout, missing);
  for (const std::string& channel : channels) add_channel(channel, layout, scene.file, missing);
}

void Measures::add_defaults(const formats::Scene& scene, const formats::ResultsLayout& layout, Missing missing) {
  const auto add = [this](MeasureKind kind, const std::string& name, const std::string& group, Source source) {
    list_.push_back({kind, name, group});
    sources_.push_back(source);
  };
  const std::map<std::string, bool> flexible = flexible_bodies(scene, layout, missing);
  std::map<std::string, int> base;
  for (int i = 0; i < std::ssize(layout.nodes); ++i) {
    const std::string& name = layout.nodes[i];
    const int index = i;
    add(MeasureKind::position, "nodes/position/" + name, "position", {index, -1, nullptr});
    const std::string body = flexible_body_of(name, flexible);
    if (flexible.contains(name))  // the body itself: two axes define its orientation
      for (const int axis : {0, 1})
        add(MeasureKind::direction, fmt::format("axis {} of {}", "xy"[axis], name), "axis", {index, axis, nullptr});
    if (body.empty() || body == name) continue;
    const auto [first, is_first] = base.try_emplace(body, index);
    if (!is_first)
      add(MeasureKind::deflection, "deflection of " + name, "deflection of " + body, {index, first->second, nullptr});
  }
  for (int i = 0; i < std::ssize(layout.joints); ++i)
    add(MeasureKind::force, "joints/force/" + layout.joints[i], "force", {i, -1, nullptr});
}

void Measures::add_channel(const std::string& given, const formats::ResultsLayout& layout, const std::string& where,
                           Missing missing) {
  const std::string pattern = formats::without_alias(given, layout);
  std::vector<std::string> names;
  const std::size_t before = list_.size();
  for (const formats::Block& block : formats::all_blocks(layout))
    for (std::size_t i = 0; i < block.width(); ++i) {
      names.push_back(block.dataset.substr(1) + (block.columns[i].empty() ? "" : "/" + block.columns[i]));
      const std::string& name = names.back();
      if (name != pattern && !matches_wildcard(name, pattern) && !name.starts_with(pattern + "/")) continue;
      const std::string& reported = name == pattern ? given : name;
      list_.push_back({MeasureKind::channel, reported, reported});
      sources_.push_back({static_cast<int>(i), -1, block.values});
    }
  if (list_.size() == before && missing == Missing::is_error)
    throw Error(fmt::format("there is no channel '{}'", printable_line(given, 200)), where,
                fmt::format("the nearest are {}", listed(nearest_names(pattern, names))));
}

MeasuredRow Measures::values(const formats::ResultsRow& row) const {
  MeasuredRow values(3, static_cast<Eigen::Index>(list_.size()));
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const Source& source = sources_[i];
    auto value = values.col(static_cast<Eigen::Index>(i));
    switch (list_[i].kind) {
      case MeasureKind::position:
        value = row.node_position.col(source.index);
        break;
      case MeasureKind::deflection:
        value = seen_from(row, source.base, source.index);
        break;
      case MeasureKind::direction:
        value = rotation_of(row, source.index) * Vector3d::Unit(source.base);
        break;
      case MeasureKind::force:
        value = row.joint_force.col(source.index);
        break;
      case MeasureKind::channel:
        value = Vector3d(source.values(row)[source.index], 0.0, 0.0);
        break;
    }
  }
  return values;
}

std::vector<int> Measures::places_in(const Measures& other) const {
  std::map<std::string, int> there;
  for (int i = 0; i < std::ssize(other.list_); ++i) there[other.list_[i].name] = i;
  std::vector<int> places;
  for (const Measured& one : list_) {
    const auto found = there.find(one.name);
    places.push_back(found == there.end() ? -1 : found->second);
  }
  return places;
}

MeasureSizes::MeasureSizes(const std::vector<Measured>& list) {
  std::map<std::string, int> groups;
  for (const Measured& one : list) {
    from_first_.push_back(one.kind == MeasureKind::position || one.kind == MeasureKind::deflection ||
                          one.kind == MeasureKind::direction);
    group_of_.push_back(groups.try_emplace(one.group, count_of(groups)).first->second);
  }
  group_size_.assign(groups.size(), 0.0);
}

void MeasureSizes::observe(const MeasuredRow& row) {
  if (first_.size() == 0) first_ = row;
  for (std::size_t i = 0; i < from_first_.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const double size = from_first_[i] ? (row.col(column) - first_.col(column)).norm() : row.col(column).norm();
    double& largest = group_size_[static_cast<std::size_t>(group_of_[i])];
    if (size > largest) largest = size;  // not a number: no value in this row
  }
}

}  // namespace tisserand::mechanism
