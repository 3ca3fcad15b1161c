// SPDX-License-Identifier: GPL-3.0-or-later
// Reads functions of time: numbers, expressions and tables.
#include "formats/scene/time_function_reader.hpp"

#include <cmath>

#include "formats/tables/csv_table.hpp"
#include "formats/yaml/fields.hpp"

namespace tisserand::formats {
namespace {

TimeTable read_table(const Context& context, const YamlNode& node) {
  TimeTable table;
  if (!context.require_list(node, "table must be a list of pairs", "write it as [[0, 0], [0.2, 200]]")) return table;
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    const std::vector<double> pair = read_numbers(context, node.children[i], fmt::format("table[{}]", i));
    if (pair.size() == 2) {
      table.time.push_back(pair[0]);
      table.value.push_back(pair[1]);
    } else if (node.children[i].kind == YamlKind::sequence) {
      context.fail(node.children[i].place, fmt::format("table[{}] has {} numbers instead of 2", i, pair.size()),
                   "write [time, value]");
    }
  }
  return table;
}

TimeTable read_file(const Context& context, const YamlNode& node) {
  const std::string name = read_text(context, node, "file");
  if (name.empty()) return {};
  try {
    return read_csv_table((context.reader.folder() / name).string());
  } catch (const Error& error) {
    context.fail(node.place, error.what(), "");
    return {};
  }
}

TimeFunctionSpec read_map(const MapReader& map) {
  const int forms = (map.has("table") ? 1 : 0) + (map.has("file") ? 1 : 0) + (map.has("expression") ? 1 : 0);
  if (forms != 1) map.fail(fmt::format("{} of table, file, expression are given", forms), "give one of them");
  if (const YamlNode* table = map.find("table")) return read_table(map.context(), *table);
  if (const YamlNode* file = map.find("file")) return read_file(map.context(), *file);
  TimeExpression expression;
  if (const YamlNode* text = map.find("expression")) {
    expression.text = read_text(map.context(), *text, "expression");
    expression.where = map.context().reader.where(text->place);
  }
  if (const YamlNode* points = map.find("breakpoints"))
    expression.breakpoints = read_numbers(map.context(), *points, "breakpoints");
  return expression;
}

void check_times(const std::vector<double>& times, const std::string& noun, const std::string& key,
                 const Subject& subject) {
  for (std::size_t i = 0; i < times.size(); ++i)
    if (!std::isfinite(times[i])) {
      subject.add(key, fmt::format("{} must have finite times", noun));
      return;
    }
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    subject.add(key, fmt::format("times of the {} must increase, but {:g} follows {:g}", noun, times[i], times[i - 1]),
                times[i] == times[i - 1] ? "for a jump, use two close times" : "");
    return;
  }
}

}  // namespace

TimeFunctionSpec read_time_function(const Context& context, const YamlNode& node, const std::string& what) {
  if (node.kind == YamlKind::map) {
    return read_map(MapReader(context.inside(what), node, "time_function", what + "."));
  }
  if (node.kind == YamlKind::scalar && !looks_like_number(node))
    return TimeExpression{node.text, {}, context.reader.where(node.place)};
  return read_number(context, node, what);
}

TimeFunctionSpec read_motion_function(const Context& context, const YamlNode& node, const std::string& what) {
  if (node.kind != YamlKind::map) return read_time_function(context, node, what);
  const Context inner = context.inside(what);
  const MapReader map(inner, node, "motion_function", what + ".");
  TimeFunctionSpec function = read_map(map);
  if (auto* table = std::get_if<TimeTable>(&function))
    table->motion = map.choice("interpolation", table_motions, table->motion);
  else
    map.refuse({"interpolation"}, "belongs to tables", "remove it");
  return function;
}

void check_time_function(const TimeFunctionSpec& function, const std::string& key, const Subject& subject) {
  if (const double* constant = std::get_if<double>(&function)) {
    subject.finite(key, *constant);
  } else if (const TimeTable* table = std::get_if<TimeTable>(&function)) {
    if (table->time.empty() || table->time.size() != table->value.size()) {
      subject.add(key, fmt::format("the table has {} times and {} values", table->time.size(), table->value.size()));
      return;
    }
    check_times(table->time, "table", key, subject);
    for (const double value : table->value)
      if (!std::isfinite(value)) subject.add(key, "values of the table must be finite");
  } else if (const TimeExpression* expression = std::get_if<TimeExpression>(&function)) {
    if (expression->text.find_first_not_of(" \t\n") == std::string::npos)
      subject.add(key, fmt::format("{} is an empty expression", key), "write an expression in t, or 0");
    check_times(expression->breakpoints, "breakpoints", key, subject);
  }
}

CurveSpec read_curve(const Context& context, const YamlNode& node, const std::string& what) {
  const Context inner = context.inside(what);
  const MapReader map(inner, node, "curve", what + ".");
  CurveSpec curve;
  read_fields(map, curve);
  if (map.has("table") == map.has("file"))
    map.fail("a curve needs either 'table' or 'file'", "write table: [[-1, -5], [0, 0], [1, 5]]");
  TimeTable points;
  if (const YamlNode* table = map.find("table"))
    points = read_table(inner, *table);
  else if (const YamlNode* file = map.find("file"))
    points = read_file(inner, *file);
  curve.x = std::move(points.time);
  curve.y = std::move(points.value);
  return curve;
}

void check_curve(const CurveSpec& curve, const std::string& key, const Subject& subject) {
  if (curve.x.size() < 2 || curve.x.size() != curve.y.size()) {
    subject.add(key, fmt::format("the table of {} has {} points", key, curve.x.size()), "give at least two");
    return;
  }
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) {
      subject.add(key, fmt::format("the table of {} must be finite", key));
      return;
    }
  for (std::size_t i = 1; i < curve.x.size(); ++i)
    if (!(curve.x[i] > curve.x[i - 1])) {
      subject.add(key, fmt::format("the first column of the table of {} must increase, but {:g} follows {:g}", key,
                                   curve.x[i], curve.x[i - 1]));
      return;
    }
}

std::vector<KeySet> time_function_key_sets() {
  const std::vector<Field> fields{{"table", "[[number]2]1..", ""},
                                  {"file", "text", ""},
                                  {"expression", "text+", ""},
                                  {"breakpoints", "[number]", ""}};
  std::vector<Field> of_motions = fields;
  of_motions.push_back(choice<&TimeTable::motion, table_motions>("interpolation", ""));
  return {{"time_function", fields, {}, {1, 2}},
          {"motion_function", of_motions, {}, {1, 2}},
          {"curve",
           {{"table", "[[number]2]2..", ""},
            {"file", "text", ""},
            choice<&CurveSpec::interpolation, interpolations>("interpolation", "")},
           {},
           {1, 2}}};
}

}  // namespace tisserand::formats
