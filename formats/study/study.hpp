// SPDX-License-Identifier: GPL-3.0-or-later
// study.yaml: runs that compare accuracy with cost, and the measures of their errors (formats/STUDY.md).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/scene/error_norm.hpp"
#include "formats/yaml/field.hpp"
#include "formats/yaml/override.hpp"
#include "formats/yaml/tree.hpp"

namespace tisserand::formats {

/// Setting of a value in a scene or part file, with the value as written in the study. $axis and ${formula} in the
/// value are replaced for each run.
struct StudySetting {
  std::string path;
  YamlNode value;
};

/// Axis of a study: a quantity that is varied. A name with a point is itself the path of the value that is set.
struct StudyAxis {
  std::string name;
  std::vector<YamlNode> values;  ///< values, from coarse to fine
  std::string where;

  bool sets_path() const { return name.find('.') != std::string::npos; }
};

/// Part of a series that is reduced once for each of its settings.
struct StudyPart {
  std::string name;
  std::string file;             ///< resolved path of the part file
  std::vector<std::string> as;  ///< paths of the scene's keys whose value is the superelement file
  std::vector<StudySetting> set;
  std::string where;
};

/// Series of runs: a scene with all combinations of the values of its axes.
struct StudySeries {
  std::string name;
  std::string scene;              ///< resolved path
  std::string analysis;           ///< analysis of the scene; empty: its only one
  std::vector<StudyAxis> axes;    ///< axes of the series, then those of the study
  std::vector<StudySetting> set;  ///< settings of the study, then those of the series
  std::vector<StudyPart> parts;
  std::map<std::string, YamlNode> channels;  ///< quantity -> channel, where it differs from the study's
  std::string where;
};

/// Compared quantity of a study: a channel and the norm of its errors.
struct StudyQuantity {
  std::string name;
  YamlNode channel;
  ErrorNorm norm = ErrorNorm::max;
  std::optional<double> from, to;  ///< compared span [time of the scene]; absent: whole run
  std::optional<double> scale;     ///< divisor of errors; absent: size of the reference
  std::string where;
};

/// Run that serves as reference. An axis without a value in `at` has its last value.
struct StudyRun {
  std::string series;
  std::map<std::string, YamlNode> at;
  std::vector<StudySetting> set;
  std::string where;
};

/// Reference of a study's errors: a file or runs.
struct StudyReference {
  std::string file;                            ///< resolved path of CSV or results; empty: runs
  std::string source;                          ///< source of the file's data, as text
  std::string time;                            ///< column of CSV with the time
  std::map<std::string, std::string> columns;  ///< quantity -> column of CSV, or channel of results
  std::vector<StudyRun> runs;  ///< one run, or two that must agree; empty without `file`: the finest run
  double agree = 0.01;         ///< largest allowed error of one reference run relative to the other
};

enum class StudyTiming { alone, together };

/// Study as its file describes it: series of runs, compared quantities, reference and timing.
struct Study {
  std::string name;
  std::string file;  ///< path of the study
  std::vector<StudySeries> series;
  std::vector<StudyQuantity> quantities;
  StudyReference reference;
  std::string along;  ///< axis that connects the points of a line; empty: the last one of each series
  StudyTiming timing = StudyTiming::alone;
  double within = 0.05;     ///< required half width of the interval of the median time, relative to it
  int repeats = 9;          ///< largest number of runs of one setting
  double run_budget = 0.0;  ///< limit of the elapsed time of a run [s]; 0: none
  YamlDocument document;    ///< YAML tree of the study, for places in messages
};

/// Values of the axes in one run, by name of the axis.
using StudyPoint = std::map<std::string, YamlNode>;

/// Overrides of a series, or of the list `set`, at a point, with axes replaced by their values. Throws Error with the
/// place of a name that is no axis.
std::vector<Override> settings_at(const Study& study, const StudySeries& series, const StudyPoint& point);
std::vector<Override> settings_at(const Study& study, const std::vector<StudySetting>& set, const StudyPoint& point);
/// Channel of a quantity in a series at a point, with axes replaced by their values.
std::string channel_at(const Study& study, const StudySeries& series, const StudyQuantity& quantity,
                       const StudyPoint& point);

/// Reads and checks a study: names, references, unused axes. Throws one Error with all errors.
Study read_study(const std::string& path);

/// Fields of study.yaml, one KeySet for each kind of map; study_types() returns the types to which they refer.
std::vector<KeySet> study_key_sets();
std::vector<NamedType> study_types();

}  // namespace tisserand::formats
