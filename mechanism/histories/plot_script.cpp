// SPDX-License-Identifier: GPL-3.0-or-later
// Panels, curves, marks and legends as gnuplot's commands.
#include "mechanism/histories/plot_script.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/error.hpp"
#include "common/gnuplot.hpp"
#include "common/text.hpp"
#include "mechanism/histories/plot_names.hpp"

namespace tisserand::mechanism {
namespace {

/// Colours of Okabe and Ito, which colour-blind readers can distinguish. In black and white the marks distinguish the
/// curves. Seven colours and six marks give 42 pairs.
constexpr std::array kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
constexpr std::array kPoints = {6, 4, 8, 12, 10, 14};  // circle, square, triangle, diamond, triangle down, pentagon
constexpr std::array kReferenceGreys = {"#A8A8A8", "#707070", "#C8C8C8"};
constexpr std::size_t kMostPanels = 4;
constexpr std::size_t kMostPoints = 12000;  // longer histories are thinned; a picture is 1400 pixels wide
constexpr std::size_t kMostNames = 24;      // in a legend
constexpr double kMarks = 9.0;              // per curve: too few to hide an oscillation, enough to follow the curve

/// Indices to draw: all, or the first, the lowest and the highest point of every bin.
std::vector<std::size_t> thinned(const Series& series) {
  std::vector<std::size_t> kept;
  const std::size_t n = series.x.size();
  const std::size_t bin = n > kMostPoints ? (3 * n + kMostPoints - 1) / kMostPoints : 1;
  for (std::size_t begin = 0; begin < n; begin += bin) {
    const std::size_t end = std::min(n, begin + bin);
    const auto [low, high] = std::minmax_element(series.y.begin() + static_cast<std::ptrdiff_t>(begin),
                                                 series.y.begin() + static_cast<std::ptrdiff_t>(end));
    std::array<std::size_t, 3> picked = {begin, static_cast<std::size_t>(low - series.y.begin()),
                                         static_cast<std::size_t>(high - series.y.begin())};
    std::sort(picked.begin(), picked.end());
    for (const std::size_t i : picked)
      if (kept.empty() || kept.back() != i) kept.push_back(i);
  }
  if (n > 0 && kept.back() != n - 1) kept.push_back(n - 1);
  return kept;
}

void append_points(std::string& script, const Series& series) {
  for (const std::size_t i : thinned(series)) {
    if (std::isfinite(series.x[i]) && std::isfinite(series.y[i]))
      fmt::format_to(std::back_inserter(script), "{:.9g} {:.9g}\n", series.x[i], series.y[i]);
    else
      script += "\n";  // a gap in the line
  }
}

void append_data(std::string& script, const Series& series, std::size_t index) {
  fmt::format_to(std::back_inserter(script), "$d{} << EOD\n", index);
  append_points(script, series);
  script += "EOD\n";
}

bool is_drawn_as_line(SeriesKind kind) { return kind == SeriesKind::run || kind == SeriesKind::difference; }

/// Indices of the marks of a curve, number `rank` of `count` in its panel: no two curves have marks at one abscissa.
std::vector<std::size_t> marked(const Series& series, std::array<double, 2> range, bool logarithmic, std::size_t rank,
                                std::size_t count) {
  const auto to_axis = [&](double x) { return logarithmic ? std::log(x) : x; };
  if (logarithmic && !(range[0] > 0.0)) {
    for (const double x : series.x)
      if (x > 0.0 && (!(range[0] > 0.0) || x < range[0])) range[0] = x;
  }
  const double first = to_axis(range[0]), width = to_axis(range[1]) - first;
  std::vector<std::size_t> places;
  if (!(width > 0.0) || !std::isfinite(width)) return places;
  double next = (static_cast<double>(rank) + 0.5) / static_cast<double>(count) / kMarks;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const double at = (to_axis(series.x[i]) - first) / width;
    if (!std::isfinite(at) || !std::isfinite(series.y[i]) || at < next || at > 1.0) continue;
    places.push_back(i);
    while (next <= at) next += 1.0 / kMarks;
  }
  return places;
}

void append_range(std::string& script, const char* axis, const std::optional<std::array<double, 2>>& range) {
  if (range)
    fmt::format_to(std::back_inserter(script), "set {}range [{:.9g}:{:.9g}]\n", axis, (*range)[0], (*range)[1]);
}

/// Range of the positive values of an axis with a margin; absent if there are none.
std::optional<std::array<double, 2>> positive_range(const std::vector<Series>& series,
                                                    const std::vector<std::size_t>& members,
                                                    std::vector<double> Series::*values) {
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const std::size_t i : members)
    for (const double value : series[i].*values)
      if (value > 0.0 && std::isfinite(value)) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
  if (!(high > 0.0)) return {};
  const double margin = std::max(1.15, std::pow(high / low, 0.04));
  return std::array{low / margin, high * margin};
}

std::string logarithmic_axis(const char* axis, const std::optional<std::array<double, 2>>& range) {
  return range ? gnuplot_logarithmic_axis(axis, (*range)[0], (*range)[1]) : std::string();
}

bool is_crowd(const std::vector<Series>& series, const Panel& panel) {
  return has_too_many_names(panel) && !is_of_modes(series.front());
}

/// Script of one panel while it is written: its curves, then entries of the legend.
struct PanelScript {
  const std::vector<Series>& series;
  const PlotOptions& options;
  const CurveNames& names;
  std::optional<std::array<double, 2>> x_range;
  std::string data;
  std::vector<std::string> commands;

  std::string title(std::size_t index, bool named) const {
    return named ? "title " + gnuplot_quoted(shortened(names.of(series[index]))) : std::string("notitle");
  }
  void line(std::size_t index, std::size_t rank, std::size_t count, bool named);
  void other(std::size_t index, std::size_t rank, bool named);
};

void PanelScript::line(std::size_t index, std::size_t rank, std::size_t count, bool named) {
  const std::string pen = fmt::format("lw 1.8 lc rgb '{}'", kColours[rank % kColours.size()]);
  const int point = kPoints[rank % kPoints.size()];
  if (options.mark == Mark::line_with_points) {
    commands.push_back(fmt::format("$d{} with linespoints ps 1.1 pt {} {} {}", index, point, pen, title(index, named)));
    return;
  }
  if (count == 1 || !named || !x_range) {
    commands.push_back(fmt::format("$d{} with lines {} {}", index, pen, title(index, named)));
    return;
  }
  commands.push_back(fmt::format("$d{} with lines {} notitle", index, pen));
  const std::vector<std::size_t> places =
      marked(series[index], *x_range, options.x_scale == AxisScale::logarithmic, rank, count);
  if (!places.empty()) {
    fmt::format_to(std::back_inserter(data), "$m{} << EOD\n", index);
    for (const std::size_t i : places)
      fmt::format_to(std::back_inserter(data), "{:.9g} {:.9g}\n", series[index].x[i], series[index].y[i]);
    data += "EOD\n";
    commands.push_back(fmt::format("$m{} with points pt {} ps 1.1 {} notitle", index, point, pen));
  }
  commands.push_back(fmt::format("keyentry with linespoints pt {} ps 1.1 {} {}", point, pen, title(index, named)));
}

void PanelScript::other(std::size_t index, std::size_t rank, bool named) {
  const SeriesKind kind = series[index].kind;
  const std::string pen = kind == SeriesKind::front      ? "lines lw 7 lc rgb '#DDDDDD'"
                          : kind == SeriesKind::backdrop ? "points pt 7 ps 0.4 lc rgb '#BBBBBB'"
                          : kind == SeriesKind::marks
                              ? "points pt 2 ps 1.3 lw 2 lc rgb '#BB0000'"
                              : fmt::format("lines lw 3.6 lc rgb '{}'", kReferenceGreys[rank % kReferenceGreys.size()]);
  commands.push_back(fmt::format("$d{} with {} {}", index, pen, title(index, named)));
}

/// Command for bars over the numbers of modes, side by side for several series.
std::string bars(std::size_t index, std::size_t rank, std::size_t count, const std::string& title) {
  const double width = 0.8 / static_cast<double>(count);
  return fmt::format("$d{} using ($1{:+.6g}):2:({:.6g}) with boxes lc rgb '{}' {}", index,
                     width * (static_cast<double>(rank) - 0.5 * static_cast<double>(count - 1)), 0.95 * width,
                     kColours[rank % kColours.size()], title);
}

/// Appends curves without legend, all of one colour as one block with gaps. Single blocks would be slow, because
/// gnuplot searches for each block among all of them.
void append_crowd(std::string& script, const Panel& panel, std::size_t number, PanelScript& own) {
  std::array<std::string, kColours.size() + 1> blocks;  // the last one for references and the like
  std::size_t rank = 0;
  for (const std::size_t i : panel.members) {
    const std::size_t colour = is_drawn_as_line(own.series[i].kind) ? rank++ % kColours.size() : kColours.size();
    append_points(blocks[colour], own.series[i]);
    blocks[colour] += "\n";
  }
  for (std::size_t k = blocks.size(); k-- > 0;) {
    if (blocks[k].empty()) continue;
    fmt::format_to(std::back_inserter(script), "$c{}_{} << EOD\n{}EOD\n", number, k, blocks[k]);
    own.commands.push_back(fmt::format("$c{}_{} with lines lw {} lc rgb '{}' notitle", number, k,
                                       k == kColours.size() ? 3.6 : 1.8,
                                       k == kColours.size() ? kReferenceGreys[0] : kColours[k]));
  }
}

/// Range of an axis for bars of modes, which begins at zero unless values are negative by more than round-off.
std::string axis_of_bars(const std::vector<Series>& series, const Panel& panel) {
  constexpr double round_off = 1e-9, nothing = 1e-12;  // of the largest; of numbers without unit
  double least = 0.0, largest = 0.0;
  for (const std::size_t i : panel.members)
    for (const double value : series[i].y) {
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      largest = std::max(largest, std::abs(value));
    }
  if (largest == 0.0 || (largest < nothing && series[panel.members.front()].unit == "1")) return "set yrange [0:1]\n";
  return least < -round_off * largest ? "set yrange [*<0:0<*]\n" : "set yrange [0:*]\n";
}

void append_panel(std::string& script, const Panel& panel, std::size_t number, PanelScript&& own) {
  const std::string label =
      own.options.y_label.empty() || panel.of_differences ? y_label_of(own.series, panel) : own.options.y_label;
  script += "set ylabel " + gnuplot_quoted(label) + " noenhanced\n";
  const bool named = panel.legend_columns > 0;
  if (own.options.y_scale == AxisScale::logarithmic && (!own.options.y_range || panel.of_differences))
    script += logarithmic_axis("y", positive_range(own.series, panel.members, &Series::y));
  if (is_crowd(own.series, panel)) {
    append_crowd(script, panel, number, own);
  } else if (is_of_modes(own.series.front())) {
    if (own.options.y_scale == AxisScale::linear && !own.options.y_range) script += axis_of_bars(own.series, panel);
    for (std::size_t rank = 0; rank < panel.members.size(); ++rank)
      own.commands.push_back(
          bars(panel.members[rank], rank, panel.members.size(), own.title(panel.members[rank], named)));
  } else {
    const auto count = static_cast<std::size_t>(
        std::ranges::count_if(panel.members, [&](std::size_t i) { return is_drawn_as_line(own.series[i].kind); }));
    for (const SeriesKind kind : {SeriesKind::front, SeriesKind::backdrop, SeriesKind::reference, SeriesKind::run,
                                  SeriesKind::difference, SeriesKind::marks}) {
      std::size_t rank = 0;
      for (const std::size_t i : panel.members) {
        if (own.series[i].kind != kind) continue;
        if (is_drawn_as_line(kind))
          own.line(i, rank++, count, named);
        else
          own.other(i, rank++, named);
      }
    }
  }
  script += own.data + "plot " + join(own.commands, ", \\\n     ") + "\n";
}

/// Time range of the runs if there are any, because references often continue after them; else of all series.
std::optional<std::array<double, 2>> range_of_runs(const std::vector<Series>& series) {
  std::optional<std::array<double, 2>> range;
  for (const Series& one : series) {
    if (one.kind == SeriesKind::reference || one.x.empty()) continue;
    const auto [low, high] = std::minmax_element(one.x.begin(), one.x.end());
    range = range ? std::array{std::min((*range)[0], *low), std::max((*range)[1], *high)} : std::array{*low, *high};
  }
  return range && (*range)[0] < (*range)[1] ? range : std::nullopt;
}

/// Range of the abscissa; for modes extended by half a bar at both ends.
std::optional<std::array<double, 2>> range_of(const std::vector<Series>& series) {
  std::optional<std::array<double, 2>> range = range_of_runs(series);
  if (!is_of_modes(series.front())) return range;
  std::size_t modes = 1;
  for (const Series& one : series) modes = std::max(modes, one.x.size());
  return std::array{0.5, static_cast<double>(modes) + 0.5};
}

/// Commands for filled bars over whole numbers.
std::string modes_axes(const std::vector<Series>& series) {
  std::size_t modes = 1;
  for (const Series& one : series) modes = std::max(modes, one.x.size());
  return fmt::format("set style fill solid 0.8 noborder\nset xtics {}\n", (modes + 29) / 30);
}

/// Panels with the columns of their legends, and the canvas.
struct PictureLayout {
  std::vector<Panel> panels;
  Canvas canvas;
};

/// Number of legend columns that fit into a width.
std::size_t columns_of(const std::vector<Series>& series, const Panel& panel, const CurveNames& names, double letters) {
  std::size_t longest = 1;
  for (const std::size_t i : panel.members) longest = std::max(longest, shortened(names.of(series[i])).size());
  constexpr double sample = 9.0, margins = 16.0;  // letters that a line sample with its space takes, and the axis
  const double fit = (letters - margins) / (static_cast<double>(longest) + sample);
  return std::clamp<std::size_t>(static_cast<std::size_t>(std::max(fit, 1.0)), 1, panel.members.size());
}

std::size_t legend_rows(const Panel& panel) {
  return panel.legend_columns == 0 ? 0 : (panel.members.size() + panel.legend_columns - 1) / panel.legend_columns;
}

/// Layout with each legend above its panel. In a picture of given size it takes at most a third of the panel's height.
PictureLayout layout_of(const std::vector<Series>& series, const PlotOptions& options, const CurveNames& names) {
  PictureLayout layout{panels_of(series), {}};
  const auto canvas = [&](std::size_t rows) {
    return canvas_of(options.output, options.size, options.font, layout.panels.size(), rows);
  };
  const double letters = canvas(0).columns;
  std::size_t rows = 0;
  for (Panel& panel : layout.panels) {
    if (!has_too_many_names(panel)) panel.legend_columns = columns_of(series, panel, names, letters);
    rows += std::max<std::size_t>(legend_rows(panel), 1) - 1;
  }
  layout.canvas = canvas(rows);
  const double lines = layout.canvas.lines / static_cast<double>(layout.panels.size());
  for (Panel& panel : layout.panels)
    if (options.size && static_cast<double>(legend_rows(panel)) > std::max(1.0, lines / 3.0)) panel.legend_columns = 0;
  return layout;
}

}  // namespace

bool is_of_modes(const Series& series) { return series.x_name == "mode"; }

bool has_too_many_names(const Panel& panel) { return panel.members.size() > kMostNames; }

std::vector<Panel> panels_of(const std::vector<Series>& series) {
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const bool of_differences = series[i].kind == SeriesKind::difference;
    const bool joins_first = series[i].kind == SeriesKind::reference && series[i].unit.empty();
    auto panel = panels.begin();
    if (!joins_first)
      panel = std::ranges::find_if(
          panels, [&](const Panel& p) { return p.unit == series[i].unit && p.of_differences == of_differences; });
    if (panel == panels.end()) panel = panels.insert(panels.end(), Panel{series[i].unit, of_differences, {}, 0});
    panel->members.push_back(i);
  }
  const auto units = static_cast<std::size_t>(std::ranges::count(panels, false, &Panel::of_differences));
  if (units > kMostPanels)
    throw Error(fmt::format("the chosen channels have {} different units", units), "plot",
                fmt::format("choose channels of at most {} different units", kMostPanels));
  return panels;
}

std::string missing_legends(const std::vector<Series>& series, const PlotOptions& options) {
  std::string text;
  for (const Panel& panel : layout_of(series, options, CurveNames(series)).panels)
    if (panel.legend_columns == 0)
      text +=
          has_too_many_names(panel)
              ? fmt::format("{} curves in one panel are too many for a legend: it is omitted\n", panel.members.size())
              : fmt::format(
                    "the legend of {} curves does not fit and is omitted; use a larger --size or a smaller --font\n",
                    panel.members.size());
  return text;
}

std::string gnuplot_script(const std::vector<Series>& series, const PlotOptions& options) {
  const CurveNames names(series);
  const auto [panels, canvas] = layout_of(series, options, names);
  std::string script = canvas.terminal + "set encoding utf8\n";
  for (const Panel& panel : panels)
    if (!is_crowd(series, panel))
      for (const std::size_t i : panel.members) append_data(script, series[i], i);
  script +=
      "set grid back lc rgb '#DDDDDD' lt 1 lw 0.7\n"
      "set border 3 lc rgb '#444444'\n"
      "set tics nomirror\n"
      "set format '%h'\n"  // gnuplot's own begins with a blank, which shifts labels to the right of their ticks
      "set lmargin 12\n"
      "set rmargin 4\n";
  if (options.x_scale == AxisScale::logarithmic) script += "set logscale x\nset format x '10^{%T}'\n";
  if (options.y_scale == AxisScale::logarithmic) script += "set logscale y\nset format y '10^{%T}'\n";
  if (is_of_modes(series.front())) script += modes_axes(series);
  const bool may_start_at_zero = options.x_scale == AxisScale::linear;
  const auto whole_range = range_of(series);
  append_range(script, "x", options.x_range || !may_start_at_zero ? options.x_range : whole_range);
  std::vector<std::size_t> all(series.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (!may_start_at_zero && !options.x_range) script += logarithmic_axis("x", positive_range(series, all, &Series::x));
  append_range(script, "y", options.y_range);
  const std::string title_font = fmt::format("font ',{:.6g}'", canvas.title_size);
  if (panels.size() > 1) {
    fmt::format_to(std::back_inserter(script), "set multiplot layout {},1 title {} noenhanced {}\n", panels.size(),
                   gnuplot_quoted(options.title), title_font);
  } else if (!options.title.empty()) {
    script += "set title " + gnuplot_quoted(options.title) + " noenhanced " + title_font + "\n";
  }
  const std::string x_label =
      options.x_label.empty() ? with_unit(series.front().x_name, series.front().x_unit) : options.x_label;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    if (p + 1 == panels.size()) script += "set xlabel " + gnuplot_quoted(x_label) + " noenhanced\n";
    if (panels[p].of_differences && options.y_range) script += "set yrange [*:*]\n";
    script += panels[p].legend_columns == 0
                  ? "unset key\n"
                  : fmt::format("set key above left horizontal Left reverse maxcols {} samplen 3 noenhanced\n",
                                panels[p].legend_columns);
    append_panel(script, panels[p], p,
                 PanelScript{series, options, names, options.x_range ? options.x_range : whole_range, "", {}});
  }
  if (panels.size() > 1) script += "unset multiplot\n";
  return script;
}

}  // namespace tisserand::mechanism
