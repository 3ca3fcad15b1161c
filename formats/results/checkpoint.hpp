// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoint file *.checkpoint.h5: the state from which a run continues (formats/RESULTS.md).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tisserand::formats {

/// Contents of a checkpoint file: the state from which a run continues.
struct Checkpoint {
  std::string scene;        ///< name of the scene
  std::string producer;     ///< program and version
  std::string fingerprint;  ///< identity of the model: names, sizes, superelements
  int state_version = 0;
  double time = 0.0;
  std::string results;           ///< file name of the run's results, in the folder of the checkpoint
  std::string run;               ///< identity of these results: ResultsWriter::run()
  std::size_t rows = 0;          ///< number of rows of the results at the checkpoint
  std::vector<double> state;     ///< numbers of the state from which the run continues
  std::vector<double> schedule;  ///< positions in the schedules of steps and output
  std::string values;            ///< values of the scene (formats::scene_values); empty before version 1.2
  std::string off = {};          ///< automatic effects that are switched off, one per line; since version 1.3
};

/// Writes a checkpoint, so that the file appears complete or not at all, also if it replaces another. Throws Error
/// (disk full, ...).
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// Reads a checkpoint. Throws Error if the file is missing, cut short, damaged, or of another kind or version.
Checkpoint read_checkpoint(const std::string& path);

/// Whether the file states that it is a checkpoint. Throws Error if it cannot be opened.
bool is_checkpoint(const std::string& path);

}  // namespace tisserand::formats
