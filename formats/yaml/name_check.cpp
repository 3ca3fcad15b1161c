// SPDX-License-Identifier: GPL-3.0-or-later
// Checks spelling of names and references, with suggestions.
#include "formats/yaml/name_check.hpp"

#include <algorithm>

#include "common/text.hpp"

namespace tisserand::formats {

bool is_name(const std::string& text) {
  const auto letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; };
  const auto later = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '-'; };
  return !text.empty() && letter(text.front()) && std::ranges::all_of(text, later);
}

namespace {

/// Whether the text is a name, perhaps with the number of a copy: "link[3]".
bool is_instance_name(const std::string& text) {
  const std::size_t open = text.find('[');
  if (open == std::string::npos) return is_name(text);
  const std::string index = text.substr(open + 1, text.size() - open - 2);
  const bool digits = !index.empty() && std::ranges::all_of(index, [](char c) { return c >= '0' && c <= '9'; });
  return digits && text.back() == ']' && is_name(text.substr(0, open));
}

bool is_path_name(const std::string& text) {
  std::size_t begin = 0;
  for (std::size_t slash = text.find('/'); slash != std::string::npos; slash = text.find('/', begin)) {
    if (!is_instance_name(text.substr(begin, slash - begin))) return false;
    begin = slash + 1;
  }
  return is_name(text.substr(begin));
}

void report_bad_name(const Subject& subject) {
  subject.add("", "not a valid name", "use letters, digits, _ and -, and begin with a letter or _");
}

}  // namespace

void check_name(const Subject& subject, const std::string& name, std::vector<std::string>& seen) {
  if (!is_name(name)) report_bad_name(subject);
  if (std::ranges::find(seen, name) != seen.end()) subject.add("", "the name is used twice", "rename one");
  seen.push_back(name);
}

void check_path_name(const Subject& subject, const std::string& name, std::unordered_set<std::string>& seen) {
  if (!is_path_name(name)) report_bad_name(subject);
  if (!seen.insert(name).second) subject.add("", "the name is used twice", "rename one");
}

void check_reference(const Subject& subject, const std::string& key, const std::string& noun, const std::string& name,
                     const std::vector<std::string>& known) {
  if (std::ranges::find(known, name) != known.end()) return;
  subject.add(key, fmt::format("there is no {} '{}'", noun, name),
              did_you_mean(name, known,
                           known.empty() ? fmt::format("define it; no {} is defined", noun)
                                         : fmt::format("use one of {}", listed(known))));
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known, const std::string& otherwise) {
  const auto close = nearest(word, known);
  return close ? fmt::format("did you mean '{}'?", *close) : otherwise;
}

}  // namespace tisserand::formats
