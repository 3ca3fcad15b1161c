// SPDX-License-Identifier: GPL-3.0-or-later
// Lists of texts from the stored report.
#include "mechanism/view/run_report.hpp"

#include <fmt/format.h>

namespace tisserand::mechanism {
namespace {

using formats::Json;
Json texts_of(const Json& report, const char* key) {
  Json texts = Json::array();
  if (report.contains(key) && report[key].is_array())
    for (const Json& one : report[key])
      if (one.is_string()) texts.push_back(one);
  return texts;
}

/// Text of a number or a string.
std::string word_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? fmt::format("{:.4g}", value.get<double>()) : value.dump();
}

/// Adds numbers and texts of a report as lines, such as "largest backward error": 1e-16.
void add_lines(const Json& report, const char* before, Json& lines) {
  for (const auto& [key, value] : report.items()) {
    if (!value.is_number() && !value.is_string()) continue;
    std::string name = key;
    for (char& c : name) c = c == '_' ? ' ' : c;
    if (const std::string word = word_of(value); !word.empty()) lines.push_back({before + name, word});
  }
}

}  // namespace

Json report_of_run(const formats::ResultsReader& reader) {
  Json result{{"notes", Json::array()},  {"doubts", Json::array()},  {"lines", Json::array()},
              {"phases", Json::array()}, {"energy", Json::object()}, {"effects", Json::array()}};
  const Json report = Json::parse(reader.report_json(), nullptr, false);
  if (!report.is_object()) return result;
  result["notes"] = texts_of(report, "notes");
  if (report.contains("preflight") && report["preflight"].is_object())
    result["doubts"] = texts_of(report["preflight"], "doubts");
  for (const Json& doubt : texts_of(report, "doubts")) result["doubts"].push_back(doubt);
  for (const Json& one : texts_of(report, "rejections")) result["lines"].push_back({"rejected step", one});
  add_lines(report, "", result["lines"]);
  for (const char* group : {"energy", "mobility", "linear_solver", "initial_correction"})
    if (report.contains(group) && report[group].is_object())
      add_lines(report[group], fmt::format("{}: ", std::string_view(group)).c_str(), result["lines"]);
  if (report.contains("table") && report["table"].is_object())
    for (const Json& line : texts_of(report["table"], "lines"))
      result["lines"].push_back({report["table"].value("title", ""), line});
  for (const Json& effect : texts_of(report, "effects")) result["effects"].push_back({effect, "on"});
  if (report.contains("seconds") && report["seconds"].is_object())
    for (const auto& [phase, seconds] : report["seconds"].items())
      if (seconds.is_number()) result["phases"].push_back({phase, seconds});
  return result;
}

}  // namespace tisserand::mechanism
