// Checkpoint file *.checkpoint.h5: all that a run needs to go on (formats/RESULTS.md).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tisserand::formats {

struct Checkpoint {
  std::string scene;        ///< name
  std::string producer;     ///< program and version
  std::string fingerprint;  ///< of the model: names, sizes, superelements
  int state_version = 0;
  double time = 0.0;
  std::string results;           ///< name, without folder, of the results of the run, which lie beside it
  std::string run;               ///< of these results: ResultsWriter::run()
  std::size_t rows = 0;          ///< of these results until then
  std::vector<double> state;     ///< the state block
  std::vector<double> schedule;  ///< where steps and output stand
  std::string values;            ///< of the scene (formats::scene_values); empty before version 1.2
  std::string off = {};          ///< automatic effects that are off, one in a line; since 1.3
};

/// The file appears whole or not at all, also where it replaces an older one. Throws Error (disk full, ...).
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// Throws Error: missing, cut short, of another kind or version, damaged.
Checkpoint read_checkpoint(const std::string& path);

/// Whether a file says of itself that it is a checkpoint. Throws Error if it cannot be opened.
bool is_checkpoint(const std::string& path);

}  // namespace tisserand::formats
