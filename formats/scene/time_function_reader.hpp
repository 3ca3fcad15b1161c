// The components of a load as functions of time, and laws of springs as tables.
#pragma once

#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

inline constexpr Choice<Interpolation> interpolations[] = {{"linear", Interpolation::linear},
                                                           {"cubic", Interpolation::cubic}};

inline constexpr Choice<TableMotion> table_motions[] = {
    {"smooth", TableMotion::smooth}, {"natural", TableMotion::natural}, {"linear", TableMotion::linear}};

/// A number, a text (expression in t), {expression: .., breakpoints: [..]}, {table: [[t, value], ..]} or {file:
/// table.csv}.
TimeFunctionSpec read_time_function(const Context& context, const YamlNode& node, const std::string& what);

/// The same for prescribed motions, whose tables may have an `interpolation`.
TimeFunctionSpec read_motion_function(const Context& context, const YamlNode& node, const std::string& what);

/// Times of a table and breakpoints increase; values are finite; the expression has a text.
void check_time_function(const TimeFunctionSpec& function, const std::string& key, const Subject& subject);

/// {table: [[x, y], ..], interpolation: linear | cubic} or {file: table.csv, ..}.
CurveSpec read_curve(const Context& context, const YamlNode& node, const std::string& what);

/// At least two points, x increases, values are finite.
void check_curve(const CurveSpec& curve, const std::string& key, const Subject& subject);

/// Lists of fields of the maps above.
std::vector<KeySet> time_function_key_sets();

}  // namespace tisserand::formats
