// Between the command line and the work: whether a file may be written, asked before anything is computed or lost.
#pragma once

#include <string>
#include <vector>

namespace tisserand {

/// Throws Error if `path` is empty, a folder, in a folder that is missing or not writable, one of the `inputs` of the
/// same command, or has none of the `endings` (".csv", ".results.h5"). A name that ends in ".companion.h5" is that of
/// a companion file, and does not count as ".h5". Where the output is HDF5,
/// a device and an existing file of another kind are errors, too. Elsewhere "-" and devices are streams.
void require_output(const std::string& path, const std::vector<std::string>& endings,
                    const std::vector<std::string>& inputs);

/// `path` without the first of these endings that it has and more than that; the whole path if it has none.
std::string without_ending(const std::string& path, const std::vector<std::string>& endings);

/// Whether text written to `path` goes through it rather than into it: -, /dev/stdout, a device, a pipe.
bool is_stream(const std::string& path);

}  // namespace tisserand
