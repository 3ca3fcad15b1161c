// SPDX-License-Identifier: GPL-3.0-or-later
// Checks names and references of a study.
#include "formats/study/check.hpp"

#include <algorithm>

#include "common/text.hpp"
#include "formats/scene/expand/expression.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

bool mentions(const YamlNode& node, const std::string& axis) {
  for (std::size_t at = node.text.find('$'); at != std::string::npos; at = node.text.find('$', at + 1)) {
    if (node.text.compare(at, 2, "${") == 0) {
      const std::string formula = node.text.substr(at + 2, node.text.find('}', at) - at - 2);
      if (names_of(formula).contains(axis)) return true;
    }
    const std::size_t end =
        node.text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_", at + 1);
    if (node.text.substr(at + 1, end == std::string::npos ? end : end - at - 1) == axis) return true;
  }
  return std::ranges::any_of(node.children, [&](const YamlNode& child) { return mentions(child, axis); });
}

bool is_used(const StudyAxis& axis, const StudySeries& series) {
  const auto uses = [&](const StudySetting& setting) { return mentions(setting.value, axis.name); };
  return axis.sets_path() || std::ranges::any_of(series.set, uses) ||
         std::ranges::any_of(series.parts, [&](const StudyPart& part) { return std::ranges::any_of(part.set, uses); });
}

/// Checks ranges of numbers.
void check_numbers(const Study& study, Faults& faults) {
  const auto positive = [&](const std::string& entry, const char* key, double value) {
    if (value <= 0.0)
      faults.add(entry, key, fmt::format("{} is {}, but must be positive", key, value), "give a positive number");
  };
  positive(study.file, "within", study.within);
  positive(study.file, "repeats", study.repeats);
  positive("reference", "agree", study.reference.agree);
  for (const StudyQuantity& quantity : study.quantities)
    if (quantity.scale) positive(quantity.where, "scale", *quantity.scale);
  if (study.run_budget < 0.0)
    faults.add(study.file, "run_budget", fmt::format("run_budget is {} s", study.run_budget),
               "give seconds, or 0 for none");
}

void check_axes(const Study& study, const StudySeries& series, Faults& faults) {
  for (const StudyAxis& axis : series.axes) {
    if (!axis.sets_path() && !is_name(axis.name))
      faults.add(axis.where, "", fmt::format("axis '{}' is neither a name nor a path", axis.name),
                 "use letters, digits and _, or a path such as integrator.step");
    else if (!is_used(axis, series))
      faults.add(axis.where, "", fmt::format("axis '{}' sets nothing in series '{}'", axis.name, series.name),
                 fmt::format("use it as ${} in a value of 'set', or name it after the path that it sets", axis.name));
    for (std::size_t i = 0; i < axis.values.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (axis.values[i].kind == YamlKind::scalar && axis.values[i].text == axis.values[k].text)
          faults.add(axis.where, "", fmt::format("axis '{}' has the value {} twice", axis.name, axis.values[i].text),
                     "remove one");
  }
  if (!study.along.empty())
    check_reference({fmt::format("along: series '{}'", series.name), study.file, faults}, "along", "axis", study.along,
                    texts_of(series.axes, &StudyAxis::name));
}

void check_series(const Study& study, Faults& faults) {
  std::vector<std::string> seen;
  for (const StudySeries& series : study.series) {
    check_name("series", series, seen, faults);
    check_axes(study, series, faults);
    for (const auto& [quantity, channel] : series.channels)
      check_reference({fmt::format("series '{}': channels", series.name), series.where, faults}, "channels", "quantity",
                      quantity, texts_of(study.quantities, &StudyQuantity::name));
  }
}

void check_reference_of(const Study& study, Faults& faults) {
  const StudyReference& reference = study.reference;
  for (const auto& [quantity, column] : reference.columns)
    check_reference({"reference: columns", "reference", faults}, "columns", "quantity", quantity,
                    texts_of(study.quantities, &StudyQuantity::name));
  for (const StudyRun& run : reference.runs) {
    if (!run.series.empty())
      check_reference({"reference", "reference", faults}, "runs", "series", run.series,
                      texts_of(study.series, &StudySeries::name));
    for (const StudySeries& series : study.series)
      if (series.name == run.series || (run.series.empty() && &series == &study.series.front()))
        for (const auto& [axis, value] : run.at)
          check_reference({"reference: at", "reference", faults}, "runs", "axis", axis,
                          texts_of(series.axes, &StudyAxis::name));
  }
  if (!reference.file.empty() && reference.source.empty())
    faults.add("reference", "", "reference: the file has no 'source'", "write the origin of its numbers in 'source'");
}

}  // namespace

void find_faults(const Study& study, Faults& faults) {
  if (study.series.empty()) faults.add(study.file, "series", "the study has no series", "name a scene in 'series'");
  if (study.quantities.empty())
    faults.add(study.file, "quantities", "the study has no quantity", "name a channel in 'quantities'");
  std::vector<std::string> seen;
  for (const StudyQuantity& quantity : study.quantities) {
    check_name("quantity", quantity, seen, faults);
    if (quantity.from && quantity.to && *quantity.from > *quantity.to)
      faults.add(
          quantity.where, "to",
          fmt::format("quantity '{}': 'to' {} lies before 'from' {}", quantity.name, *quantity.to, *quantity.from),
          "exchange them");
  }
  check_numbers(study, faults);
  check_series(study, faults);
  if (!study.series.empty()) check_reference_of(study, faults);
}

}  // namespace tisserand::formats
