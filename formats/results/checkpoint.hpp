// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoint file *.checkpoint.h5: the state from which a run continues (formats/RESULTS.md).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tisserand::formats {

struct Checkpoint {
  std::string scene;        ///< name of the scene
  std::string producer;     ///< program and version
  std::string fingerprint;  ///< identity of the model: names, sizes, superelements
  int state_version = 0;
  double time = 0.0;
  std::string results;           ///< file name of the results of the run, in the same folder
  std::string run;               ///< identity of these results: ResultsWriter::run()
  std::size_t rows = 0;          ///< number of their rows at the checkpoint
  std::vector<double> state;     ///< state block
  std::vector<double> schedule;  ///< positions in the schedules of steps and output
  std::string values;            ///< values of the scene (formats::scene_values); empty before version 1.2
  std::string off = {};          ///< inactive automatic effects, one per line; since 1.3
};

/// Writes the file so that it appears complete or not at all, also if it replaces one. Throws Error (disk full, ...).
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// Reads a checkpoint. Throws Error: missing, cut short, of another kind or version, damaged.
Checkpoint read_checkpoint(const std::string& path);

/// Whether the file states that it is a checkpoint. Throws Error if it cannot be opened.
bool is_checkpoint(const std::string& path);

}  // namespace tisserand::formats
