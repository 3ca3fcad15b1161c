// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that study.yaml defines: every combination of axes as a scene with settings.
#pragma once

#include <string>
#include <vector>

#include "formats/study/study.hpp"

namespace tisserand::mechanism {

/// Request for a superelement file: a part file with the settings that one run needs.
struct PartRequest {
  std::string name;
  std::string file;  ///< path of the part file
  std::vector<formats::Override> settings;
  std::string key;  ///< SHA-256 of the part file, the files that it names, its settings and this version
  /// Path of the superelement file made from the part, which all runs with equal key share.
  std::string superelement;
};

/// One run of a study: a combination of values on the axes of a series.
struct Cell {
  int series = 0;
  std::vector<std::string> values;          ///< values of the axes of the series, in the order of the axes
  std::vector<int> index;                   ///< index of each value on its axis; -1: only a reference has this value
  std::string label;                        ///< label such as "beam: modes = 4, step = 0.01"
  std::vector<formats::Override> settings;  ///< settings of the scene, with paths of superelement files
  std::vector<PartRequest> parts;
  std::vector<std::string> channels;  ///< channels to measure, one per quantity
  std::string key;                    ///< SHA-256 of everything on which the results depend
};

/// All runs of a study.
struct StudyCells {
  std::vector<Cell> cells;
  std::vector<Cell> references;  ///< runs of the reference; empty if the reference is a file
};

/// Plans all runs of a study whose files are in `folder`. Reads every scene and part with its settings, so that a path
/// which exists in no file is reported before any run. Throws Error that names the run.
StudyCells plan_cells(const formats::Study& study, const std::string& folder);

/// Command line arguments for the settings: --set path=value ...
std::vector<std::string> setting_words(const std::vector<formats::Override>& settings);

}  // namespace tisserand::mechanism
