// SPDX-License-Identifier: GPL-3.0-or-later
// Series for the plotter, and HTML around its pictures.
#include "mechanism/study/page.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string_view>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "common/program/version.hpp"
#include "common/text.hpp"
#include "mechanism/histories/plot.hpp"

namespace tisserand::mechanism {
namespace {

constexpr std::size_t most_lines = 7;  // the plotter has as many colours

constexpr const char* page_head = R"html(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1">
<style>
:root{color-scheme:light dark}
body{font:16px/1.5 system-ui,sans-serif;max-width:70em;margin:2em auto;padding:0 1em;color:#222;background:#fff}
svg{display:block;width:100%;max-width:760px;height:auto}.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:14px}
td,th{padding:.15em .7em;text-align:right;border-bottom:1px solid #ddd}td:first-child,th:first-child{text-align:left}
.failed{color:#b00}
@media (prefers-color-scheme:dark){
body{color:#e6e6e6;background:#14171c}td,th{border-color:#3a3f47}.failed{color:#ff8a80}
svg{filter:invert(1) hue-rotate(180deg)}
}
</style>
)html";

std::string escaped(const std::string& text) {
  static const std::map<char, const char*> entities{{'<', "&lt;"}, {'>', "&gt;"}, {'&', "&amp;"}, {'"', "&quot;"}};
  std::string result;
  for (const char c : printable(text))
    if (const auto entity = entities.find(c); entity != entities.end())
      result += entity->second;
    else
      result += c;
  return result;
}

Series named(const std::string& label, SeriesKind kind) {
  Series series;
  series.kind = kind;
  series.source = printable_line(label, 80);
  series.channel = "error";
  series.x_name = "CPU time";
  series.has_own_label = true;
  return series;
}

void add_point(Series& series, double x, double y) {
  if (!(x > 0.0) || !(y > 0.0)) return;
  series.x.push_back(x);
  series.y.push_back(y);
}

/// Picture without background, so that the light or dark background of the page shows through.
std::string without_background(std::string svg) {
  const std::string_view fill = "fill=\"#ffffff\"";
  const std::size_t rectangle = svg.find("<rect"), at = svg.find(fill, std::min(rectangle, svg.size()));
  if (at != std::string::npos && at < svg.find('>', rectangle)) svg.replace(at, fill.size(), "fill=\"none\"");
  return svg;
}

/// Sentence on values at the end of an axis that do not change an error; empty: there are none.
std::string plateau_text(const formats::Study& study, const std::vector<StudyRow>& rows, const StudyLine& line, int q) {
  const std::optional<std::size_t> from = plateau(rows, line, q);
  if (!from) return {};
  const auto value = [&](std::size_t k) { return rows[line.rows[k]].cell->values[line.axis]; };
  std::vector<std::string> more;
  for (std::size_t k = *from + 1; k < line.rows.size(); ++k) more.push_back(value(k));
  const double error = rows[line.rows.back()].errors[q];
  return fmt::format(
      "{} {} {} nothing compared with {}: the error of {} stays at {:.2g} ({:.2g} %), so it has another cause.",
      study.series[line.series].axes[line.axis].name, listed(more), more.size() > 1 ? "change" : "changes",
      value(*from), study.quantities[q].name, error, 100.0 * error);
}

struct Book {
  const formats::Study& study;
  const std::vector<StudyRow>& rows;
  const std::string& folder;
  std::string html;

  /// Draws a picture into the page and into a file.
  void draw(std::vector<Series> series, PlotOptions options, const std::string& name) {
    std::erase_if(series, [](const Series& one) { return one.x.empty(); });
    if (series.empty()) return;
    options.output = fmt::format("{}/{}.svg", folder, name);
    // 17.5 pixels of 620 are 10 pixels on a telephone of 390 pixels with its margins.
    options.size = PictureSize{620.0, 420.0 + 24.0 * static_cast<double>(series.size()), false};
    options.font.size = 17.5;
    try {
      plot(series, options);
      std::ifstream file(options.output);
      const std::string svg{std::istreambuf_iterator<char>(file), {}};
      html += without_background(svg.substr(std::min(svg.find("<svg"), svg.size())));
    } catch (const Error& error) {
      html += fmt::format("<p class=failed>{}</p>\n", escaped(error.what()));
    }
  }

  /// Draws lines of one diagram over all other runs.
  void work_precision(int q, const std::vector<const StudyLine*>& lines, const std::string& name) {
    Series front = named("least time", SeriesKind::front), others = named("other settings", SeriesKind::backdrop),
           failures = named("failed or over budget", SeriesKind::marks);
    for (const int i : pareto_front(rows, q)) add_point(front, rows[i].time.median, rows[i].errors[q]);
    std::set<int> drawn;
    std::vector<Series> series;
    double greatest = 0.0;
    for (const StudyRow& row : rows)
      if (row.is_measured()) greatest = std::max(greatest, row.errors[q]);
    for (const StudyLine* line : lines) {
      series.push_back(named(line->label, SeriesKind::run));
      for (const int i : line->rows) {
        drawn.insert(i);
        if (rows[i].is_measured()) add_point(series.back(), rows[i].time.median, rows[i].errors[q]);
        if (rows[i].has_run && rows[i].outcome != CellOutcome::completed)
          add_point(failures, rows[i].time.median, 2.0 * greatest);
      }
    }
    for (int i = 0; i < std::ssize(rows); ++i)
      if (!drawn.contains(i) && rows[i].is_measured()) add_point(others, rows[i].time.median, rows[i].errors[q]);
    series.insert(series.begin(), {std::move(front), std::move(others)});
    series.push_back(std::move(failures));
    PlotOptions options;
    options.title = study.name;
    options.x_label = "CPU time [s]";
    options.y_label = "error of " + study.quantities[q].name;
    options.x_scale = options.y_scale = AxisScale::logarithmic;
    options.mark = Mark::line_with_points;
    draw(std::move(series), options, name);
  }

  /// Draws all lines in one diagram. Many lines get one for each value of the first other axis of each series.
  void work_precision(int q) {
    const std::vector<StudyLine> lines = lines_of(study, rows);
    std::map<std::pair<int, int>, std::vector<const StudyLine*>> groups;
    for (const StudyLine& line : lines) {
      const std::vector<int>& index = rows[line.rows.front()].cell->index;
      const int first = line.axis == 0 ? 1 : 0;
      const bool splits = lines.size() > most_lines && count_of(index) > 2;
      groups[lines.size() > most_lines ? std::pair(line.series, splits ? index[first] : 0) : std::pair(0, 0)].push_back(
          &line);
    }
    int number = 0;
    for (const auto& [key, members] : groups)
      for (std::size_t at = 0; at < members.size(); at += most_lines) {
        const std::string suffix = groups.size() > 1 || members.size() > most_lines ? fmt::format("-{}", ++number) : "";
        work_precision(q,
                       {members.begin() + static_cast<std::ptrdiff_t>(at),
                        members.begin() + static_cast<std::ptrdiff_t>(std::min(members.size(), at + most_lines))},
                       study.quantities[q].name + suffix);
      }
  }

  /// Lines along an axis with all other axes at their last value.
  std::vector<StudyLine> finest_lines(const std::string& axis) const {
    std::vector<StudyLine> finest;
    for (int s = 0; s < std::ssize(study.series); ++s)
      for (int a = 0; a < std::ssize(study.series[s].axes); ++a) {
        if (study.series[s].axes[a].name != axis || study.series[s].axes[a].values.size() < 2) continue;
        for (StudyLine& line : lines_along(study, rows, s, a)) {
          const std::vector<int>& index = rows[line.rows.front()].cell->index;
          bool is_finest = true;
          for (int k = 0; k < std::ssize(index); ++k)
            is_finest = is_finest && (k == a || index[k] + 1 == count_of(study.series[s].axes[k].values));
          if (is_finest) finest.push_back(std::move(line));
        }
      }
    if (finest.size() > most_lines) finest.resize(most_lines);
    return finest;
  }

  void along_axis(const std::string& axis, const std::vector<StudyLine>& lines) {
    bool has_numbers = true, is_positive = true;
    for (const StudyLine& line : lines)
      for (const int i : line.rows) {
        const std::optional<double> number = number_of(rows[i].cell->values[line.axis]);
        has_numbers = has_numbers && number;
        is_positive = has_numbers && is_positive && *number > 0.0;
      }
    const auto abscissa = [&](const StudyLine& line, std::size_t k) {
      return has_numbers ? *number_of(rows[line.rows[k]].cell->values[line.axis]) : static_cast<double>(k + 1);
    };
    const auto picture = [&](const std::string& y_label, const std::string& name, const auto& value) {
      std::vector<Series> series;
      for (const StudyLine& line : lines) {
        series.push_back(named(line.label, SeriesKind::run));
        for (std::size_t k = 0; k < line.rows.size(); ++k)
          if (const double y = value(rows[line.rows[k]]); y > 0.0) {
            series.back().x.push_back(abscissa(line, k));
            series.back().y.push_back(y);
          }
      }
      PlotOptions options;
      options.title = y_label + " along " + axis;
      options.x_label = has_numbers ? axis : axis + " (number of the value)";
      options.y_label = y_label;
      options.x_scale = is_positive ? AxisScale::logarithmic : AxisScale::linear;
      options.y_scale = AxisScale::logarithmic;
      options.mark = Mark::line_with_points;
      draw(std::move(series), options, name);
    };
    std::string file = axis;
    std::ranges::replace_if(
        file, [](unsigned char c) { return std::isalnum(c) == 0 && c != '_'; }, '-');
    for (std::size_t q = 0; q < study.quantities.size(); ++q)
      picture("error of " + study.quantities[q].name, study.quantities[q].name + "-along-" + file,
              [q](const StudyRow& row) { return row.is_measured() ? row.errors[q] : 0.0; });
    picture("CPU time [s]", "time-along-" + file,
            [](const StudyRow& row) { return row.is_measured() ? row.time.median : 0.0; });
  }

  void table() {
    html +=
        "<h2>All settings</h2>\n<div class=wide><table><tr><th>setting<th>CPU time "
        "[s]<th>between<th>runs<th>steps<th>iterations";
    for (const formats::StudyQuantity& quantity : study.quantities)
      html += fmt::format("<th>error of {}<th>order", escaped(quantity.name));
    html += "</tr>\n";
    for (const StudyLine& line : lines_of(study, rows))
      for (const int i : line.rows) table_row(rows[i]);
    html += "</table></div>\n";
  }

  void table_row(const StudyRow& row) {
    html += fmt::format("<tr><td>{}", escaped(row.cell->label));
    if (row.is_reference) {
      html += "<td>reference</tr>\n";
    } else if (!row.has_run) {
      html += "<td>not run</tr>\n";
    } else if (!row.is_measured()) {
      html += fmt::format("<td>{:.3g}<td class=failed colspan=9>{}</tr>\n", row.time.median, escaped(row.message));
    } else {
      html += fmt::format("<td>{:.3g}<td>{:.3g}, {:.3g}<td>{}<td>{}<td>{}", row.time.median, row.time.least,
                          row.time.greatest, row.repeats, row.steps, row.iterations);
      for (std::size_t q = 0; q < row.orders.size(); ++q)
        html +=
            fmt::format("<td>{:.2e}<td>{}", row.errors[q], row.orders[q] ? fmt::format("{:.2f}", *row.orders[q]) : "");
      html += "</tr>\n";
    }
  }
};

std::string reference_text(const formats::Study& study, const std::vector<double>& agreement) {
  const formats::StudyReference& reference = study.reference;
  if (!reference.file.empty()) return "Errors are differences from a file: " + reference.source + ".";
  std::string text = "Errors are differences from a run of the study";
  for (std::size_t q = 0; q < agreement.size(); ++q)
    text += fmt::format("{} {} to {:.1e}", q == 0 ? "; an independent run agrees with it in" : ",",
                        study.quantities[q].name, agreement[q]);
  return text + ".";
}

}  // namespace

void write_page(const formats::Study& study, const std::vector<StudyRow>& rows, const std::vector<double>& agreement,
                const std::string& folder) {
  Book book{study, rows, folder, page_head + generator_tag("mechanism")};
  book.html += fmt::format(
      "<title>{0}</title></head><body>\n<h1>{0}</h1>\n<p>{1} Times are CPU seconds of the whole "
      "process, medians{2}. The wide grey line shows the least CPU time with which each error was reached.</p>\n",
      escaped(study.name), escaped(reference_text(study, agreement)),
      study.timing == formats::StudyTiming::together ? " of runs in parallel, therefore rough" : "");
  for (int q = 0; q < std::ssize(study.quantities); ++q) {
    book.html += fmt::format("<h2>Error against CPU time: {}</h2>\n", escaped(study.quantities[q].name));
    book.work_precision(q);
  }
  std::set<std::string> done;
  for (const formats::StudySeries& series : study.series)
    for (const formats::StudyAxis& axis : series.axes) {
      const std::vector<StudyLine> lines = book.finest_lines(axis.name);
      if (lines.empty() || !done.insert(axis.name).second) continue;
      book.html += fmt::format("<h2>Error and CPU time as functions of {}</h2>\n", escaped(axis.name));
      for (const StudyLine& line : lines)
        for (int q = 0; q < std::ssize(study.quantities); ++q)
          if (const std::string text = plateau_text(study, rows, line, q); !text.empty())
            book.html +=
                fmt::format("<p>{}{}</p>\n", escaped(lines.size() > 1 ? line.label + ": " : ""), escaped(text));
      book.along_axis(axis.name, lines);
    }
  book.table();
  write_text_file(folder + "/index.html", book.html + "</body></html>\n");
}

}  // namespace tisserand::mechanism
