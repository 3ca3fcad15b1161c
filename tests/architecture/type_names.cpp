// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <regex>
#include <utility>

#include "tests/architecture/rules.hpp"

namespace tisserand::architecture {

std::vector<Violation> check_type_names(const SourceTree& tree) {
  static const std::regex opens(R"(^(?:inline )?namespace ([\w:]*) ?\{)"), closes(R"(^\}  // namespace)");
  static const std::regex defines(
      R"(^(?:struct|class|union) (?:alignas\([^)]*\) )?(\w+)(?: final)?(?: :[^:].*)?(?: \{|$))");
  std::map<std::string, std::string> place;
  std::vector<Violation> violations;
  for (const SourceFile& file : tree.files) {
    if (!file.is_source()) continue;
    std::vector<std::string> spaces;
    for (std::size_t i = 0; i < file.code.size(); ++i) {
      std::smatch found;
      if (std::regex_search(file.code[i], found, opens)) spaces.push_back(found[1]);
      if (std::regex_search(file.lines[i], closes) && !spaces.empty()) spaces.pop_back();
      if (!std::regex_search(file.code[i], found, defines)) continue;
      if (spaces.empty() || std::ranges::find(spaces, "") != spaces.end()) continue;  // local to the file
      std::string name;
      for (const std::string& space : spaces) name += space + "::";
      name += found[1];
      const auto [other, is_new] = place.emplace(name, file.path);
      if (!is_new && other->second != file.path)
        violations.push_back({file.path, i + 1, name + " is also defined in " + other->second});
    }
  }
  return violations;
}

}  // namespace tisserand::architecture
