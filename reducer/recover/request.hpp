// SPDX-License-Identifier: GPL-3.0-or-later
// Arguments of `reducer recover` on the command line.
#pragma once

#include <string>
#include <vector>

namespace tisserand::reducer {

/// Frame of displacements and positions: the world, or the part at rest in its own frame.
enum class RecoverFrame { world, part };

/// Programs for which loads are written.
enum class LoadFormat { nastran, calculix };

struct RecoverRequest {
  std::string recovery;               ///< part.recovery.h5
  std::string results;                ///< run.results.h5
  std::string body;                   ///< empty: the only superelement of the results
  std::string output;                 ///< folder of the files; empty: body.recovered next to the results
  std::vector<double> times;          ///< nearest stored instants are used; empty: all
  int every = 1;                      ///< only every n-th instant
  bool envelope_only = false;         ///< true: no series
  std::vector<std::string> points;    ///< labels of nodes, or "x,y,z" of the part frame
  std::vector<std::string> elements;  ///< "12", or "group/12"
  std::vector<std::string> groups;    ///< names of groups
  std::vector<LoadFormat> loads;      ///< load cases of the chosen instants for these programs
  RecoverFrame frame = RecoverFrame::world;
};

}  // namespace tisserand::reducer
