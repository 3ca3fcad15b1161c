// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of output paths from the command line, made before anything is computed or lost.
#pragma once

#include <string>
#include <vector>

namespace tisserand {

/// Throws Error if `path` is empty, a folder, in a missing or unwritable folder, one of the `inputs` of the command,
/// or has none of the `endings` (".csv", ".results.h5"). ".companion.h5" and the other double endings of this project
/// do not count as ".h5". For HDF5 output, a device and an existing file of another kind are errors too. For other
/// output, "-" and devices are streams.
void require_output(const std::string& path, const std::vector<std::string>& endings,
                    const std::vector<std::string>& inputs);

/// `path` without the first of `endings` that it has. The whole path if it has none of them or nothing would be left.
std::string without_ending(const std::string& path, const std::vector<std::string>& endings);

/// Whether text for `path` is streamed instead of stored in a file: -, /dev/stdout, a device, a pipe.
bool is_stream(const std::string& path);

}  // namespace tisserand
