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

/// Setting with its value as in the file. $axis and ${formula} are replaced for each run.
struct StudySetting {
  std::string path;
  YamlNode value;
};

/// Varied quantity. A name with a point is itself the path that is set.
struct StudyAxis {
  std::string name;
  std::vector<YamlNode> values;  ///< from coarse to fine
  std::string where;

  bool sets_path() const { return name.find('.') != std::string::npos; }
};

/// Part that is reduced for each of its settings.
struct StudyPart {
  std::string name;
  std::string file;             ///< resolved path of the part file
  std::vector<std::string> as;  ///< paths of the scene that name its superelement file
  std::vector<StudySetting> set;
  std::string where;
};

/// Scene with all combinations of its axes.
struct StudySeries {
  std::string name;
  std::string scene;              ///< resolved path
  std::string analysis;           ///< analysis of the scene; empty: its only one
  std::vector<StudyAxis> axes;    ///< axes of the series, then those of the study
  std::vector<StudySetting> set;  ///< settings of the study, then those of the series
  std::vector<StudyPart> parts;
  std::map<std::string, YamlNode> channels;  ///< quantity -> channel, if it differs from the study's
  std::string where;
};

struct StudyQuantity {
  std::string name;
  YamlNode channel;
  ErrorNorm norm = ErrorNorm::max;
  std::optional<double> from, to;  ///< instants [time of the scene]; absent: whole run
  std::optional<double> scale;     ///< divisor of errors; absent: size of the reference
  std::string where;
};

/// Reference run. An axis without a value has its last one.
struct StudyRun {
  std::string series;
  std::map<std::string, YamlNode> at;
  std::vector<StudySetting> set;
  std::string where;
};

struct StudyReference {
  std::string file;                            ///< resolved path of CSV or results; empty: runs
  std::string source;                          ///< source of the file
  std::string time;                            ///< column of CSV
  std::map<std::string, std::string> columns;  ///< quantity -> column of CSV, or channel of results
  std::vector<StudyRun> runs;                  ///< one run, or two that must agree; empty without file: the finest
  double agree = 0.01;                         ///< largest error of one run relative to the other
};

enum class StudyTiming { alone, together };

struct Study {
  std::string name;
  std::string file;  ///< path of the study
  std::vector<StudySeries> series;
  std::vector<StudyQuantity> quantities;
  StudyReference reference;
  std::string along;  ///< axis that connects the points of a line; empty: the last one of each series
  StudyTiming timing = StudyTiming::alone;
  double within = 0.05;     ///< required relative half width of the interval of the median time
  int repeats = 9;          ///< largest number of runs of one setting
  double run_budget = 0.0;  ///< limit of elapsed time [s]; 0: none
  YamlDocument document;    ///< for places of messages
};

/// Values of the axes of one run, by name.
using StudyPoint = std::map<std::string, YamlNode>;

/// Settings of a series at a point, with axes replaced. Throws Error with the place of a name that is no axis.
std::vector<Override> settings_at(const Study& study, const StudySeries& series, const StudyPoint& point);
std::vector<Override> settings_at(const Study& study, const std::vector<StudySetting>& set, const StudyPoint& point);
/// Channel of a quantity in a series at a point.
std::string channel_at(const Study& study, const StudySeries& series, const StudyQuantity& quantity,
                       const StudyPoint& point);

/// Reads and checks a study: names, references, unused axes. Throws all errors together.
Study read_study(const std::string& path);

/// Lists of the fields of study.yaml and the types that they refer to.
std::vector<KeySet> study_key_sets();
std::vector<NamedType> study_types();

}  // namespace tisserand::formats
