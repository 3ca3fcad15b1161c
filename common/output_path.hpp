// Between the command line and the work: whether a file may be written, asked before anything is computed or lost.
#pragma once

#include <string>
#include <vector>

namespace tisserand {

/// What an existing file must be, so that it may be replaced.
enum class Replaces { anything, hdf5_only };

/// Throws Error if `path` is empty, a folder, a device, in a folder that is missing or not writable, one of the
/// `inputs` of the same command, or (hdf5_only) an existing file of another kind, which was hardly meant to be
/// replaced.
void require_output(const std::string& path, const std::vector<std::string>& inputs, Replaces replaces);

/// Whether text written to `path` goes through it rather than into it: /dev/stdout, a device, a pipe.
bool is_stream(const std::string& path);

}  // namespace tisserand
