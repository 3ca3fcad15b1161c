// SPDX-License-Identifier: GPL-3.0-or-later
// Writes problems and laws as tables in markdown, with errors and measured orders of convergence.
#include "tests/tables/page.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

namespace tisserand::tables {
namespace {

constexpr double round_off = 1e-10;  ///< relative: differences below it have no order

/// Lines of at most 155 letters.
std::string wrapped(const std::string& text) {
  constexpr std::size_t widest = 155;
  std::string result;
  std::size_t length = 0;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool fits = length + 1 + word.size() <= widest;
    if (length > 0) result += fits ? ' ' : '\n';
    length = (length > 0 && fits ? length + 1 : 0) + word.size();
    result += word;
  }
  return result;
}

}  // namespace

std::string measured_order(const Row& row) {
  const std::size_t n = row.ours.size();
  if (n < (row.kind == Target::exact ? 2u : 3u)) return "";
  const double reference = row.kind == Target::exact ? row.target : 0.0;
  const double coarse = row.kind == Target::exact ? row.ours[n - 2] - reference : row.ours[n - 3] - row.ours[n - 2];
  const double fine = row.kind == Target::exact ? row.ours[n - 1] - reference : row.ours[n - 2] - row.ours[n - 1];
  if (std::abs(fine) < round_off * std::abs(row.ours.back()) || coarse / fine < 1.0) return "";
  return fmt::format("{:.1f}", std::log2(coarse / fine));
}

std::string to_markdown(const Problem& problem) {
  const bool has_elements =
      std::ranges::any_of(problem.rows, [&](const Row& row) { return row.element != problem.rows.front().element; });
  const bool has_orders =
      std::ranges::any_of(problem.rows, [](const Row& row) { return !measured_order(row).empty(); });
  std::string text = fmt::format("### {}\n{}\n\n| quantity |{} target |", problem.title, wrapped(problem.source),
                                 has_elements ? " element |" : "");
  std::string line = has_elements ? "| --- | --- | --: |" : "| --- | --: |";
  for (const std::string& mesh : problem.meshes) {
    text += fmt::format(" {} |", mesh);
    line += " --: |";
  }
  text += fmt::format(" error % |{}\n{} --: |{}\n", has_orders ? " order |" : "", line, has_orders ? " --: |" : "");
  for (const Row& row : problem.rows) {
    text += fmt::format("| {} |", row.quantity);
    if (has_elements) text += fmt::format(" {} |", row.element);
    text += fmt::format(" {:.5g} |", row.target);
    for (const double value : row.ours) text += fmt::format(" {:.5g} |", value);
    text += fmt::format(" {:+.2g} |", 100.0 * (row.ours.back() / row.target - 1.0));
    if (has_orders) text += fmt::format(" {} |", measured_order(row));
    text += '\n';
  }
  if (!problem.remark.empty()) text += "\n" + wrapped(problem.remark) + "\n";
  return text + "\n";
}

std::string to_markdown(const Laws& laws) {
  std::string text = fmt::format("### {}\n{}\n\n| property | example | measured | limit | holds |\n", laws.title,
                                 wrapped(laws.source));
  text += "| --- | --- | --: | --: | --- |\n";
  for (const Law& law : laws.laws)
    text += fmt::format("| {} | {} | {:.2g} | {:.2g} | {} |\n", law.property, law.example, law.measured, law.limit,
                        law.measured <= law.limit ? "yes" : "**no**");
  return text + "\n";
}

}  // namespace tisserand::tables
