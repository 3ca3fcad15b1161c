// SPDX-License-Identifier: GPL-3.0-or-later
// Arguments of `reducer recover` on the command line.
#pragma once

#include <string>
#include <vector>

namespace tisserand::reducer {

/// Frame of recovered displacements and positions: the world, or the part at rest in its own frame.
enum class RecoverFrame { world, part };

/// Finite element programs for which load cases are written.
enum class LoadFormat { nastran, calculix };

/// Arguments of `reducer recover`.
struct RecoverRequest {
  std::string recovery;  ///< path of the recovery file, such as part.recovery.h5
  std::string results;   ///< path of the results file, such as run.results.h5
  std::string body;      ///< name of the body; empty: the only superelement of the results
  std::string output;    ///< folder of the files; empty: "<body>.recovered" next to the results
  /// Requested times, for which the nearest stored instants are used; empty: all instants.
  std::vector<double> times;
  int every = 1;                      ///< n, of which only every n-th requested instant is used
  bool envelope_only = false;         ///< true: the series of VTU files is not written
  std::vector<std::string> points;    ///< nodes of the histories: labels, or "x,y,z" in the part frame
  std::vector<std::string> elements;  ///< elements of the histories: "12", or "group/12"
  std::vector<std::string> groups;    ///< groups of the histories: names
  std::vector<LoadFormat> loads;      ///< programs for which load cases of the chosen instants are written
  RecoverFrame frame = RecoverFrame::world;
};

}  // namespace tisserand::reducer
