// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of the certificate by gnuplot, and the HTML around them.
#include "reducer/report/certificate_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/gnuplot.hpp"
#include "common/program/version.hpp"
#include "common/text.hpp"
#include "common/units.hpp"
#include "reducer/report/verdict.hpp"

namespace tisserand::reducer {
namespace {

constexpr const char* page_style = R"html(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1">
<style>
:root{color-scheme:light dark}
body{font:16px/1.5 system-ui,sans-serif;max-width:70em;margin:2em auto;padding:0 1em;color:#222;background:#fff}
svg{width:100%;max-width:760px;height:auto}table{border-collapse:collapse;font-size:14px}
td,th{padding:.15em .7em;text-align:right;border-bottom:1px solid #ddd}td:first-child,th:first-child{text-align:left}
.panels{display:grid;grid-template-columns:repeat(auto-fit,minmax(300px,1fr))}
.verdict{font-weight:600}.warned{color:#b00}pre{font-size:13px;overflow-x:auto}
@media (prefers-color-scheme:dark){
body{color:#e6e6e6;background:#14171c}td,th{border-color:#3a3f47}.warned{color:#ff8a80}
svg{filter:invert(1) hue-rotate(180deg)}
}
</style>
)html";

constexpr std::array<const char*, 6> directions{"x", "y", "z", "about x", "about y", "about z"};

std::string safe(const std::string& text) {
  std::string result;
  for (const char c : printable(text)) {
    if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '&')
      result += "&amp;";
    else
      result += c;
  }
  return result;
}

/// Picture by gnuplot, or the reason why there is none.
std::string picture(int width, int height, const std::string& script) {
  try {
    const std::string text =
        gnuplot_picture(fmt::format("set terminal svg size {},{} font 'sans,17' linewidth 1.3\nset encoding utf8\n"
                                    "set grid back lc rgb '#dddddd' lt 1 lw 0.7\nset border 3 lc rgb '#444444'\nset "
                                    "tics nomirror\nset format '%h'\n{}",
                                    width, height, script),
                        "certificate");
    return text.substr(std::min(text.find("<svg"), text.size())) + "\n";
  } catch (const Error& error) {
    return fmt::format("<p class=warned>There is no picture: {}</p>\n", safe(error.message()));
  }
}

/// Named data block of gnuplot, one line per row.
std::string data_block(const std::string& name, const std::vector<std::string>& rows) {
  return fmt::format("${} << EOD\n{}\nEOD\n", name, join(rows, "\n"));
}

/// Axis of the modes 1 to `modes`, with so few numbers that they do not touch.
std::string mode_axis(std::size_t modes) {
  return fmt::format("set xrange [0.5:{}.5]\nset xtics 1,{}\n", modes, std::max<std::size_t>(1, (modes + 5) / 6));
}

/// Frequencies of the reduced part with the enclosure of the full part's, widened by the discretisation error.
std::string frequencies(const FileCertificate& file, const ModelCertificate& model, const std::string& unit) {
  double most = 0.0;
  std::vector<std::string> rows, held;
  for (std::size_t k = 0; k < std::min(file.free_frequency.size(), model.truncation_lower.size()); ++k) {
    const double f = file.free_frequency[k];
    const double mesh =
        k < model.mesh_error.error.size() && !model.mesh_error.boundary_held ? model.mesh_error.error[k] : 0;
    const double exact = std::isfinite(mesh) ? f / (1.0 + mesh) : f;
    rows.push_back(fmt::format("{} {} {} {}", k + 1, f, std::min({model.truncation_lower[k], exact, f}),
                               std::max({model.truncation_upper[k], exact, f})));
    if (std::isfinite(model.truncation_upper[k])) most = std::max(most, model.truncation_upper[k]);
    most = std::max(most, f);
  }
  for (std::size_t k = 0; k < std::min<std::size_t>(file.fixed_frequency.size(), 20); ++k) {
    held.push_back(fmt::format("{} {}", k + 1, file.fixed_frequency[k]));
    most = std::max(most, file.fixed_frequency[k]);
  }
  if (rows.empty() || held.empty()) return "";
  return "<h2>Frequencies</h2>\n<p>Frequencies of the free reduced part. A bar is the range in which the frequency of "
         "the full part with a finer mesh may lie.</p>\n" +
         picture(620, 420,
                 data_block("free", rows) + data_block("held", held) +
                     fmt::format("set key top left\nset xlabel 'mode'\nset ylabel 'frequency [{}]'\n"
                                 "set yrange [0:{:.6g}]\n{}",
                                 unit, 1.08 * most, mode_axis(std::max(rows.size(), held.size()))) +
                     "plot $held using 1:2 with points pt 6 lc rgb '#999999' title 'boundary held', "
                     "$free using 1:2:3:4 with yerrorbars pt 7 ps 0.5 lc rgb '#0060ad' title 'free'\n");
}

/// Discretisation and truncation errors, one above the other on one scale.
std::string errors(const ModelCertificate& model) {
  std::vector<std::string> dropped, mesh;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  std::size_t modes = 0;
  const auto add = [&](const std::vector<double>& values, std::vector<std::string>& rows) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double error = 100.0 * std::abs(values[k]);
      if (!(error > 0.0) || !std::isfinite(error)) continue;
      rows.push_back(fmt::format("{} {}", k + 1, error));
      least = std::min(least, error);
      most = std::max(most, error);
      modes = std::max(modes, k + 1);
    }
  };
  add(model.truncation_estimate, dropped);
  add(model.mesh_error.error, mesh);
  std::vector<std::string> plots;
  std::string blocks;
  if (!mesh.empty()) {
    blocks += data_block("mesh", mesh);
    plots.push_back("$mesh using 1:2 with linespoints pt 5 lc rgb '#d95319' title 'mesh'");
  }
  if (!dropped.empty()) {
    blocks += data_block("dropped", dropped);
    plots.push_back("$dropped using 1:2 with linespoints pt 7 lc rgb '#0060ad' title 'dropped modes'");
  }
  if (plots.empty()) return "";
  return fmt::format(
             "<h2>Errors of the {} frequencies</h2>\n<p>Estimates of the change by a finer mesh, and of the change by "
             "more internal modes. Unknown errors have no point; the certificate below gives the reason.</p>\n",
             model.mesh_error.boundary_held ? "fixed" : "free") +
         picture(620, 420,
                 blocks + "set logscale y\nset xlabel 'mode'\nset ylabel 'error [%]'\nset key above left\n" +
                     gnuplot_logarithmic_axis("y", least / 1.5, 1.5 * most) + mode_axis(modes) + "plot " +
                     join(plots, ", ") + "\n");
}

/// One picture per direction, next to one another: the share of each mode and their sum.
std::string effective_masses(const FileCertificate& c) {
  if (c.participation.empty()) return "";
  constexpr std::size_t most_drawn = 100;
  std::string pictures = "<div class=panels>\n";
  std::string sums = "<table><tr><th>direction<th>carried by modes [%]<th>not carried by modes [%]</tr>\n";
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double whole = c.effective_mass_whole[k];
    std::vector<std::string> rows;
    double sum = 0.0;
    for (std::size_t m = 0; m < c.participation.size() && whole > 0.0; ++m) {
      const double share = 100.0 * c.participation[m][k] * c.participation[m][k] / whole;
      sum += share;
      if (m < most_drawn) rows.push_back(fmt::format("{} {:.5g} {:.5g}", m + 1, share, sum));
    }
    if (rows.empty()) rows.push_back("1 0 0");
    pictures +=
        picture(400, 300,
                data_block("mass", rows) + mode_axis(rows.size()) +
                    fmt::format("set yrange [0:105]\nset style fill solid 0.8 noborder\nunset key\nset title '{}'\nset "
                                "xlabel 'mode'\nset ylabel 'effective mass [%]'\nplot $mass using 1:2 with boxes lc "
                                "rgb '#0060ad', $mass using 1:3 with steps lw 2 lc rgb '#d95319'\n",
                                directions[k]));
    sums += fmt::format("<tr><td>{}<td>{:.2f}<td>{:.2f}</tr>\n", directions[k], sum,
                        whole > 0.0 ? 100.0 * c.effective_mass_left[k] / whole : 0.0);
  }
  return "<h2>Effective mass</h2>\n<p>Bars: effective mass of each internal mode in rigid motions of the boundary "
         "about the centre of mass. Line: their sum. The rest moves with the boundary or belongs to dropped "
         "modes.</p>\n" +
         pictures + "</div>\n" + sums + "</table>\n";
}

std::string assurance(const ModelCertificate& model) {
  if (model.assurance.empty()) return "";
  std::vector<std::string> rows;
  for (const std::vector<double>& row : model.assurance) {
    std::vector<std::string> values;
    for (const double value : row) values.push_back(fmt::format("{:.6g}", value));
    rows.push_back(join(values, " "));
  }
  return "<h2>Modal assurance criterion (MAC)</h2>\n<p>Free modes of the full model (vertical axis) and of the reduced "
         "part (horizontal axis). Modes that agree have the value 1 (dark).</p>\n" +
         picture(620, 620,
                 data_block("mac", rows) +
                     "set size square\nset palette defined (0 'white', 1 '#0060ad')\nset cbrange [0:1]\nset xlabel "
                     "'mode of the reduced part'\nset ylabel 'mode of the full model'\nunset grid\nunset key\nset "
                     "xrange [0.5:*]\nset yrange [0.5:*]\nset autoscale fix\nplot $mac matrix using ($1+1):($2+1):3 "
                     "with image pixels\n");
}

std::string warnings_of(const FileCertificate& file, const std::optional<ModelCertificate>& model) {
  std::string html;
  for (const std::string& warning : file.warnings) html += fmt::format("<p class=warned>{}</p>\n", safe(warning));
  if (model)
    for (const std::string& warning : model->warnings) html += fmt::format("<p class=warned>{}</p>\n", safe(warning));
  return html;
}

}  // namespace

std::string certificate_page(const formats::Superelement& element, const FileCertificate& file,
                             const std::optional<ModelCertificate>& model) {
  std::string html = page_style + generator_tag("reducer");
  html += fmt::format("<title>{0}</title></head><body>\n<h1>{0}</h1>\n", safe(element.name));
  html += fmt::format("<p class=verdict>{}</p>\n", safe(verdict(file, model, element.units)));
  const Eigen::Vector3d c = shown_centre(file.rigid, file.characteristic_length);
  html += fmt::format("<p>Mass {:.6g}{}, centre of mass ({:.6g}, {:.6g}, {:.6g}){}.</p>\n", file.rigid.mass,
                      safe(after_number(unit_label(element.units, 0, 1, 0))), c.x(), c.y(), c.z(),
                      safe(after_number(unit_label(element.units, 1, 0, 0))));
  html += warnings_of(file, model);
  if (model) html += frequencies(file, *model, frequency_unit(element.units)) + errors(*model);
  html += effective_masses(file);
  if (model) html += assurance(*model);
  return html + fmt::format("<h2>Certificate</h2>\n<pre>{}</pre>\n</body></html>\n",
                            safe(certificate_text(element, file, model)));
}

}  // namespace tisserand::reducer
