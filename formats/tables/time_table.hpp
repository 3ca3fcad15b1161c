// SPDX-License-Identifier: GPL-3.0-or-later
// Points of a function of time, from columns of a file or a list in a scene.
#pragma once

#include <vector>

namespace tisserand::formats {

/// Interpolation of a table for a prescribed motion (mechanism/forces/motion_table.hpp). Loads are always linear.
enum class TableMotion { smooth, natural, linear };

/// Two columns of equal length. Time ascends.
struct TimeTable {
  std::vector<double> time;
  std::vector<double> value;
  TableMotion motion = TableMotion::smooth;
};

}  // namespace tisserand::formats
