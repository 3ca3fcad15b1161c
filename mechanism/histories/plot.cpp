// Writes a gnuplot script with the data in it and runs gnuplot on it.
#include "mechanism/histories/plot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.hpp"
#include "common/gnuplot.hpp"
#include "common/output_path.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

/// Okabe and Ito's colours, told apart by the colour-blind; lines differ by their dashes as well.
constexpr std::array kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
constexpr std::array kDashes = {"solid", "(18,6)", "(8,5)", "(18,5,4,5)", "(3,4)", "(18,5,4,5,4,5)"};
constexpr std::array kReferenceGreys = {"#A8A8A8", "#707070", "#C8C8C8"};
constexpr std::size_t kMostPanels = 4;
constexpr std::size_t kMostPoints = 12000;  // beyond this a history is thinned; a picture is 1400 pixels wide

std::vector<std::string> path_parts(const std::string& channel) {
  std::vector<std::string> parts(1);
  for (const char c : channel) {
    if (c == '/')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// "nodes/angular_velocity/beam/tip/z" -> "angular velocity"; "solver/step" -> "step"; "energy/kinetic" -> "energy".
std::string quantity(const Series& series) {
  const std::vector<std::string> parts = path_parts(series.channel);
  std::string word = parts.size() > 1 && parts.front() != "energy" ? parts[1] : parts.front();
  std::replace(word.begin(), word.end(), '_', ' ');
  return word;
}

/// "nodes/angular_velocity/beam/tip/z" -> "beam/tip/z"; "energy/kinetic" -> "kinetic".
std::string short_name(const Series& series) {
  const std::vector<std::string> parts = path_parts(series.channel);
  const std::size_t skipped = parts.size() > 2 ? 2 : parts.size() - 1;
  return join({parts.begin() + static_cast<std::ptrdiff_t>(skipped), parts.end()}, "/");
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : name + " [" + with_superscripts(unit) + "]";
}

/// Series that share a unit, as indices; a reference without unit joins the first panel.
struct Panel {
  std::string unit;
  std::vector<std::size_t> members;
};

std::vector<Panel> panels_of(const std::vector<Series>& series) {
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const bool joins_first = series[i].kind == SeriesKind::reference && series[i].unit.empty();
    auto panel = panels.begin();
    if (!joins_first)
      panel = std::find_if(panels.begin(), panels.end(), [&](auto& p) { return p.unit == series[i].unit; });
    if (panel == panels.end()) panel = panels.insert(panels.end(), Panel{series[i].unit, {}});
    panel->members.push_back(i);
  }
  if (panels.size() > kMostPanels)
    throw Error(fmt::format("the chosen channels have {} different units", panels.size()), "plot",
                fmt::format("choose channels of at most {} units", kMostPanels));
  return panels;
}

std::string y_label_of(const std::vector<Series>& series, const Panel& panel) {
  std::vector<std::string> quantities;
  for (const std::size_t i : panel.members) {
    if (series[i].kind == SeriesKind::reference && panel.members.front() != i) continue;
    const std::string word = quantity(series[i]);
    if (std::find(quantities.begin(), quantities.end(), word) == quantities.end()) quantities.push_back(word);
  }
  return with_unit(join(quantities, ", "), panel.unit);
}

/// What tells this series from the others of the picture.
std::string legend_of(const std::vector<Series>& series, const Series& one) {
  if (one.kind == SeriesKind::reference) return one.source;
  bool same_source = true, same_channel = true;
  std::size_t from_this_source = 0;
  for (const Series& other : series) {
    if (other.kind == SeriesKind::reference) continue;
    same_source = same_source && other.source == one.source;
    same_channel = same_channel && other.channel == one.channel;
    from_this_source += other.source == one.source ? 1 : 0;
  }
  if (one.has_own_label && from_this_source == 1) return one.source;
  if (same_channel) return same_source ? short_name(one) : one.source;
  return same_source ? short_name(one) : one.source + ": " + short_name(one);
}

/// Indices to draw: all, or of every bin the first, the lowest and the highest point.
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

void append_data(std::string& script, const Series& series, std::size_t index) {
  fmt::format_to(std::back_inserter(script), "$d{} << EOD\n", index);
  for (const std::size_t i : thinned(series)) {
    if (std::isfinite(series.x[i]) && std::isfinite(series.y[i]))
      fmt::format_to(std::back_inserter(script), "{:.9g} {:.9g}\n", series.x[i], series.y[i]);
    else
      script += "\n";  // a gap in the line
  }
  script += "EOD\n";
}

void append_range(std::string& script, const char* axis, const std::optional<std::array<double, 2>>& range) {
  if (range)
    fmt::format_to(std::back_inserter(script), "set {}range [{:.9g}:{:.9g}]\n", axis, (*range)[0], (*range)[1]);
}

/// One curve of the plot command; `rank` is its place among the runs or the references of its panel.
std::string curve(const std::vector<Series>& series, std::size_t index, std::size_t rank, const PlotOptions& options) {
  const std::string title = gnuplot_quoted(legend_of(series, series[index]));
  if (series[index].kind == SeriesKind::front)
    return fmt::format("$d{} with lines lw 7 lc rgb '#DDDDDD' title {}", index, title);
  if (series[index].kind == SeriesKind::backdrop)
    return fmt::format("$d{} with points pt 7 ps 0.4 lc rgb '#BBBBBB' title {}", index, title);
  if (series[index].kind == SeriesKind::marks)
    return fmt::format("$d{} with points pt 2 ps 1.3 lw 2 lc rgb '#BB0000' title {}", index, title);
  const char* shape = options.mark == Mark::line_with_points ? "linespoints ps 1.1" : "lines";
  if (series[index].kind == SeriesKind::reference && options.mark == Mark::line)
    return fmt::format("$d{} with lines lw 3.6 lc rgb '{}' title {}", index,
                       kReferenceGreys[rank % kReferenceGreys.size()], title);
  const std::string points = options.mark == Mark::line ? "" : fmt::format(" pt {}", 4 + rank % 10);
  return fmt::format("$d{} with {}{} lw 1.8 lc rgb '{}' dt {} title {}", index, shape, points,
                     kColours[rank % kColours.size()], kDashes[rank % kDashes.size()], title);
}

bool is_of_modes(const Series& series) { return series.x_name == "mode"; }

/// Bars over the numbers of modes, those of several series side by side.
std::string bars(const std::vector<Series>& series, std::size_t index, std::size_t rank, std::size_t count) {
  const double width = 0.8 / static_cast<double>(count);
  return fmt::format("$d{} using ($1{:+.6g}):2:({:.6g}) with boxes lc rgb '{}' title {}", index,
                     width * (static_cast<double>(rank) - 0.5 * static_cast<double>(count - 1)), 0.95 * width,
                     kColours[rank % kColours.size()], gnuplot_quoted(legend_of(series, series[index])));
}

void append_panel(std::string& script, const std::vector<Series>& series, const Panel& panel,
                  const PlotOptions& options) {
  const std::string label = options.y_label.empty() ? y_label_of(series, panel) : options.y_label;
  script += "set ylabel " + gnuplot_quoted(label) + " noenhanced\n";
  std::vector<std::string> curves;
  if (is_of_modes(series.front())) {
    for (std::size_t rank = 0; rank < panel.members.size(); ++rank)
      curves.push_back(bars(series, panel.members[rank], rank, panel.members.size()));
    script += "plot " + join(curves, ", \\\n     ") + "\n";
    return;
  }
  for (const SeriesKind kind :
       {SeriesKind::front, SeriesKind::backdrop, SeriesKind::reference, SeriesKind::run, SeriesKind::marks}) {
    std::size_t rank = 0;
    for (const std::size_t i : panel.members)
      if (series[i].kind == kind) curves.push_back(curve(series, i, rank++, options));
  }
  script += "plot " + join(curves, ", \\\n     ") + "\n";
}

/// The time of the runs where there are runs, since references often go on after them; else all there is.
std::optional<std::array<double, 2>> range_of_runs(const std::vector<Series>& series) {
  std::optional<std::array<double, 2>> range;
  for (const Series& one : series) {
    if (one.kind == SeriesKind::reference || one.x.empty()) continue;
    const auto [low, high] = std::minmax_element(one.x.begin(), one.x.end());
    range = range ? std::array{std::min((*range)[0], *low), std::max((*range)[1], *high)} : std::array{*low, *high};
  }
  return range && (*range)[0] < (*range)[1] ? range : std::nullopt;
}

/// Half a bar more at both ends where modes are drawn.
std::optional<std::array<double, 2>> range_of(const std::vector<Series>& series) {
  std::optional<std::array<double, 2>> range = range_of_runs(series);
  if (!is_of_modes(series.front())) return range;
  std::size_t modes = 1;
  for (const Series& one : series) modes = std::max(modes, one.x.size());
  return std::array{0.5, static_cast<double>(modes) + 0.5};
}

/// Filled bars that stand on zero, over whole numbers.
std::string modes_axes(const std::vector<Series>& series, const PlotOptions& options) {
  std::size_t modes = 1;
  for (const Series& one : series) modes = std::max(modes, one.x.size());
  return fmt::format("set style fill solid 0.8 noborder\nset xtics {}\n{}", (modes + 29) / 30,
                     options.y_scale == AxisScale::linear ? "set yrange [*<0:0<*]\n" : "");
}

/// Time and modes share no axis.
void check_abscissae(const std::vector<Series>& series) {
  for (const Series& one : series)
    if (one.kind == SeriesKind::run && is_of_modes(one) != is_of_modes(series.front()))
      throw Error(
          fmt::format("'{}' is over modes, '{}' over time", is_of_modes(one) ? one.channel : series.front().channel,
                      is_of_modes(one) ? series.front().channel : one.channel),
          "plot", "draw them as two pictures");
}

std::string terminal_of(const std::string& picture, std::size_t panels) {
  const int height = panels == 1 ? 800 : 200 + 400 * static_cast<int>(panels);
  if (picture.ends_with(".png") || is_stream(picture))
    return fmt::format("set terminal pngcairo size 1400,{} font 'sans,17' linewidth 1.4 background 'white'\n", height);
  if (picture.ends_with(".svg"))
    return fmt::format("set terminal svg size 1400,{} font 'sans,17' linewidth 1.4 background 'white'\n", height);
  throw Error("'" + picture + "' is neither a .png nor an .svg file", "plot",
              "give -o a name that ends in .png or .svg");
}

/// gnuplot cannot draw axes around nothing, as where a node has no rotations or a joint no coordinate.
void check_finite(const std::vector<Series>& series) {
  const auto has_value = [&series](std::size_t index) {
    const Series& one = series[index];
    for (std::size_t i = 0; i < one.x.size(); ++i)
      if (std::isfinite(one.x[i]) && std::isfinite(one.y[i])) return true;
    return false;
  };
  for (const Panel& panel : panels_of(series)) {
    if (std::any_of(panel.members.begin(), panel.members.end(), has_value)) continue;
    const Series& first = series[panel.members.front()];
    throw Error(fmt::format("channel '{}' holds no finite value", first.channel), first.source,
                "choose another channel");
  }
}

/// gnuplot's own words on an empty picture name lines of our script.
void check_something_is_seen(const std::vector<Series>& series, const PlotOptions& options) {
  const auto range = options.x_range;
  bool is_in_range = false, is_positive = false;
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const Series& one : series)
    for (std::size_t i = 0; i < one.x.size(); ++i) {
      if (!std::isfinite(one.x[i]) || !std::isfinite(one.y[i])) continue;
      first = std::min(first, one.x[i]);
      last = std::max(last, one.x[i]);
      if (range && !(one.x[i] >= std::min((*range)[0], (*range)[1]) && one.x[i] <= std::max((*range)[0], (*range)[1])))
        continue;
      is_in_range = true;
      is_positive = is_positive || ((options.x_scale == AxisScale::linear || one.x[i] > 0.0) &&
                                    (options.y_scale == AxisScale::linear || one.y[i] > 0.0));
    }
  const Series& one = series.front();
  if (!is_in_range)
    throw Error(fmt::format("nothing between {:g} and {:g}; the run has {:g} to {:g} {}", (*range)[0], (*range)[1], first,
                            last, one.x_unit),
                one.source, "choose another --range");
  if (!is_positive)
    throw Error(fmt::format("'{}' has no positive values, which a logarithmic axis needs", one.channel), one.source,
                "leave --log-x and --log-y away, or choose another channel");
}

}  // namespace

std::string with_superscripts(const std::string& unit) {
  constexpr std::array digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  bool raised = false;
  for (const char c : unit) {
    if (c == '^')
      raised = true;
    else if (raised && c == '-')
      text += "⁻";
    else if (raised && c >= '0' && c <= '9')
      text += digits[c - '0'];
    else {
      raised = false;
      text += c;
    }
  }
  return text;
}

std::string gnuplot_script(const std::vector<Series>& series, const PlotOptions& options) {
  const std::vector<Panel> panels = panels_of(series);
  std::string script = terminal_of(options.output, panels.size());
  script += "set encoding utf8\n";
  for (std::size_t i = 0; i < series.size(); ++i) append_data(script, series[i], i);
  script +=
      "set grid back lc rgb '#DDDDDD' lt 1 lw 0.7\n"
      "set border 3 lc rgb '#444444'\n"
      "set tics nomirror\n"
      "set key above left horizontal Left reverse width 3 samplen 4 noenhanced\n"
      "set lmargin 12\n"
      "set rmargin 4\n";
  if (options.x_scale == AxisScale::logarithmic) script += "set logscale x\nset format x '10^{%T}'\n";
  if (options.y_scale == AxisScale::logarithmic) script += "set logscale y\nset format y '10^{%T}'\n";
  if (is_of_modes(series.front())) script += modes_axes(series, options);
  const bool may_start_at_zero = options.x_scale == AxisScale::linear;
  append_range(script, "x", options.x_range || !may_start_at_zero ? options.x_range : range_of(series));
  append_range(script, "y", options.y_range);
  if (panels.size() > 1) {
    fmt::format_to(std::back_inserter(script), "set multiplot layout {},1 title {} noenhanced font ',20'\n",
                   panels.size(), gnuplot_quoted(options.title));
  } else if (!options.title.empty()) {
    script += "set title " + gnuplot_quoted(options.title) + " noenhanced font ',20'\n";
  }
  const std::string x_label =
      options.x_label.empty() ? with_unit(series.front().x_name, series.front().x_unit) : options.x_label;
  for (const Panel& panel : panels) {
    if (&panel == &panels.back()) script += "set xlabel " + gnuplot_quoted(x_label) + " noenhanced\n";
    append_panel(script, series, panel, options);
  }
  if (panels.size() > 1) script += "unset multiplot\n";
  return script;
}

void plot(const std::vector<Series>& series, const PlotOptions& options) {
  const bool has_points = std::any_of(series.begin(), series.end(), [](const Series& s) { return !s.x.empty(); });
  if (!has_points) throw Error("nothing to draw: the chosen channels hold no instant", "plot", "choose another run");
  check_abscissae(series);
  check_finite(series);
  check_something_is_seen(series, options);
  terminal_of(options.output, 1);  // throws for another ending before anything is done
  write_text_file(options.output, gnuplot_picture(gnuplot_script(series, options), options.output));
}

}  // namespace tisserand::mechanism
