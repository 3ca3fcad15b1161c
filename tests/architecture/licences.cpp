// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <regex>

#include "tests/architecture/rules.hpp"

namespace tisserand::architecture {
namespace {

constexpr const char* licence = "SPDX-License-Identifier: GPL-3.0-or-later";

bool names_licence(const SourceFile& file) {
  const std::size_t last = std::min<std::size_t>(file.lines.size(), 2);
  return std::any_of(file.lines.begin(), file.lines.begin() + static_cast<std::ptrdiff_t>(last),
                     [](const std::string& line) { return line.find(licence) != std::string::npos; });
}

}  // namespace

std::size_t SourceFile::length() const { return lines.size() - (names_licence(*this) ? 1 : 0); }

std::vector<Violation> check_licences(const SourceTree& tree) {
  static const std::regex source(R"(\.(cpp|hpp|ts|mjs|css|cmake|py|sh)$|(^|/)CMakeLists\.txt$)");
  std::vector<Violation> violations;
  for (const SourceFile& file : tree.files) {
    const bool is_script = !file.lines.empty() && file.lines.front().starts_with("#!");
    if ((is_script || std::regex_search(file.path, source)) && !names_licence(file))
      violations.push_back({file.path, 1, "names no licence (SPDX-License-Identifier)"});
  }
  return violations;
}

}  // namespace tisserand::architecture
