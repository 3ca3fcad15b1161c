// From study.yaml to the runs that it means: every combination of axes as a scene with settings.
#pragma once

#include <string>
#include <vector>

#include "formats/study/study.hpp"

namespace tisserand::mechanism {

/// A part with the settings with which one run needs it.
struct PartRequest {
  std::string name;
  std::string file;
  std::vector<formats::Override> settings;
  std::string key;           ///< SHA-256 of the part file, what it names, its settings and this version
  std::string superelement;  ///< path of the file that comes of it, shared by all runs of equal key
};

/// One run of a study.
struct Cell {
  int series = 0;
  std::vector<std::string> values;          ///< of the axes of the series, in their order
  std::vector<int> index;                   ///< of each in the list of its axis; -1: of a reference alone
  std::string label;                        ///< "beam: modes = 4, step = 0.01"
  std::vector<formats::Override> settings;  ///< superelement files included
  std::vector<PartRequest> parts;
  std::vector<std::string> channels;  ///< of each quantity
  std::string key;                    ///< SHA-256 of all that its results depend on
};

struct StudyCells {
  std::vector<Cell> cells;
  std::vector<Cell> references;  ///< none where the reference is a file
};

/// All runs of a study whose files go into `folder`. Every scene and part is read with its settings, so that a path
/// that exists in no file is told before anything runs. Throws Error with the run that it is about.
StudyCells plan_cells(const formats::Study& study, const std::string& folder);

/// The words of the settings: --set path=value ...
std::vector<std::string> setting_words(const std::vector<formats::Override>& settings);

}  // namespace tisserand::mechanism
