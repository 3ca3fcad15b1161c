// SPDX-License-Identifier: GPL-3.0-or-later
// Readers of functions of time (components of loads) and of tables (laws of springs).
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

/// Reads a function of time: a number, a text (expression in t), {expression: .., breakpoints: [..]}, {table: [[t,
/// value], ..]} or {file: table.csv}.
TimeFunctionSpec read_time_function(const Context& context, const YamlNode& node, const std::string& what);

/// Reads the function of a prescribed motion, whose tables may also have an `interpolation`.
TimeFunctionSpec read_motion_function(const Context& context, const YamlNode& node, const std::string& what);

/// Checks that times of a table and breakpoints increase, that values are finite and that an expression is not empty.
void check_time_function(const TimeFunctionSpec& function, const std::string& key, const Subject& subject);

/// Reads a curve y(x): {table: [[x, y], ..], interpolation: linear | cubic} or {file: table.csv, ..}.
CurveSpec read_curve(const Context& context, const YamlNode& node, const std::string& what);

/// Checks that a curve has at least two points, increasing x and finite values.
void check_curve(const CurveSpec& curve, const std::string& key, const Subject& subject);

/// Fields of the maps that the readers of this header read.
std::vector<KeySet> time_function_key_sets();

}  // namespace tisserand::formats
