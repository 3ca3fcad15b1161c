// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of the sources as they are written: where each begins and ends, and how many parameters it has.
#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <string_view>

#include "tests/architecture/rules.hpp"

namespace tisserand::architecture {
namespace {

constexpr std::size_t longest_function = 60;
constexpr int most_parameters = 5;
/// Functions with more parameters than that. Lower it when some have gone; it does not rise.
constexpr std::size_t most_with_many = 60;

/// Lists of fields and keys are as long as a file has keys.
bool is_list(std::string_view name) { return name.ends_with("_fields") || name.ends_with("_key_sets"); }

/// Longer functions that read better whole: command lines, an iteration, a table of names, a tangent.
constexpr std::array<std::string_view, 5> kept_whole{
    "mechanism/main.cpp command_line", "reducer/main.cpp main", "mechanism/radau/newton.cpp iterate",
    "formats/results/layout_file.cpp write_names",
    "mechanism/bodies/superelement/tangent/frame_stiffness.cpp add_frame_stiffness"};

/// The code as one text, its strings, characters and lines of the preprocessor emptied; lines stay where they are.
std::string plain_text(const SourceFile& file) {
  std::string text;
  std::string raw_end;  // of a raw string that goes on
  for (const std::string& line : file.code) {
    const bool preprocessor =
        raw_end.empty() && line.find_first_not_of(' ') != std::string::npos && line[line.find_first_not_of(' ')] == '#';
    char quote = 0;
    for (std::size_t i = 0; i < line.size() && !preprocessor; ++i) {
      const std::string_view rest = std::string_view(line).substr(i);
      if (!raw_end.empty()) {
        if (!rest.starts_with(raw_end)) continue;
        i += raw_end.size() - 1;
        raw_end.clear();
      } else if (quote != 0) {
        if (line[i] == '\\') ++i;
        if (rest.front() == quote) quote = 0;
      } else if (rest.starts_with("R\"") && rest.find('(') != std::string_view::npos) {
        raw_end = ")" + std::string(rest.substr(2, rest.find('(') - 2)) + "\"";
        i += rest.find('(');
      } else if (line[i] == '"' ||
                 (line[i] == '\'' && (i == 0 || !std::isalnum(static_cast<unsigned char>(line[i - 1]))))) {
        quote = line[i];
      } else {
        text += line[i];
      }
    }
    text += '\n';
  }
  return text;
}

/// The kind of block that a brace opens. The text before the brace tells it.
enum class Block { scope, function, other };

Block block_of(const std::string& before, bool in_scope) {
  static const std::regex names(R"(^\s*(inline )?(namespace|extern)\b)");
  static const std::regex types(R"(^\s*(template\s*<[^{}]*>\s*)?(class|struct|union|enum)\s[^()]*$)");
  if (std::regex_search(before, names) || std::regex_search(before, types)) return Block::scope;
  const std::size_t last = before.find_last_not_of(" \n");
  const bool value = last != std::string::npos && before[last] == '=';
  return in_scope && before.find('(') != std::string::npos && !value ? Block::function : Block::other;
}

struct Function {
  std::string name;
  std::size_t first = 0, lines = 0;
  int parameters = 0;
};

/// The parameters between the first parentheses after a name.
void read_head(const std::string& head, Function& function) {
  static const std::regex named(R"((\w+|operator\S+)\()");
  std::smatch match;
  if (!std::regex_search(head, match, named)) return;
  function.name = match[1];
  int depth = 0;
  bool empty = true;
  for (auto at = match.suffix().first; at != head.end() && (depth > 0 || *at != ')'); ++at) {
    if (std::string_view("(<[{").find(*at) != std::string_view::npos) ++depth;
    if (std::string_view(")>]}").find(*at) != std::string_view::npos) --depth;
    if (*at == ',' && depth == 0) ++function.parameters;
    empty = empty && std::isspace(static_cast<unsigned char>(*at));
  }
  if (!empty) ++function.parameters;
}

std::vector<Function> functions_of(const SourceFile& file) {
  struct Open {
    Block block;
    Function function;
  };
  std::vector<Open> open;
  std::vector<Function> found;
  std::string before;
  std::size_t line = 1, first = 1;  // of what is before the next brace
  for (const char c : plain_text(file)) {
    if (c == '{') {
      const bool in_scope = std::ranges::all_of(open, [](const Open& one) { return one.block == Block::scope; });
      Open next{block_of(before, in_scope), {"", first, 0, 0}};
      if (next.block == Block::function) read_head(before, next.function);
      open.push_back(std::move(next));
    } else if (c == '}' && !open.empty()) {
      Open& last = open.back();
      last.function.lines = line - last.function.first + 1;
      if (last.block == Block::function) found.push_back(last.function);
      open.pop_back();
    }
    if (c == '\n') ++line;
    if (c == '{' || c == '}' || c == ';') {
      before.clear();
    } else {
      if (before.find_first_not_of(" \n") == std::string::npos) first = line;
      before += c;
    }
  }
  return found;
}

}  // namespace

std::vector<Violation> check_functions(const SourceTree& tree) {
  static const std::regex numbered(R"(\bwork_\d)");
  std::vector<Violation> found, many;
  for (const SourceFile& file : tree.files) {
    if (!file.is_source() || file.path.starts_with("tests/")) continue;
    for (std::size_t i = 0; i < file.code.size(); ++i)
      if (std::regex_search(file.code[i], numbered))
        found.push_back({file.path, i + 1, "a name that says nothing: call it by what it holds"});
    for (const Function& one : functions_of(file)) {
      if (one.lines > longest_function && !is_list(one.name) &&
          std::ranges::count(kept_whole, file.path + " " + one.name) == 0)
        found.push_back({file.path, one.first,
                         one.name + ": " + std::to_string(one.lines) + " lines, " + std::to_string(longest_function) +
                             " are allowed"});
      if (one.parameters > most_parameters)
        many.push_back({file.path, one.first, one.name + ": " + std::to_string(one.parameters) + " parameters"});
    }
  }
  if (many.size() <= most_with_many) return found;
  found.push_back({"", 0,
                   std::to_string(many.size()) + " functions have more than " + std::to_string(most_parameters) +
                       " parameters, " + std::to_string(most_with_many) + " are allowed:"});
  found.insert(found.end(), many.begin(), many.end());
  return found;
}

}  // namespace tisserand::architecture
