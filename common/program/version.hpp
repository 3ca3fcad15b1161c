// Program and version, as `--version` prints and every written file names them.
#pragma once

#include <string>
#include <string_view>

namespace tisserand {

/// Version of the project, "0.2.0".
std::string version();

/// Producer of a file, "Tisserand reducer 0.2.0". `program`: reducer or mechanism.
std::string producer(std::string_view program);

/// Element of the head of an HTML page that names its producer.
std::string generator_tag(std::string_view program);

/// Lines that `--version` prints: version, commit, compiler, libraries. Each program has its own (cmake/Version.cmake).
std::string version_text();

}  // namespace tisserand
