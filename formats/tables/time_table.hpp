// SPDX-License-Identifier: GPL-3.0-or-later
// Points of a function of time, from columns of a file or a list in a scene.
#pragma once

#include <vector>

namespace tisserand::formats {

/// Interpolation of a table that prescribes a motion (mechanism/forces/motion_table.hpp). Tables of loads are always
/// linear.
enum class TableMotion { smooth, natural, linear };

/// Table of a function of time: times, which ascend, and as many values.
struct TimeTable {
  std::vector<double> time;
  std::vector<double> value;
  TableMotion motion = TableMotion::smooth;
};

}  // namespace tisserand::formats
