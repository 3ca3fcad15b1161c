// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of the formulas of docs/THEORY.md: those that the page has, that the code cites, and that the tests evaluate.
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/rules.hpp"

namespace tisserand::architecture {
namespace {

constexpr const char* page_path = "docs/THEORY.md";
/// The heading behind the last section whose formulas tests of the mechanism evaluate.
constexpr const char* first_of_reduction = "## 12. ";

/// What the page has.
struct Formulas {
  int count = 0;            ///< numbered 1 to count
  std::vector<int> motion;  ///< of the sections that tests evaluate
};

Formulas read_formulas(const SourceFile& page, std::vector<Violation>& found) {
  static const std::regex tag(R"(\\tag\{(\d+)\})");
  Formulas formulas;
  bool of_motion = true;
  for (std::size_t i = 0; i < page.lines.size(); ++i) {
    const std::string& line = page.lines[i];
    if (line.starts_with(first_of_reduction)) of_motion = false;
    for (std::sregex_iterator it(line.begin(), line.end(), tag), end; it != end; ++it) {
      const int number = std::stoi((*it)[1]);
      if (number != formulas.count + 1)
        found.push_back({page.path, i + 1,
                         "formula " + std::to_string(number) + " follows formula " + std::to_string(formulas.count)});
      formulas.count = number;
      if (of_motion) formulas.motion.push_back(number);
    }
  }
  return formulas;
}

/// The numbers of "(1)", "(1), (2)", and "(1) to (3)" in a text.
std::set<int> numbers_of(const std::string& text) {
  static const std::regex number(R"(\((\d+)\)( to \((\d+)\))?)");
  std::set<int> numbers;
  for (std::sregex_iterator it(text.begin(), text.end(), number), end; it != end; ++it) {
    const int first = std::stoi((*it)[1]), last = (*it)[3].matched ? std::stoi((*it)[3]) : first;
    for (int n = first; n <= last; ++n) numbers.insert(n);
  }
  return numbers;
}

/// Whether the file evaluates the theory: tests/mechanism/<room>/theory_*test.cpp.
bool is_theory_test(const SourceFile& file) {
  return file.path.starts_with("tests/mechanism/") && file.path.find("/theory_") != std::string::npos;
}

}  // namespace

std::vector<Violation> check_formulas(const SourceTree& tree) {
  static const std::regex citation(R"(THEORY ((\(\d+\)(, | to | and )?)+))");
  std::vector<Violation> found;
  Formulas formulas;
  for (const SourceFile& file : tree.files)
    if (file.path == page_path) formulas = read_formulas(file, found);
  std::set<int> evaluated;
  for (const SourceFile& file : tree.files) {
    if (!file.is_source()) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const std::string& line = file.lines[i];
      for (std::sregex_iterator it(line.begin(), line.end(), citation), end; it != end; ++it)
        for (const int n : numbers_of((*it)[1]))
          if (n < 1 || n > formulas.count)
            found.push_back({file.path, i + 1,
                             "cites THEORY (" + std::to_string(n) + "), but " + page_path + " has " +
                                 std::to_string(formulas.count) + " formulas"});
      if (const auto comment = line.find("//"); comment != std::string::npos && is_theory_test(file))
        evaluated.merge(numbers_of(line.substr(comment)));
    }
  }
  for (const int n : formulas.motion)
    if (!evaluated.contains(n))
      found.push_back({page_path, 0, "formula " + std::to_string(n) + " is in no tests/mechanism/*/theory_*test.cpp"});
  return found;
}

}  // namespace tisserand::architecture
