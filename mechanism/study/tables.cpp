// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of a study as CSV, JSON and text.
#include "mechanism/study/tables.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/program/version.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

using Json = nlohmann::ordered_json;

std::string outcome_of(const StudyRow& row) {
  static constexpr const char* words[] = {"completed", "failed", "over budget"};
  return row.is_reference ? "reference" : row.has_run ? words[static_cast<int>(row.outcome)] : "not run";
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

/// Names of all axes, each once, in their order.
std::vector<std::string> axis_names(const formats::Study& study) {
  std::vector<std::string> names;
  for (const formats::StudySeries& series : study.series)
    for (const formats::StudyAxis& axis : series.axes)
      if (std::ranges::find(names, axis.name) == names.end()) names.push_back(axis.name);
  return names;
}

std::string value_of(const formats::Study& study, const StudyRow& row, const std::string& axis) {
  const std::vector<formats::StudyAxis>& axes = study.series[row.cell->series].axes;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (axes[i].name == axis) return row.cell->values[i];
  return "";
}

}  // namespace

std::string csv_text(const formats::Study& study, const std::vector<StudyRow>& rows) {
  const std::vector<std::string> axes = axis_names(study);
  std::string text = "series";
  for (const std::string& axis : axes) text += "," + quoted(axis);
  text += ",outcome,cpu [s],cpu least [s],cpu greatest [s],repeats,coordinates,steps,iterations";
  for (const formats::StudyQuantity& quantity : study.quantities)
    text += fmt::format(",error {},order {}", quantity.name, quantity.name);
  text += ",message\n";
  for (const StudyRow& row : rows) {
    text += study.series[row.cell->series].name;
    for (const std::string& axis : axes) text += "," + quoted(value_of(study, row, axis));
    text += "," + outcome_of(row);
    text += row.has_run ? fmt::format(",{:.4g},{:.4g},{:.4g},{},{},{},{}", row.time.median, row.time.least,
                                      row.time.greatest, row.repeats, row.coordinates, row.steps, row.iterations)
                        : ",,,,,,,";
    for (std::size_t q = 0; q < study.quantities.size(); ++q) {
      text += row.is_measured() ? fmt::format(",{:.4e},", row.errors[q]) : ",,";
      if (row.orders[q]) text += fmt::format("{:.2f}", *row.orders[q]);
    }
    text += "," + quoted(printable_line(row.message, 500)) + "\n";
  }
  return text;
}

std::string json_text(const formats::Study& study, const std::vector<StudyRow>& rows,
                      const std::vector<double>& agreement) {
  Json json{{"study", study.name}, {"tisserand", version()}};
  for (std::size_t q = 0; q < agreement.size(); ++q) json["agreement"][study.quantities[q].name] = agreement[q];
  json["rows"] = Json::array();
  for (const StudyRow& row : rows) {
    const formats::StudySeries& series = study.series[row.cell->series];
    Json one{{"series", series.name}, {"outcome", outcome_of(row)}};
    for (std::size_t k = 0; k < series.axes.size(); ++k) one["at"][series.axes[k].name] = row.cell->values[k];
    for (const formats::Override& setting : row.cell->settings) one["set"][setting.path] = setting.value;
    if (row.has_run)
      one["cpu"] = {{"median", row.time.median},
                    {"least", row.time.least},
                    {"greatest", row.time.greatest},
                    {"repeats", row.repeats}};
    if (!row.message.empty()) one["message"] = row.message;
    if (row.is_measured()) {
      one["coordinates"] = row.coordinates;
      one["steps"] = row.steps;
      one["iterations"] = row.iterations;
      for (std::size_t q = 0; q < study.quantities.size(); ++q) {
        one["errors"][study.quantities[q].name] = row.errors[q];
        if (row.orders[q]) one["orders"][study.quantities[q].name] = *row.orders[q];
      }
    }
    json["rows"].push_back(std::move(one));
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string benchmark_text(const formats::Study& study, const StudyRow& row, const std::vector<Series>& histories) {
  std::string text = fmt::format("# problem: {}\n# program: {}\n# setting: {}\n# accuracy: {:.4e}\n", study.name,
                                 producer("mechanism"), row.cell->label, std::ranges::max(row.errors));
  text += fmt::format("# cpu time [s]: {:.4g}\n", row.time.median);
  text += fmt::format("{} [{}]", histories.front().x_name, histories.front().x_unit);
  for (std::size_t q = 0; q < histories.size(); ++q)
    text += fmt::format("\t{} [{}]", study.quantities[q].name, histories[q].unit);
  text += "\n";
  for (std::size_t i = 0; i < histories.front().x.size(); ++i) {
    text += fmt::format("{:.12g}", histories.front().x[i]);
    for (const Series& history : histories) text += fmt::format("\t{:.12g}", history.y[i]);
    text += "\n";
  }
  return text;
}

std::string summary_text(const formats::Study& study, const std::vector<StudyRow>& rows,
                         const std::vector<double>& agreement) {
  int measured = 0, failed = 0, over = 0, left = 0;
  for (const StudyRow& row : rows) {
    measured += row.is_measured() ? 1 : 0;
    failed += row.has_run && row.outcome == CellOutcome::failed ? 1 : 0;
    over += row.has_run && row.outcome == CellOutcome::over_budget ? 1 : 0;
    left += row.has_run || row.is_reference ? 0 : 1;
  }
  std::string text = fmt::format("{}: {} settings measured, {} failed, {} over their budget, {} not run yet\n",
                                 study.name, measured, failed, over, left);
  for (std::size_t q = 0; q < agreement.size(); ++q)
    text += fmt::format("  {:<16} the references agree to {:.1e}\n", study.quantities[q].name, agreement[q]);
  for (int q = 0; q < std::ssize(study.quantities); ++q)
    for (const int i : pareto_front(rows, q))
      text += fmt::format("  {:<16} error {:.1e} in {:.3g} s [{:.3g}, {:.3g}]: {}\n", study.quantities[q].name,
                          rows[i].errors[q], rows[i].time.median, rows[i].time.least, rows[i].time.greatest,
                          rows[i].cell->label);
  return text;
}

}  // namespace tisserand::mechanism
