// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of settings, observed orders, Pareto fronts.
#include "mechanism/study/findings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "common/math/count.hpp"

namespace tisserand::mechanism {
namespace {

int axis_of_lines(const formats::Study& study, int series) {
  const std::vector<formats::StudyAxis>& axes = study.series[series].axes;
  const auto found = std::ranges::find(axes, study.along, &formats::StudyAxis::name);
  return found == axes.end() ? count_of(axes) - 1 : static_cast<int>(found - axes.begin());
}

}  // namespace

double StudyRow::worst_error(const std::vector<int>& quantities) const {
  double worst = 0.0;
  for (const int q : quantities) worst = std::max(worst, errors[q]);
  return worst;
}

std::vector<StudyRow> rows_of(const formats::Study& study, const StudyCells& plan, const Journal& journal) {
  std::vector<StudyRow> rows;
  for (const Cell& cell : plan.cells) {
    StudyRow row;
    row.cell = &cell;
    row.is_reference = !plan.references.empty() && plan.references.front().key == cell.key;
    const std::vector<RunRecord>& runs = journal.runs(cell.key);
    row.has_run = !runs.empty();
    if (row.has_run) {
      const RunRecord& last = runs.back();
      row.outcome = last.outcome;
      row.message = last.message;
      row.coordinates = last.coordinates;
      row.steps = last.steps;
      row.iterations = last.iterations;
      if (last.outcome == CellOutcome::completed) row.errors = last.errors;
      std::vector<double> seconds;
      for (const RunRecord& run : runs)
        if (run.outcome == last.outcome) seconds.push_back(run.cpu_seconds);
      row.repeats = count_of(seconds);
      row.time = median_of(std::move(seconds));
    }
    rows.push_back(std::move(row));
  }
  for (const StudyLine& line : lines_of(study, rows))
    for (int q = 0; q < std::ssize(study.quantities); ++q) {
      const std::vector<std::optional<double>> orders = observed_orders(rows, line, q);
      for (std::size_t k = 0; k < orders.size(); ++k) rows[line.rows[k]].orders.push_back(orders[k]);
    }
  return rows;
}

std::vector<StudyLine> lines_along(const formats::Study& study, const std::vector<StudyRow>& rows, int series,
                                   int axis) {
  std::map<std::vector<int>, StudyLine> lines;
  for (int i = 0; i < std::ssize(rows); ++i) {
    const Cell& cell = *rows[i].cell;
    if (cell.series != series) continue;
    std::vector<int> common = cell.index;
    if (axis >= 0) common[axis] = -1;
    StudyLine& line = lines[common];
    if (line.rows.empty()) {
      line.series = series;
      line.axis = axis;
      std::string text;
      for (int k = 0; k < std::ssize(cell.values); ++k)
        if (k != axis)
          text +=
              fmt::format("{} {} = {}", text.empty() ? ":" : ",", study.series[series].axes[k].name, cell.values[k]);
      line.label = study.series[series].name + text;
    }
    line.rows.push_back(i);
  }
  std::vector<StudyLine> list;
  for (auto& [common, line] : lines) list.push_back(std::move(line));
  return list;
}

std::vector<StudyLine> lines_of(const formats::Study& study, const std::vector<StudyRow>& rows) {
  std::vector<StudyLine> lines;
  for (int series = 0; series < std::ssize(study.series); ++series)
    for (StudyLine& line : lines_along(study, rows, series, axis_of_lines(study, series)))
      lines.push_back(std::move(line));
  return lines;
}

std::optional<std::size_t> plateau(const std::vector<StudyRow>& rows, const StudyLine& line, int quantity) {
  constexpr double same = 0.05;
  if (line.rows.size() < 2 || !rows[line.rows.back()].is_measured()) return {};
  const double end = rows[line.rows.back()].errors[quantity];
  std::size_t from = line.rows.size() - 1;
  while (from > 0) {
    const StudyRow& row = rows[line.rows[from - 1]];
    if (!row.is_measured() || !(std::abs(row.errors[quantity] - end) <= same * end)) break;
    --from;
  }
  if (from + 1 == line.rows.size()) return {};
  return from;
}

std::optional<double> number_of(const std::string& value) {
  double number = 0.0;
  const auto [rest, code] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (code != std::errc() || rest != value.data() + value.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::vector<std::optional<double>> observed_orders(const std::vector<StudyRow>& rows, const StudyLine& line,
                                                   int quantity) {
  std::vector<std::optional<double>> orders(line.rows.size());
  for (std::size_t k = 1; line.axis >= 0 && k < line.rows.size(); ++k) {
    const StudyRow &coarse = rows[line.rows[k - 1]], &fine = rows[line.rows[k]];
    if (!coarse.is_measured() || !fine.is_measured()) continue;
    const auto h_coarse = number_of(coarse.cell->values[line.axis]), h_fine = number_of(fine.cell->values[line.axis]);
    if (!h_coarse || !h_fine || !(*h_coarse > 0.0) || !(*h_fine > 0.0) || *h_coarse == *h_fine) continue;
    const double ratio = coarse.errors[quantity] / fine.errors[quantity];
    if (ratio > 0.0 && std::isfinite(ratio)) orders[k] = std::log(ratio) / std::abs(std::log(*h_coarse / *h_fine));
  }
  return orders;
}

std::vector<int> pareto_front(const std::vector<StudyRow>& rows, int quantity) {
  std::vector<int> order;
  for (int i = 0; i < std::ssize(rows); ++i)
    if (rows[i].is_measured()) order.push_back(i);
  std::ranges::sort(order, [&](int a, int b) {
    const auto key = [&](int i) { return std::pair(rows[i].time.median, rows[i].errors[quantity]); };
    return key(a) < key(b);
  });
  std::vector<int> front;
  double least = std::numeric_limits<double>::infinity();
  for (const int i : order) {
    if (!(rows[i].errors[quantity] < least)) continue;
    least = rows[i].errors[quantity];
    front.push_back(i);
  }
  return front;
}

int cheapest(const std::vector<StudyRow>& rows, const std::vector<StudyLine>& lines, const std::vector<int>& quantities,
             double tolerance) {
  int best = -1;
  for (const StudyLine& line : lines) {
    // From the finest setting on, as long as all measured errors are within the tolerance.
    for (auto row = line.rows.rbegin(); row != line.rows.rend(); ++row) {
      if (!rows[*row].is_measured()) continue;
      if (rows[*row].worst_error(quantities) > tolerance) break;
      if (best < 0 || rows[*row].time.median < rows[best].time.median) best = *row;
    }
  }
  return best;
}

}  // namespace tisserand::mechanism
