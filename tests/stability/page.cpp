// Tables by factor, what was told, and what a case is.
#include "tests/stability/page.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "common/text.hpp"

namespace tisserand::stability {
namespace {

constexpr const char* head = R"(# Hard cases

`scripts/stability` computes this page anew: every case with every formulation, integrator, solver and scaling against the default of
the others, and the pairs named below. **pass**: the criteria hold; the number is the largest error over its tolerance. **told**: they do not,
and the run said so itself, in its doubts or with the error that it ended with. **FAIL**: a silent wrong answer, no number, a crash or no
end. `-`: there is no such cell, with the reason beneath. Cases and criteria are in
[tests/stability/catalogue.cpp](../tests/stability/catalogue.cpp), scenes beside it; quick cells run in `./check` and are held to the states in
[tests/stability/expected.csv](../tests/stability/expected.csv).

)";

std::string entry(const Outcome& outcome) {
  if (outcome.state == State::pass) return fmt::format("pass {:.1g}", outcome.worst);
  return outcome.state == State::fail ? fmt::format("**FAIL** {:.1g}", outcome.worst) : word(outcome.state);
}

/// Row and column of a cell: levels of two factors have the first in the row, "A, rho 0" of a pendulum in "pendulum,
/// A".
std::pair<std::string, std::string> place_of(const Cell& cell) {
  const std::size_t comma = cell.level.find(", ");
  if (!cell.factor.starts_with("formulation x") || comma == std::string::npos) return {cell.of->name, cell.level};
  return {cell.of->name + ", " + cell.level.substr(0, comma), cell.level.substr(comma + 2)};
}

void add_new(std::vector<std::string>& list, const std::string& name) {
  if (std::ranges::count(list, name) == 0) list.push_back(name);
}

std::string table(const std::string& factor, const std::vector<const Judged*>& cells) {
  std::vector<std::string> rows, columns;
  std::map<std::pair<std::string, std::string>, std::string> entries;
  for (const Judged* one : cells) {
    const auto [row, column] = place_of(one->cell);
    add_new(columns, column);
    if (one->outcome.state != State::impossible) add_new(rows, row);
    entries[{row, column}] = entry(one->outcome);
  }
  std::string text = fmt::format("## {}{}\n\n| case | {} |\n| --- |", static_cast<char>(std::toupper(factor[0])),
                                 factor.substr(1), join(columns, " | "));
  for (std::size_t i = 0; i < columns.size(); ++i) text += " --- |";
  text += '\n';
  for (const std::string& row : rows) {
    text += fmt::format("| {} |", row);
    for (const std::string& column : columns) text += fmt::format(" {} |", entries[{row, column}]);
    text += '\n';
  }
  return text + '\n';
}

std::string counts(const std::vector<Judged>& judged) {
  std::map<State, int> count;
  double seconds = 0.0;
  for (const Judged& one : judged) {
    ++count[one.outcome.state];
    seconds += one.outcome.seconds;
  }
  return fmt::format("{} cells: {} pass, {} told, {} fail; {} cannot exist. {:.0f} s of processor time.\n\n",
                     judged.size() - count[State::impossible], count[State::pass], count[State::told],
                     count[State::fail], count[State::impossible], seconds);
}

std::string said(const std::vector<Judged>& judged, State state) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<std::string>> cells;
  for (const Judged& one : judged) {
    if (one.outcome.state != state) continue;
    const std::string text = one.outcome.said.empty() ? "nothing" : one.outcome.said;
    if (!cells.contains(text)) order.push_back(text);
    cells[text].push_back(state == State::impossible ? one.cell.factor + ", " + one.cell.level : one.cell.id());
  }
  std::string result;
  for (const std::string& text : order) {
    std::vector<std::string>& ids = cells[text];
    std::ranges::sort(ids);
    ids.erase(std::ranges::unique(ids).begin(), ids.end());
    std::string clean = text;
    std::ranges::replace(clean, '|', '/');
    std::string names = listed(ids, "; ");
    std::ranges::replace(names, '|', '/');
    result += fmt::format("| {} | {} |\n", names, clean);
  }
  return result;
}

}  // namespace

std::string page_of(const std::vector<Case>& cases, const std::vector<Judged>& judged) {
  std::string page = head + counts(judged);
  std::vector<std::string> factors;
  for (const Judged& one : judged)
    if (std::ranges::count(factors, one.cell.factor) == 0) factors.push_back(one.cell.factor);
  for (const std::string& factor : factors) {
    std::vector<const Judged*> cells;
    for (const Judged& one : judged)
      if (one.cell.factor == factor) cells.push_back(&one);
    page += table(factor, cells);
  }
  page += "## What was told\n\n| cells | words of the run |\n| --- | --- |\n" + said(judged, State::told) + '\n';
  if (const std::string failed = said(judged, State::fail); !failed.empty())
    page += "## What failed\n\n| cells | words of the run |\n| --- | --- |\n" + failed + '\n';
  page += "## What cannot exist\n\n| factor | reason |\n| --- | --- |\n" + said(judged, State::impossible) + '\n';
  page += "## Where expected values come from\n\n| case | source |\n| --- | --- |\n";
  for (const Case& one : cases) page += fmt::format("| {} | {} |\n", one.name, one.source);
  page +=
      "\nBodies described in other units, far from the origin or in parts move alike: tests `Rewritings` and "
      "`FarScene`.\n";
  return page;
}

}  // namespace tisserand::stability
