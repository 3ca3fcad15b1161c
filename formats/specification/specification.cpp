// SPDX-License-Identifier: GPL-3.0-or-later
// Generates the tables of the pages.
#include "formats/specification/specification.hpp"

#include <algorithm>
#include <cctype>
#include <regex>

#include "common/error.hpp"
#include "formats/part/fields.hpp"
#include "formats/scene/fields.hpp"
#include "formats/study/study.hpp"

namespace tisserand::formats {

std::string FileKind::page_file() const {
  std::string upper = name;
  std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return "formats/" + upper + ".md";
}

std::vector<FileKind> file_kinds() {
  return {{"part", part_key_sets(), part_types(), false},
          {"scene", scene_key_sets(), scene_types(), true},
          {"study", study_key_sets(), study_types(), false}};
}

std::string field_table(const std::vector<KeySet>& sets, const std::string& table) {
  const auto belongs = [&](const Field& field) { return field.table == table && !field.meaning.empty(); };
  const auto set =
      std::ranges::find_if(sets, [&](const KeySet& one) { return std::ranges::any_of(one.fields, belongs); });
  if (set == sets.end()) return "";
  std::string text = "| key | meaning | default |\n| --- | --- | --- |\n";
  std::string keys;
  for (std::size_t i = 0; i < set->fields.size(); ++i) {
    const Field& field = set->fields[i];
    if (!belongs(field)) continue;
    keys += fmt::format("{}`{}`", keys.empty() ? "" : ", ", field.key);
    if (i + 1 < set->fields.size() && set->fields[i + 1].same_row) continue;
    const std::string without = field.default_text();
    text += fmt::format("| {} | {} |{}{} |\n", keys, field.meaning, without.empty() ? "" : " ", without);
    keys.clear();
  }
  return text;
}

bool names_kind(const Field& field) {
  return field.type.starts_with("'") && field.type.find('\'', 1) == field.type.size() - 1;
}

std::string kind_table(const std::vector<KeySet>& sets, const std::string& key) {
  std::string rows;
  for (const KeySet& set : sets)
    for (const Field& field : set.fields)
      if (field.key == key && names_kind(field) && !field.meaning.empty())
        rows += fmt::format("| `{}` | {} |\n", field.type.substr(1, field.type.size() - 2), field.meaning);
  return rows.empty() ? "" : fmt::format("| `{}` | meaning |\n| --- | --- |\n{}", key, rows);
}

std::string with_field_tables(const std::string& page, const std::string& file, const std::vector<KeySet>& sets) {
  static const std::regex mark("<!-- (fields|kinds): (\\w+) -->\n");
  const std::string end = "<!-- end -->\n";
  std::string result;
  std::size_t at = 0;
  std::smatch found;
  for (auto from = page.begin(); std::regex_search(from, page.end(), found, mark); from = page.begin() + at) {
    const std::size_t head = static_cast<std::size_t>(found[0].second - page.begin()), tail = page.find(end, head);
    if (tail == std::string::npos)
      throw Error("a mark of a table of fields has no end", file, "write <!-- end --> behind the table");
    const std::string table = found[1] == "fields" ? field_table(sets, found[2]) : kind_table(sets, found[2]);
    if (table.empty()) throw Error(fmt::format("no list of fields has a table '{}'", found[2].str()), file, "");
    result += page.substr(at, head - at) + table + end;
    at = tail + end.size();
  }
  return result + page.substr(at);
}

}  // namespace tisserand::formats
