// SPDX-License-Identifier: GPL-3.0-or-later
#include <regex>

#include "tests/architecture/rules.hpp"

namespace tisserand::architecture {
namespace {

constexpr std::ptrdiff_t most_words = 30;

/// The text of a paragraph or of an item of a list, and the line where it begins.
struct Paragraph {
  std::size_t line = 0;
  std::string text;
};

bool begins_with(const std::string& line, const std::regex& what) {
  return std::regex_search(line, what, std::regex_constants::match_continuous);
}

/// Paragraphs of a page without headings, tables, contents, blocks of code, displayed formulas and comments.
std::vector<Paragraph> paragraphs_of(const SourceFile& page) {
  static const std::regex item(R"(\s*([-*]|\d+\.) )"), outside(R"(\s*($|\||#|<!--|---))"), indented(R"(    +\S)");
  std::vector<Paragraph> paragraphs;
  bool is_code = false, is_formula = false, is_open = false;
  for (std::size_t i = 0; i < page.lines.size(); ++i) {
    const std::string& line = page.lines[i];
    const bool fence = line.find("```") != std::string::npos;
    if (fence) is_code = !is_code;
    const bool opens = line.find("$$") != std::string::npos, closes = opens && line.rfind("$$") != line.find("$$");
    if (opens && !closes) is_formula = !is_formula;
    if (is_code || fence || is_formula || opens || begins_with(line, outside) ||
        (!is_open && begins_with(line, indented) && !begins_with(line, item))) {
      is_open = false;
      continue;
    }
    if (!is_open || begins_with(line, item)) paragraphs.push_back({i + 1, ""});
    is_open = true;
    paragraphs.back().text += " " + line;
  }
  return paragraphs;
}

/// A link is its text; a picture is nothing; code and formulas count as one word.
std::string read_aloud(std::string text) {
  static const std::regex picture(R"(!\[[^\]]*\]\([^)]*\))"), link(R"(\[([^\]]*)\]\([^)]*\))");
  static const std::regex code(R"(`[^`]*`)"), formula(R"(\$[^$]*\$)");
  text = std::regex_replace(text, picture, "");
  text = std::regex_replace(text, link, "$1");
  text = std::regex_replace(text, code, "Code");
  return std::regex_replace(text, formula, "X");
}

std::ptrdiff_t words_of(const std::string& sentence) {
  static const std::regex word(R"(\S*[A-Za-z0-9]\S*)");
  return std::distance(std::sregex_iterator(sentence.begin(), sentence.end(), word), std::sregex_iterator());
}

}  // namespace

std::vector<Violation> check_sentences(const SourceTree& tree) {
  static const std::regex end(R"([.!?]["*)]*\s+(?=["(*\[]*[A-Z0-9]))");
  std::vector<Violation> violations;
  for (const SourceFile& page : tree.files) {
    if (!page.is_page()) continue;
    for (const Paragraph& paragraph : paragraphs_of(page)) {
      const std::string text = read_aloud(paragraph.text);
      if (text.find(" \xC2\xB7 ") != std::string::npos) continue;  // contents
      for (std::sregex_token_iterator sentence(text.begin(), text.end(), end, -1), none; sentence != none; ++sentence)
        if (const std::ptrdiff_t words = words_of(*sentence); words > most_words)
          violations.push_back({page.path, paragraph.line,
                                std::to_string(words) + " words in a sentence, at most " + std::to_string(most_words) +
                                    ": " + sentence->str().substr(0, 60)});
    }
  }
  return violations;
}

std::vector<Violation> check_docstrings(const SourceTree& tree) {
  static const std::regex riddle(R"(///<? *(Of|The same|As) )"), before(R"(^\s*///)");
  std::vector<Violation> violations;
  for (const SourceFile& file : tree.files) {
    if (!file.is_source()) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i)
      if (std::regex_search(file.lines[i], riddle) && (i == 0 || !std::regex_search(file.lines[i - 1], before)))
        violations.push_back({file.path, i + 1, "a docstring begins with a noun or a verb"});
  }
  return violations;
}

}  // namespace tisserand::architecture
