// Points of a function of time, as a file of columns or a list in a scene gives them.
#pragma once

#include <vector>

namespace tisserand::formats {

/// What a prescribed motion makes of a table (mechanism/forces/motion_table.hpp); loads are linear between points.
enum class TableMotion { smooth, natural, linear };

/// Two columns of one length; time ascends.
struct TimeTable {
  std::vector<double> time;
  std::vector<double> value;
  TableMotion motion = TableMotion::smooth;
};

}  // namespace tisserand::formats
