// Spelling of names and references with suggestions.
#include "formats/name_check.hpp"

#include <algorithm>

#include "common/text.hpp"

namespace tisserand::formats {

bool is_name(const std::string& text) {
  const auto letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; };
  const auto later = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '-'; };
  return !text.empty() && letter(text.front()) && std::ranges::all_of(text, later);
}

void check_name(const std::string& noun, const std::string& name, const std::string& where,
                std::vector<std::string>& seen, Faults& faults) {
  if (!is_name(name))
    faults.add(where, "", fmt::format("{} '{}': not a valid name", noun, name),
               "use letters, digits, _ and -, and begin with a letter or _");
  if (std::ranges::find(seen, name) != seen.end())
    faults.add(where, "", fmt::format("{} '{}': the name is used twice", noun, name), "rename one");
  seen.push_back(name);
}

void check_reference(const std::string& subject, const std::string& noun, const std::string& name,
                     const std::vector<std::string>& known, const std::string& where, const std::string& key,
                     Faults& faults) {
  if (std::ranges::find(known, name) != known.end()) return;
  const auto close = nearest(name, known);
  faults.add(where, key, fmt::format("{}: there is no {} '{}'", subject, noun, name),
             close           ? fmt::format("did you mean '{}'?", *close)
             : known.empty() ? fmt::format("define it; no {} is defined", noun)
                             : fmt::format("known are {}", join(known, ", ")));
}

}  // namespace tisserand::formats
