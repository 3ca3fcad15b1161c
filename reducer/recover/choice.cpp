// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes, elements and groups chosen by words of the command line.
#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/recover/history_tables.hpp"
#include "reducer/recover/places.hpp"

namespace tisserand::reducer {
namespace {

using formats::Recovery;

int find_group(const Recovery& r, const std::string& name, const std::string& where) {
  const auto found = std::find(r.group_name.begin(), r.group_name.end(), name);
  if (found != r.group_name.end()) return static_cast<int>(found - r.group_name.begin());
  throw Error(
      fmt::format("has no group '{}'", printable_line(name, 60)), where,
      r.group_name.empty() ? "choose nodes with --point" : "give one of " + listed(nearest_names(name, r.group_name)));
}

/// Element of "12" or "group/12".
int find_element(const Recovery& r, const std::string& word, const std::string& where) {
  const std::size_t slash = word.rfind('/');
  const std::string digits = slash == std::string::npos ? word : word.substr(slash + 1);
  int number = 0;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (fault != std::errc() || end != digits.data() + digits.size())
    throw Error(fmt::format("'{}' is not the number of an element", printable_line(word, 60)), "--element",
                "give a number, such as 12, or group and number, such as skin/12");
  const int group = slash == std::string::npos ? -1 : find_group(r, word.substr(0, slash), where);
  std::vector<int> found;
  for (int e = 0; e < r.elements.count(); ++e)
    if (r.elements.id[e] == number && (group < 0 || r.elements.group[e] == group)) found.push_back(e);
  if (found.empty())
    throw Error(fmt::format("has no element '{}'", printable_line(word, 60)), where,
                "give its number in the deck, or its number within its group; the numbers of all elements are in the "
                "envelope that `reducer recover` writes without --element");
  if (found.size() == 1) return found[0];
  std::vector<std::string> names;
  for (const int e : found) names.push_back(element_text(r, e));
  throw Error(fmt::format("has {} elements that match '{}': {}", found.size(), word, listed(names)), where,
              group < 0 ? fmt::format("give the group and the number, such as --element {}/{}",
                                      r.group_name[r.elements.group[found[0]]], number)
                        : "choose nodes of these elements with --point");
}

}  // namespace

ChosenHistories chosen_histories(const Recovery& r, const BodyMotion& still, const RecoverRequest& request) {
  std::vector<ChosenItem> nodes, elements, groups;
  for (const std::string& word : request.points) nodes.push_back({word, find_node(r, word, request.recovery)});
  for (const std::string& word : request.elements) elements.push_back({word, find_element(r, word, request.recovery)});
  for (const std::string& word : request.groups) {
    const int group = find_group(r, word, request.recovery);
    const auto is_it = [group](const ChosenItem& item) { return item.index == group; };
    if (std::none_of(groups.begin(), groups.end(), is_it)) groups.push_back({word, group});
  }
  ChosenHistories chosen;
  const auto add = [&chosen](std::unique_ptr<HistoryTable> table, const char* ending) {
    chosen.tables.push_back(std::move(table));
    chosen.endings.emplace_back(ending);
  };
  if (!nodes.empty()) add(std::make_unique<NodeTable>(r, still, request.frame, std::move(nodes)), "points");
  if (!elements.empty()) add(std::make_unique<StressTable>(r, still, std::move(elements)), "elements");
  if (!groups.empty()) add(std::make_unique<GroupTable>(r, still, std::move(groups)), "groups");
  return chosen;
}

}  // namespace tisserand::reducer
