// SPDX-License-Identifier: GPL-3.0-or-later
// Reads values of plain fields.
#include "formats/yaml/fields.hpp"

#include <limits>

#include "formats/yaml/geometry.hpp"

namespace tisserand::formats {

std::string standard_text(double value) {
  std::string text = fmt::format("{:g}", value);
  const std::size_t zero = text.find("e-0");  // 1e-06
  return zero == std::string::npos ? text : text.erase(zero + 2, 1);
}

std::string standard_text(int value) { return fmt::format("{}", value); }

std::string standard_text(const Eigen::Vector3d& value) {
  return fmt::format("`[{:g}, {:g}, {:g}]`", value.x(), value.y(), value.z());
}

const YamlNode* find_or_require(const MapReader& map, const Field& field) {
  return field.required() ? map.require(field.key) : map.find(field.key);
}

void read_value(const MapReader& map, const Field& field, double& value) {
  if (const YamlNode* node = find_or_require(map, field))
    value = read_number(map.context(), *node, std::string(field.key));
  else if (field.required())
    value = std::numeric_limits<double>::quiet_NaN();
}

void read_value(const MapReader& map, const Field& field, int& value) {
  if (const YamlNode* node = find_or_require(map, field))
    value = read_integer(map.context(), *node, std::string(field.key)).value_or(value);
}

void read_value(const MapReader& map, const Field& field, std::string& value) {
  if (const YamlNode* node = find_or_require(map, field))
    value = read_text(map.context(), *node, std::string(field.key));
}

void read_value(const MapReader& map, const Field& field, std::vector<std::string>& value) {
  if (const YamlNode* node = find_or_require(map, field))
    value = read_texts(map.context(), *node, std::string(field.key));
}

void read_value(const MapReader& map, const Field& field, Eigen::Vector3d& value) {
  if (find_or_require(map, field) != nullptr)
    value = read_vector(map, field.key, value);
  else if (field.required())
    value.setConstant(std::numeric_limits<double>::quiet_NaN());
}

void read_value(const MapReader& map, const Field& field, std::vector<double>& value) {
  if (const YamlNode* node = find_or_require(map, field))
    value = read_numbers(map.context(), *node, std::string(field.key));
}

void read_value(const MapReader& map, const Field& field, std::optional<double>& value) {
  if (const YamlNode* node = find_or_require(map, field))
    value = read_number(map.context(), *node, std::string(field.key));
}

void read_value(const MapReader& map, const Field& field, std::optional<int>& value) {
  if (const YamlNode* node = find_or_require(map, field))
    value = read_integer(map.context(), *node, std::string(field.key)).value_or(0);
}

void read_value(const MapReader& map, const Field& field, std::optional<Eigen::Vector3d>& value) {
  if (find_or_require(map, field) != nullptr) value = read_optional_vector(map, field.key);
}

void read_value(const MapReader& map, const Field& field, Eigen::Matrix3d& value) {
  if (const YamlNode* node = find_or_require(map, field))
    value = read_inertia(map.context(), *node, std::string(field.key));
}

void read_value(const MapReader& map, const Field& field, Eigen::Quaterniond& value) {
  if (const YamlNode* node = find_or_require(map, field))
    value = read_orientation(map.context(), *node, std::string(field.key));
}

void read_value(const MapReader& map, const Field& field, std::optional<Eigen::Quaterniond>& value) {
  if (find_or_require(map, field) != nullptr) read_value(map, field, value.emplace());
}

}  // namespace tisserand::formats
