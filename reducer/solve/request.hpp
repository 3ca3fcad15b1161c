// What `reducer solve` is asked for on the command line, beside the part.
#pragma once

#include <string>
#include <vector>

namespace tisserand::reducer {

struct SolveRequest {
  int modes = 0;                    ///< of the supported part, lowest first
  std::vector<std::string> points;  ///< more nodes of the table: labels, or "x,y,z" of the part frame
  int buckling = 0;                 ///< load factors of each load case, lowest first
};

}  // namespace tisserand::reducer
