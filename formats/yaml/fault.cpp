// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of findings about numbers.
#include "formats/yaml/fault.hpp"

#include <fmt/format.h>

namespace tisserand::formats {

void Subject::add(const std::string& key, const std::string& what, const std::string& remedy) const {
  faults.add(where, key.empty() ? key : prefix + key, name.empty() ? what : fmt::format("{}: {}", name, what), remedy);
}

void Subject::positive(const std::string& key, std::optional<double> value) const {
  if (value && !(*value > 0.0 && std::isfinite(*value))) add(key, fmt::format("{} {:g} must be positive", key, *value));
}

void Subject::not_negative(const std::string& key, std::optional<double> value) const {
  if (value && !(*value >= 0.0 && std::isfinite(*value)))
    add(key, fmt::format("{} {:g} must not be negative", key, *value));
}

void Subject::between(const std::string& key, double value, double low, double high) const {
  if (!(value >= low && value <= high))
    add(key, fmt::format("{} {:g} must lie between {:g} and {:.4g}", key, value, low, high));
}

void Subject::at_least(const std::string& key, std::optional<int> value, int low) const {
  if (value && *value < low) add(key, fmt::format("{} {} must be {} or more", key, *value, low));
}

}  // namespace tisserand::formats
