// SPDX-License-Identifier: GPL-3.0-or-later
// Reads study.yaml into the struct Study.
#include "formats/study/study.hpp"

#include <algorithm>

#include "common/text.hpp"
#include "formats/scene/integrator_reader.hpp"
#include "formats/study/check.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {
namespace {

constexpr Choice<StudyTiming> timings[] = {{"alone", StudyTiming::alone}, {"together", StudyTiming::together}};

/// Path of the file of a key, resolved from the folder of the study.
std::string file_of(const MapReader& map, std::string_view key) {
  const std::string name = map.text(key);
  return name.empty() ? name : (map.context().reader.folder() / name).lexically_normal().string();
}

/// Entries of a map from paths or names. A duplicate key is an error.
std::vector<const YamlNode*> pairs(const MapReader& map, std::string_view key) {
  return map.entries(key, std::string(key));
}

std::vector<StudySetting> read_settings(const MapReader& map) {
  std::vector<StudySetting> settings;
  for (const YamlNode* node : pairs(map, "set")) settings.push_back({node->key, *node});
  return settings;
}

std::vector<StudyAxis> read_axes(const MapReader& map) {
  std::vector<StudyAxis> axes;
  for (const YamlNode* node : pairs(map, "axes")) {
    const Context entry = entry_context(map.context().reader, "axis", *node);
    if (node->kind != YamlKind::sequence || node->children.empty())
      entry.fail(node->place, fmt::format("needs a list of values, not {}", describe(*node)),
                 "write the values from coarse to fine: [0.01, 0.005, 0.0025]");
    axes.push_back({node->key, node->children, entry.entry});
  }
  return axes;
}

std::vector<StudyPart> read_parts(const MapReader& top) {
  std::vector<StudyPart> parts;
  for (const YamlNode* node : pairs(top, "parts")) {
    const MapReader map(entry_context(top.context().reader, "part", *node), *node, "study_part");
    auto part = read_entry<StudyPart>(map);
    part.file = file_of(map, "file");
    part.set = read_settings(map);
    parts.push_back(std::move(part));
  }
  return parts;
}

std::map<std::string, YamlNode> read_named(const MapReader& map, std::string_view key) {
  std::map<std::string, YamlNode> values;
  for (const YamlNode* node : pairs(map, key)) values.emplace(node->key, *node);
  return values;
}

StudySeries read_series(const MapReader& top, const YamlNode& node, const std::vector<StudyAxis>& shared_axes,
                        const std::vector<StudySetting>& shared) {
  const MapReader map(entry_context(top.context().reader, "series", node), node, "study_series");
  auto series = read_entry<StudySeries>(map);
  series.scene = file_of(map, "scene");
  series.axes = read_axes(map);
  for (const StudyAxis& axis : shared_axes)
    if (std::ranges::find(series.axes, axis.name, &StudyAxis::name) == series.axes.end()) series.axes.push_back(axis);
  series.set = shared;
  for (StudySetting& own : read_settings(map)) {
    std::erase_if(series.set, [&](const StudySetting& other) { return other.path == own.path; });
    series.set.push_back(std::move(own));
  }
  series.parts = read_parts(map);
  series.channels = read_named(map, "channels");
  return series;
}

void read_quantities(const MapReader& root, Study& study) {
  for (const YamlNode* node : root.entries("quantities", "quantity")) {
    const MapReader map(entry_context(root.context().reader, "quantity", *node), *node, "study_quantity");
    auto quantity = read_entry<StudyQuantity>(map);
    if (const YamlNode* channel = map.require("channel")) quantity.channel = *channel;
    study.quantities.push_back(std::move(quantity));
  }
}

void read_reference(const MapReader& root, Study& study) {
  const YamlNode* node = root.find("reference");
  if (node == nullptr) return;
  const Context context{root.context().reader, "reference", "reference"};
  const MapReader map(context, *node, "study_reference");
  StudyReference& reference = study.reference;
  read_fields(map, reference);
  if (map.has("file")) reference.file = file_of(map, "file");
  if (map.has("file") == map.has("runs")) map.fail("needs either 'file' or 'runs'", "give one of them");
  for (const auto& [quantity, column] : read_named(map, "columns"))
    reference.columns[quantity] = read_text(context, column, "a column");
  const YamlNode* runs = map.find("runs");
  if (runs == nullptr) return;
  if (runs->kind != YamlKind::sequence || runs->children.empty() || runs->children.size() > 2)
    return map.fail("'runs' needs a list of one or two runs", "write [{series: ..}, {series: ..}]");
  for (const YamlNode& one : runs->children) {
    const MapReader run_map(context, one, "study_run");
    StudyRun run;
    run.where = context.reader.where(one.place);
    read_fields(run_map, run);
    run.at = read_named(run_map, "at");
    run.set = read_settings(run_map);
    reference.runs.push_back(std::move(run));
  }
}

}  // namespace

std::vector<NamedType> study_types() {
  std::vector<NamedType> types = common_types();
  types.push_back({"setting_path", "/^[^.=]+([.][^.=]+)*$/", "as in `--set`"});
  types.push_back({"axis_values", "[any]1.."});
  return types;
}

std::vector<KeySet> study_key_sets() {
  const Field set{
      "set", "{setting_path: any}",
      "path -> value, as with `--set`; `$name` is the value of an axis, `${formula}` a number computed from axes",
      "none"};
  const Field axes{"axes", "{text: axis_values}",
                   "name -> list of values, from coarse to fine. A name with a point, such as `integrator.step`, is "
                   "also the path that is set",
                   "none"};
  std::vector<KeySet> sets{
      {"study",
       {plain<&Study::name>("study", "text+", "title of the study", "required"),
        {"series", "{name: study_series}+", "name -> scene with its own axes; all combinations of axis values run",
         "required"},
        axes,
        set,
        {"quantities", "{name: study_quantity}+", "name -> quantity whose error is measured, and its norm", "required"},
        {"reference", "study_reference", "results with which all runs are compared",
         "the last values of all axes of the first series"},
        plain<&Study::along>("along", "text", "axis whose points a line of the diagrams connects",
                             "the last of each series"),
        choice<&Study::timing, timings>(
            "timing",
            "`alone`: one run at a time, repeated until the median time is known. `together`: each run once, several "
            "in parallel; errors are the same, times are approximate"),
        plain<&Study::within>("within", "positive",
                              "relative half width of the interval in which the median time must lie"),
        plain<&Study::repeats>("repeats", "integer>0", "largest number of runs of one setting"),
        plain<&Study::run_budget>("run_budget", "number>=0", "limit of the wall-clock time of one run [s]; 0: none")}},
      {"study_series",
       {{"scene", "text", "scene file, relative to the study file", "required"},
        plain<&StudySeries::analysis>("analysis", "text", "one of the scene's `analyses`", "its only one"),
        axes,
        set,
        {"parts", "{name: study_part}", "name -> part that is reduced for each of its settings", "none"},
        {"channels", "{name: text}", "quantity -> its channel in this series, if the name differs", "none"}}},
      {"study_part",
       {{"file", "text", "part file, relative to the study file", "required"},
        plain<&StudyPart::as>(
            "as", "text | [text]1..",
            "path, or list of paths, of the scene that is set to the name of the superelement file: `bodies.arm.file`",
            "required"),
        set}},
      {"study_quantity",
       {{"channel", "text", "channel of the results; `$name` and `${formula}` as in `set`", "required"},
        choice<&StudyQuantity::norm, error_norms>("norm", "norm of the error, see the table below"),
        plain<&StudyQuantity::from>("from", "number", "first instant, or first mode, that counts", "the first"),
        plain<&StudyQuantity::to>("to", "number", "last instant, or last mode, that counts", "the last"),
        plain<&StudyQuantity::scale>("scale", "positive", "number by which errors are divided",
                                     "the size of the reference in the same norm; 1 for `peak_time`")}},
      {"study_reference",
       {{"file", "text", "CSV or results file, relative to the study file"},
        plain<&StudyReference::source>("source", "text", "origin of the file; the report page shows it"),
        plain<&StudyReference::time>("time", "text", "column of the times, by name or number", "`t`"),
        {"columns", "{name: text}", "quantity -> column of the CSV file, or channel of the results file",
         "the name of the quantity; its channel"},
        {"runs", "[study_run]1..2", "one run of this study; or two runs, which must agree before errors are measured"},
        plain<&StudyReference::agree>("agree", "positive",
                                      "largest allowed error of the second run against the first")}},
      {"study_run",
       {plain<&StudyRun::series>("series", "text", "name of a series", "the first"),
        {"at", "{text: any}", "axis -> value; the value need not be listed on the axis", "the last value of each"},
        set}}};
  const std::vector<KeySet> common = common_key_sets();
  sets.insert(sets.end(), common.begin(), common.end());
  return sets;
}

Study read_study(const std::string& path) {
  Study study;
  study.document = load_yaml(path);
  study.file = path;
  study.reference.time = "t";
  YamlReader reader(study.document, study_key_sets());
  require_kind(reader, "study", "scene", "give it to `mechanism run`");
  const Context context{reader, "", path};
  const MapReader root(context, reader.root(), "study");
  read_fields(root, study);
  const std::vector<StudyAxis> axes = read_axes(root);
  const std::vector<StudySetting> set = read_settings(root);
  for (const YamlNode* node : root.entries("series", "series"))
    study.series.push_back(read_series(root, *node, axes, set));
  read_quantities(root, study);
  read_reference(root, study);
  Faults faults;
  find_faults(study, faults);
  reader.raise(faults);
  return study;
}

}  // namespace tisserand::formats
