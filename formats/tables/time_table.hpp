// Points of a function of time, as a file of columns or a list in a scene gives them.
#pragma once

#include <vector>

namespace tisserand::formats {

/// Two columns of one length; time ascends.
struct TimeTable {
  std::vector<double> time;
  std::vector<double> value;
};

}  // namespace tisserand::formats
