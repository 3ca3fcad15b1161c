// Formats problems and laws as tables in markdown, with errors and measured orders of convergence.
#include "tests/tables/page.hpp"

#include <cmath>

#include <fmt/format.h>

namespace tisserand::tables {
namespace {

constexpr double round_off = 1e-10;  ///< relative: differences below it have no order

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
  std::string text = fmt::format("### {}\n{}\n\n| quantity | element | target |", problem.title, problem.source);
  std::string line = "| --- | --- | --: |";
  for (const std::string& mesh : problem.meshes) {
    text += fmt::format(" {} |", mesh);
    line += " --: |";
  }
  text += fmt::format(" error % | order |\n{} --: | --: |\n", line);
  for (const Row& row : problem.rows) {
    text += fmt::format("| {} | {} | {:.5g} |", row.quantity, row.element, row.target);
    for (const double value : row.ours) text += fmt::format(" {:.5g} |", value);
    text += fmt::format(" {:+.2g} | {} |\n", 100.0 * (row.ours.back() / row.target - 1.0), measured_order(row));
  }
  if (!problem.remark.empty()) text += "\n" + problem.remark + "\n";
  return text + "\n";
}

std::string to_markdown(const Laws& laws) {
  std::string text =
      fmt::format("### {}\n{}\n\n| property | example | measured | at most | holds |\n", laws.title, laws.source);
  text += "| --- | --- | --: | --: | --- |\n";
  for (const Law& law : laws.laws)
    text += fmt::format("| {} | {} | {:.2g} | {:.2g} | {} |\n", law.property, law.example, law.measured, law.limit,
                        law.measured <= law.limit ? "yes" : "**no**");
  return text + "\n";
}

}  // namespace tisserand::tables
