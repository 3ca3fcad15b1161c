// SPDX-License-Identifier: GPL-3.0-or-later
// The page of hard cases: one table per factor, the messages of failing cells, reasons and sources.
#include "tests/stability/page.hpp"

#include <algorithm>
#include <ctime>
#include <map>
#include <regex>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "common/text.hpp"

namespace tisserand::stability {
namespace {

constexpr const char* head = R"(# Hard cases

This page shows what `mechanism` does in hard cases: singular positions, redundant constraints, extreme ratios of mass and stiffness, long runs, contact and
buckling. `scripts/stability` runs all cases and writes this page (three minutes after its build). No cell of the tables is a silent wrong answer.

Contents: [How to read the tables](#how-to-read-the-tables) · {}[Messages](#messages) ·
[Cells that do not exist](#cells-that-do-not-exist) · [Sources of the expected values](#sources-of-the-expected-values)

## How to read the tables

Each table varies one factor and keeps the defaults of the others. A table with "x" in its heading varies two factors. A case is one scene with expected
values; a cell is one run.

| cell | meaning |
| --- | --- |
| a number | The case passes. The number is the largest error, divided by its tolerance. |
| reported | The case misses a criterion, and the run itself reports this by a [warning or an error](#messages). |
| **FAIL** | The result is wrong and the run does not report it, or the run crashes or does not end. |
| - | The cell [does not exist](#cells-that-do-not-exist). |

Levels of the factors:

- **Integrator**: `default` is `generalised_alpha` with `formulation: stabilised_index2`. `rho` is its spectral radius; `index 3` is `formulation: index3`.
  `controlled` is the default with error control and a tolerance of 1e-4; `radau` has a tolerance of 1e-6.
- **Solver**: `linear_solver` of the integrator.
- **Scaling**: units of length (L) and mass (M), relative to those of the case.
- **Formulation**: the description of the flexible bodies. A, B and M are the options of `inertia`.

Cases and criteria are in [tests/stability/catalogue.cpp](../tests/stability/catalogue.cpp), the scenes in the folder `scenes` beside it. `./check` runs
the fast cells and compares their states with [tests/stability/expected.csv](../tests/stability/expected.csv).

)";

std::string entry(const Outcome& outcome) {
  if (outcome.state == State::pass) return fmt::format("{:.1g}", outcome.worst);
  return outcome.state == State::fail ? fmt::format("**FAIL** {:.1g}", outcome.worst) : word(outcome.state);
}

std::string capitalised(const std::string& factor) {
  return static_cast<char>(std::toupper(factor[0])) + factor.substr(1);
}

/// Row and column of a cell. A level of two factors has the first in the row: "A, rho 0" of a pendulum is column "rho
/// 0" of row "pendulum, A".
std::pair<std::string, std::string> place_of(const Cell& cell) {
  const std::size_t comma = cell.level.find(", ");
  if (!cell.factor.starts_with("formulation x") || comma == std::string::npos) return {cell.of->name, cell.level};
  return {cell.of->name + ", " + cell.level.substr(0, comma), cell.level.substr(comma + 2)};
}

void add_new(std::vector<std::string>& list, const std::string& name) {
  if (std::ranges::count(list, name) == 0) list.push_back(name);
}

using Row = std::pair<std::string, std::vector<std::string>>;  ///< name, then entries

std::string table(const std::vector<std::string>& columns, const std::vector<Row>& rows) {
  std::string text = fmt::format("| case | {} |\n| --- |", join(columns, " | "));
  for (std::size_t i = 0; i < columns.size(); ++i) text += " --- |";
  text += '\n';
  for (const auto& [name, entries] : rows) text += fmt::format("| {} | {} |\n", name, join(entries, " | "));
  return text + '\n';
}

/// One table for all rows that have the same columns. Rows without any cell that exists are left out.
std::string tables(const std::string& factor, const std::vector<const Judged*>& cells) {
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::string>> columns;
  std::map<std::string, std::vector<std::string>> entries;
  std::map<std::string, bool> exists;
  for (const Judged* one : cells) {
    const auto [row, column] = place_of(one->cell);
    add_new(names, row);
    columns[row].push_back(column);
    entries[row].push_back(entry(one->outcome));
    exists[row] = exists[row] || one->outcome.state != State::impossible;
  }
  std::vector<std::vector<std::string>> heads;
  std::map<std::vector<std::string>, std::vector<Row>> rows;
  for (const std::string& name : names) {
    if (!exists[name]) continue;
    if (std::ranges::count(heads, columns[name]) == 0) heads.push_back(columns[name]);
    rows[columns[name]].emplace_back(name, entries[name]);
  }
  std::string text = fmt::format("## {}\n\n", capitalised(factor));
  for (const std::vector<std::string>& one : heads) text += table(one, rows[one]);
  return text;
}

std::string counts(const std::vector<Judged>& judged) {
  std::map<State, int> count;
  double seconds = 0.0;
  for (const Judged& one : judged) {
    ++count[one.outcome.state];
    seconds += one.outcome.seconds;
  }
  return fmt::format("{:%F}, {} cells: {} pass, {} are reported, {} fail. Processor time: {:.0f} s.\n\n",
                     fmt::gmtime(std::time(nullptr)), judged.size() - count[State::impossible], count[State::pass],
                     count[State::reported], count[State::fail], seconds);
}

/// The first of the warnings, or the error, without the name of the program.
std::string first_message(const std::string& said) {
  std::string text = said.empty() ? "nothing" : said.substr(0, said.find("; "));
  while (text.ends_with(' ')) text.pop_back();
  return text.starts_with("mechanism: ") ? text.substr(11) : text;
}

/// Messages of one kind have the same kind, whatever their numbers and names are.
std::string kind_of(const std::string& message) {
  constexpr std::size_t enough = 50;  // letters; names without quotation marks stand behind them
  const std::string nameless = std::regex_replace(message, std::regex("'[^']*'"), "'");
  return std::regex_replace(nameless, std::regex("[0-9][0-9.e+-]*"), "#").substr(0, enough);
}

std::string in_a_cell(std::string text) {
  std::ranges::replace(text, '|', '/');
  return text;
}

/// Lines "key | names" in order of the first appearance; a name that stands n times gets " (n)" if it is to be counted.
class Lists {
 public:
  void add(const std::string& key, const std::string& shown, const std::string& name) {
    if (!lines_.contains(key)) order_.push_back(key);
    Line& line = lines_[key];
    if (line.shown.empty()) line.shown = shown;
    add_new(line.names, name);
    ++line.count[name];
  }
  std::string text(bool counted, const std::string& separator) const {
    std::string result;
    for (const std::string& key : order_) {
      const Line& line = lines_.at(key);
      std::vector<std::string> names;
      for (const std::string& name : line.names)
        names.push_back(counted && line.count.at(name) > 1 ? fmt::format("{} ({})", name, line.count.at(name)) : name);
      result += fmt::format("| {} | {} |\n", in_a_cell(line.shown), in_a_cell(join(names, separator)));
    }
    return result;
  }

 private:
  struct Line {
    std::string shown;
    std::vector<std::string> names;
    std::map<std::string, int> count;
  };
  std::vector<std::string> order_;
  std::map<std::string, Line> lines_;
};

std::string messages(const std::vector<Judged>& judged, State state) {
  Lists lists;
  for (const Judged& one : judged)
    if (one.outcome.state == state) {
      const std::string message = first_message(one.outcome.said);
      lists.add(kind_of(message), message, one.cell.of->name);
    }
  return lists.text(true, "; ");
}

std::string reasons(const std::vector<Judged>& judged) {
  Lists lists;
  for (const Judged& one : judged)
    if (one.outcome.state == State::impossible)
      lists.add(one.outcome.said, one.outcome.said, fmt::format("{}: {}", one.cell.factor, place_of(one.cell).second));
  return lists.text(false, "; ");
}

std::string sources(const std::vector<Case>& cases) {
  Lists lists;
  for (const Case& one : cases) lists.add(one.source, one.source, one.name);
  return lists.text(false, "; ");
}

}  // namespace

std::string page_of(const std::vector<Case>& cases, const std::vector<Judged>& judged) {
  std::vector<std::string> factors;
  for (const Judged& one : judged) add_new(factors, one.cell.factor);
  std::string links, body;
  int linked = 0;
  for (const std::string& factor : factors) {
    std::string anchor = factor;
    std::ranges::replace(anchor, ' ', '-');
    links += fmt::format("[{}](#{}) ·{}", capitalised(factor), anchor, ++linked == 3 ? '\n' : ' ');
    std::vector<const Judged*> cells;
    for (const Judged& one : judged)
      if (one.cell.factor == factor) cells.push_back(&one);
    body += tables(factor, cells);
  }
  std::string page = fmt::format(fmt::runtime(head), links) + counts(judged) + body;
  page +=
      "## Messages\n\nThis table has the first message of each reported run. If messages differ only in numbers and "
      "names, "
      "the first of them stands for all.\nA number in brackets is the number of cells.\n\n"
      "| message | cases |\n| --- | --- |\n" +
      messages(judged, State::reported) + '\n';
  if (const std::string failed = messages(judged, State::fail); !failed.empty())
    page += "## Failures\n\n| message | cases |\n| --- | --- |\n" + failed + '\n';
  page += "## Cells that do not exist\n\n| reason | factor: levels |\n| --- | --- |\n" + reasons(judged) + '\n';
  page += "## Sources of the expected values\n\n| source | cases |\n| --- | --- |\n" + sources(cases);
  page +=
      "\nThe tests `Rewritings` and `FarScene` check that a scene gives the same motion in other units, far from the "
      "origin or with bodies cut into parts.\n";
  return page;
}

}  // namespace tisserand::stability
