// SPDX-License-Identifier: GPL-3.0-or-later
// Names that distinguish the curves of a picture, and labels of its axes.
#include "mechanism/histories/plot_names.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

constexpr std::size_t kLongestName = 60;  // largest number of letters of a name in a legend

std::vector<std::string> path_parts(const std::string& channel) {
  std::vector<std::string> parts(1);
  for (const char c : channel) {
    if (c == '/')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// Short name of a channel: "nodes/angular_velocity/beam/tip/z" -> "beam/tip/z"; "energy/kinetic" -> "kinetic".
std::string short_name(const Series& series) {
  const std::vector<std::string> parts = path_parts(series.channel);
  const std::size_t skipped = parts.size() > 2 ? 2 : parts.size() - 1;
  return join({parts.begin() + static_cast<std::ptrdiff_t>(skipped), parts.end()}, "/");
}

/// Quantity: "nodes/angular_velocity/..." -> "angular velocity"; "solver/step" -> "step"; "energy/kinetic" -> "energy".
std::string quantity(const Series& series) {
  const std::vector<std::string> parts = path_parts(series.channel);
  std::string word = parts.size() > 1 && parts.front() != "energy" ? parts[1] : parts.front();
  if (parts.size() > 2 && parts.front() == "channels") word = short_name(series);
  std::replace(word.begin(), word.end(), '_', ' ');
  return word;
}

}  // namespace

std::string with_superscripts(const std::string& unit) {
  constexpr std::array digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  bool raised = false;
  for (const char c : unit) {
    if (c == '^')
      raised = true;
    else if (raised && c == '-')
      text += "⁻";
    else if (raised && c >= '0' && c <= '9')
      text += digits[c - '0'];
    else {
      raised = false;
      text += c;
    }
  }
  return text;
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : name + " [" + with_superscripts(unit) + "]";
}

CurveNames::CurveNames(const std::vector<Series>& series) {
  const Series *run = nullptr, *reference = nullptr;
  for (const Series& one : series) {
    if (one.kind == SeriesKind::difference) continue;
    if (one.kind == SeriesKind::reference) {
      same_reference_channel = same_reference_channel && (reference == nullptr || reference->channel == one.channel);
      reference = &one;
      continue;
    }
    same_source = same_source && (run == nullptr || run->source == one.source);
    same_channel = same_channel && (run == nullptr || run->channel == one.channel);
    ++from_source[one.source];
    run = &one;
  }
}

std::string CurveNames::of(const Series& one) const {
  if (one.kind == SeriesKind::reference)
    return one.is_of_run && !same_reference_channel ? one.source + ": " + short_name(one) : one.source;
  const auto count = from_source.find(one.source);
  std::string name;
  if (one.has_own_label && count != from_source.end() && count->second == 1)
    name = one.source;
  else if (same_source)
    name = short_name(one);
  else
    name = same_channel ? one.source : one.source + ": " + short_name(one);
  if (one.kind == SeriesKind::difference)
    name += fmt::format(": largest {:.3g}, RMS {:.3g}", one.norms.largest, one.norms.rms);
  return name;
}

std::string shortened(const std::string& name) {
  if (name.size() <= kLongestName) return name;
  const std::size_t half = kLongestName / 2;
  return printable(name.substr(0, half)) + "..." + printable(name.substr(name.size() - half));
}

std::string y_label_of(const std::vector<Series>& series, const Panel& panel) {
  std::vector<std::string> quantities;
  for (const std::size_t i : panel.members) {
    if (series[i].kind == SeriesKind::reference && panel.members.front() != i) continue;
    const std::string word = quantity(series[i]);
    if (std::find(quantities.begin(), quantities.end(), word) == quantities.end()) quantities.push_back(word);
  }
  const std::string what = panel.of_differences ? "difference of " : "";
  const std::string many = has_too_many_names(panel) ? fmt::format("{} x ", panel.members.size()) : "";
  constexpr std::size_t most = 3;
  if (quantities.size() > most) {
    quantities.resize(most);
    quantities.emplace_back("...");
  }
  return with_unit(many + what + join(quantities, ", "), panel.unit);
}

}  // namespace tisserand::mechanism
