// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that study.yaml defines: every combination of axes as a scene with settings.
#pragma once

#include <string>
#include <vector>

#include "formats/study/study.hpp"

namespace tisserand::mechanism {

/// A part with the settings that one run needs.
struct PartRequest {
  std::string name;
  std::string file;
  std::vector<formats::Override> settings;
  std::string key;           ///< SHA-256 of the part file, the files that it names, its settings and this version
  std::string superelement;  ///< path of the file made from it, shared by all runs of equal key
};

/// One run of a study.
struct Cell {
  int series = 0;
  std::vector<std::string> values;          ///< values of the axes of the series, in their order
  std::vector<int> index;                   ///< index of each value on its axis; -1: used by a reference only
  std::string label;                        ///< "beam: modes = 4, step = 0.01"
  std::vector<formats::Override> settings;  ///< includes superelement files
  std::vector<PartRequest> parts;
  std::vector<std::string> channels;  ///< one per quantity
  std::string key;                    ///< SHA-256 of everything on which its results depend
};

struct StudyCells {
  std::vector<Cell> cells;
  std::vector<Cell> references;  ///< empty if the reference is a file
};

/// All runs of a study with its files in `folder`. Every scene and part is read with its settings, so a path that
/// exists in no file is reported before any run. Throws Error with the run that it concerns.
StudyCells plan_cells(const formats::Study& study, const std::string& folder);

/// Command line arguments of the settings: --set path=value ...
std::vector<std::string> setting_words(const std::vector<formats::Override>& settings);

}  // namespace tisserand::mechanism
