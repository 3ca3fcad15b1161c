// What `reducer recover` is asked for on the command line.
#pragma once

#include <string>
#include <vector>

namespace tisserand::reducer {

/// Where displacements and positions are told: in the world, or on the part at rest in its own frame.
enum class RecoverFrame { world, part };

struct RecoverRequest {
  std::string recovery;             ///< part.recovery.h5
  std::string results;              ///< run.results.h5
  std::string body;                 ///< empty: the only superelement of the results
  std::string output;               ///< folder of the series; empty: body.recovered beside the results
  std::vector<double> times;        ///< the nearest stored instants; empty: all
  int every = 1;                    ///< only every n-th of them
  std::vector<std::string> points;  ///< labels of nodes, or "x,y,z" of the part frame
  RecoverFrame frame = RecoverFrame::world;
};

}  // namespace tisserand::reducer
