// SPDX-License-Identifier: GPL-3.0-or-later
// Program name and version, as `--version` prints and every written file stores them.
#pragma once

#include <string>
#include <string_view>

namespace tisserand {

/// Version of the project, "0.2.0".
std::string version();

/// Name of the producer of a file, "Tisserand reducer 0.2.0". `program`: reducer or mechanism.
std::string producer(std::string_view program);

/// HTML head element that names the producer of the page.
std::string generator_tag(std::string_view program);

/// Output of `--version`: version, commit, compiler, libraries. Each program links its own (cmake/Version.cmake).
std::string version_text();

}  // namespace tisserand
