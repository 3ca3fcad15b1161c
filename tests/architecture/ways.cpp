// SPDX-License-Identifier: GPL-3.0-or-later
// Ways of values through the rooms, as the maps tell them.
#include <algorithm>
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/architecture/rules.hpp"

namespace tisserand::architecture {
namespace {

constexpr std::size_t most_rooms = 5;

/// The rooms of the links of a row, neighbours that are the same counted once.
std::vector<std::string> rooms_of(const std::string& row, const std::filesystem::path& page) {
  static const std::regex link(R"(\]\(([^)]+)\))");
  std::vector<std::string> rooms;
  for (std::sregex_iterator it(row.begin(), row.end(), link), end; it != end; ++it) {
    const std::filesystem::path target = (page.parent_path() / (*it)[1].str()).lexically_normal();
    const std::string room = target.parent_path().generic_string();
    if (rooms.empty() || rooms.back() != room) rooms.push_back(room);
  }
  return rooms;
}

}  // namespace

std::vector<Violation> check_ways(const SourceTree& tree) {
  std::vector<Violation> found;
  for (const SourceFile& file : tree.files) {
    if (!file.path.ends_with("MAP.md")) continue;
    bool inside = false;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      if (file.lines[i].starts_with("## ")) inside = file.lines[i] == "## Ways through the code";
      if (!inside || !file.lines[i].starts_with("| ")) continue;
      const std::vector<std::string> rooms = rooms_of(file.lines[i], file.path);
      if (rooms.size() > most_rooms)
        found.push_back(
            {file.path, i + 1,
             "a way through " + std::to_string(rooms.size()) + " rooms, at most " + std::to_string(most_rooms)});
      for (auto room = rooms.begin(); room != rooms.end(); ++room)
        if (std::find(rooms.begin(), room, *room) != room)
          found.push_back({file.path, i + 1, "a way that comes back to " + *room});
    }
  }
  return found;
}

}  // namespace tisserand::architecture
