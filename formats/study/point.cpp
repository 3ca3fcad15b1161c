// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces names of axes by their values.
#include "formats/scene/expand/parameters.hpp"
#include "formats/study/study.hpp"
#include "formats/yaml/emit.hpp"

namespace tisserand::formats {
namespace {

/// The value with $axis and ${formula} replaced.
YamlNode replaced(const Study& study, const YamlNode& value, const StudyPoint& point) {
  ParameterScope scope(nullptr);
  for (const auto& [name, node] : point) {
    YamlNode given = node;
    given.key = name;
    scope.define(given, scope);
  }
  ExpansionBudget budget;
  YamlNode result = value;
  Substitution(study.document, budget).apply(result, scope);
  return result;
}

}  // namespace

std::vector<Override> settings_at(const Study& study, const std::vector<StudySetting>& set, const StudyPoint& point) {
  std::vector<Override> settings;
  for (const StudySetting& one : set) settings.push_back({one.path, flow_text(replaced(study, one.value, point))});
  return settings;
}

std::vector<Override> settings_at(const Study& study, const StudySeries& series, const StudyPoint& point) {
  std::vector<Override> settings = settings_at(study, series.set, point);
  for (const StudyAxis& axis : series.axes)
    if (axis.sets_path()) settings.push_back({axis.name, flow_text(point.at(axis.name))});
  return settings;
}

std::string channel_at(const Study& study, const StudySeries& series, const StudyQuantity& quantity,
                       const StudyPoint& point) {
  const auto own = series.channels.find(quantity.name);
  return replaced(study, own == series.channels.end() ? quantity.channel : own->second, point).text;
}

}  // namespace tisserand::formats
