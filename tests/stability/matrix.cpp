// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the program and compares its results with the criteria.
#include "tests/stability/matrix.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/child.hpp"
#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/results/results.hpp"

namespace tisserand::stability {
namespace {

using Json = nlohmann::json;

struct Level {
  std::string name;
  std::vector<std::string> settings;
};

const std::vector<Level>& integrators() {
  static const std::vector<Level> levels{
      {"default", {}},
      {"rho 0", {"integrator.rho=0"}},
      {"rho 1", {"integrator.rho=1"}},
      {"index 3", {"integrator.formulation=index3"}},
      {"index 3, rho 1", {"integrator.formulation=index3", "integrator.rho=1"}},
      {"hht", {"integrator.method=hht"}},
      {"controlled", {"integrator.error_control={tolerance: 1e-4}"}},
      {"radau", {"integrator.method=radau", "integrator.error_control={tolerance: 1e-6}"}},
      {"bdf", {"integrator.method=bdf"}}};
  return levels;
}

const std::vector<std::string>& solvers() {
  static const std::vector<std::string> names{"klu", "umfpack", "dense", "qr"};
  return names;
}

const std::vector<Level>& scalings() {
  static const std::vector<Level> levels{{"L 1e-3", {"parameters.L=1e-3"}},
                                         {"L 1e3", {"parameters.L=1e3"}},
                                         {"M 1e-6", {"parameters.M=1e-6"}},
                                         {"M 1e6", {"parameters.M=1e6"}}};
  return levels;
}

double length_of(const Cell& cell) {
  for (const std::string& setting : cell.settings)
    if (setting.starts_with("parameters.L=")) return std::stod(setting.substr(13));
  return 1.0;
}

bool sets(const Case& one, const std::string& key) {
  return std::ranges::any_of(one.settings, [&](const std::string& setting) { return setting.starts_with(key); });
}

constexpr const char* stiff_for_bdf = "not run: bdf takes minutes because stiff bodies force short steps";

/// Why an integrator does not run a case; empty if it does.
std::string impossible_integrator(const Case& one, const std::string& name) {
  const bool other_method = name == "radau" || name == "bdf";
  if (one.scene == "stiff_spring" && !sets(one, "parameters.kick") && name == "bdf")
    return "not run: bdf does not damp the mode at 1.4e6 rad/s and would take nine million steps";
  if (one.scene == "soft_blade" && name == "bdf") return stiff_for_bdf;
  if (one.scene == "four_bar_misaligned" && name == "controlled")
    return "not run: undamped vibrations of the bars force short steps, which take minutes";
  if (!one.takes_steps) return "statics has no time steps";
  if (sets(one, "integrator.formulation=index3") && (other_method || name.starts_with("index 3")))
    return "the case tests `formulation: index3` only";
  if ((sets(one, "integrator.step") || sets(one, "parameters.step")) && (other_method || name == "controlled"))
    return "the case tests a fixed step";
  return {};
}

void add_integrators(const Case& one, const Formulation* body, std::vector<Cell>& cells) {
  for (const Level& level : integrators()) {
    if (body != nullptr && level.settings.empty()) continue;  // the row of formulations has it
    Cell cell{&one, body == nullptr ? "integrator" : "formulation x integrator",
              body == nullptr ? level.name : body->name + ", " + level.name, one.settings,
              impossible_integrator(one, level.name)};
    if (body != nullptr) {
      cell.settings.insert(cell.settings.end(), body->settings.begin(), body->settings.end());
      if (cell.impossible.empty()) cell.impossible = body->impossible;
      if (level.name == "bdf" && cell.impossible.empty()) cell.impossible = stiff_for_bdf;
      if (body->name == "mass far from the nodes" && cell.impossible.empty())
        cell.impossible =
            "not run: the default method reports the case; the others take minutes because their steps become shorter "
            "and shorter";
      if (level.name == "radau" && body->name == "second order")
        cell.impossible = "radau supports linear superelements only (the run reports an error)";
    }
    cell.settings.insert(cell.settings.end(), level.settings.begin(), level.settings.end());
    cells.push_back(std::move(cell));
  }
}

/// Warnings of the run, joined.
std::string doubts_of(const Json& report) {
  std::vector<std::string> texts;
  const auto add = [&texts](const Json& list) {
    for (const Json& one : list)
      if (one.is_string()) texts.push_back(one);
  };
  if (report.contains("doubts")) add(report["doubts"]);
  if (report.contains("preflight")) add(report["preflight"]["doubts"]);
  return join(texts, "; ");
}

double value_of(const Criterion& criterion, const formats::ResultsReader& reader) {
  double sum = 0.0, squares = 0.0;
  for (const Criterion::Term& term : criterion.terms) {
    const double value = term.factor * reader.read(term.channel).back();
    sum += value;
    squares += value * value;
  }
  return criterion.kind == Criterion::Kind::length ? std::sqrt(squares) : sum;
}

/// Largest error over its tolerance; not-a-number stays.
double worst_error(const Cell& cell, const formats::ResultsReader& reader, const Json& report) {
  double worst = 0.0;
  const auto raise = [&worst](double ratio) { worst = ratio <= worst ? worst : ratio; };
  for (const Criterion& criterion : cell.of->criteria) {
    if (criterion.kind == Criterion::Kind::balance) {
      raise(report.at("energy").at("largest_relative_balance").get<double>() / criterion.tolerance);
      continue;
    }
    const double scale = criterion.is_length ? length_of(cell) : 1.0;
    raise(std::abs(value_of(criterion, reader) / scale - criterion.expected) / criterion.tolerance);
  }
  return worst;
}

std::string without(std::string text, const std::string& part) {
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part)) text.erase(at, part.size());
  return text;
}

void reduce(const Part& part, const Place& place) {
  ChildRequest request;
  request.words = {place.reducer, "run", fmt::format("{}/{}.part.yaml", place.work, part.source), "-o",
                   fmt::format("{}/{}.superelement.h5", place.work, part.file)};
  request.seconds = 120.0;
  for (const std::string& setting : part.settings) {
    request.words.push_back("--set");
    request.words.push_back(setting);
  }
  const ChildReport report = run_child(request);
  if (report.code != 0) throw Error(report.complaint, part.file, "the part of the matrix cannot be reduced");
}

}  // namespace

std::string word(State state) {
  switch (state) {
    case State::pass:
      return "pass";
    case State::reported:
      return "reported";
    case State::fail:
      return "FAIL";
    case State::impossible:
      return "-";
  }
  return {};
}

std::vector<Cell> cells_of(const Case& one) {
  std::vector<Cell> cells;
  for (const Formulation& body : one.formulations) {
    Cell cell{&one, "formulation", body.name, one.settings, body.impossible};
    cell.settings.insert(cell.settings.end(), body.settings.begin(), body.settings.end());
    cells.push_back(std::move(cell));
  }
  add_integrators(one, nullptr, cells);
  if (one.takes_steps)
    for (std::size_t i = 1; i < one.formulations.size(); ++i) add_integrators(one, &one.formulations[i], cells);
  if (!one.quick) return cells;  // long cases: formulations and integrators only
  const auto add = [&](const char* factor, const std::string& level, std::vector<std::string> settings,
                       const std::string& impossible) {
    Cell cell{&one, factor, level, one.settings, impossible};
    cell.settings.insert(cell.settings.end(), settings.begin(), settings.end());
    cells.push_back(std::move(cell));
  };
  for (const std::string& solver : solvers()) {
    add("solver", solver, {"integrator.linear_solver=" + solver}, one.takes_steps ? "" : "statics selects its solver");
    add("solver x radau", solver,
        {"integrator.linear_solver=" + solver, "integrator.method=radau", "integrator.error_control={tolerance: 1e-6}"},
        solver == "qr" ? "`linear_solver: qr` does not solve complex systems (the run reports an error)"
                       : impossible_integrator(one, "radau"));
  }
  for (const Level& level : scalings())
    add("scaling", level.name, level.settings, one.scales ? "" : "bodies from files have their own units");
  return cells;
}

void prepare(const Place& place) {
  namespace fs = std::filesystem;
  fs::create_directories(place.work);
  const std::string trials = place.scenes + "/../../verification/references/trials";
  for (const std::string& folder : {trials, place.scenes})
    for (const fs::directory_entry& file : fs::directory_iterator(folder))
      fs::copy_file(file.path(), fs::path(place.work) / file.path().filename(), fs::copy_options::overwrite_existing);
  for (const Part& part : parts()) reduce(part, place);
  write_modal_rod(place.work + "/rod.modal.h5");
}

Outcome run(const Cell& cell, const Place& place) {
  if (!cell.impossible.empty()) return {State::impossible, 0.0, cell.impossible, 0.0};
  const std::string results = place.work + "/cell.results.h5";
  ChildRequest request;
  request.words = {place.mechanism, "run", fmt::format("{}/{}.scene.yaml", place.work, cell.of->scene), "-o", results};
  request.seconds = 300.0;
  for (const std::string& setting : cell.settings) {
    request.words.push_back("--set");
    request.words.push_back(setting);
  }
  std::filesystem::remove(results);
  const ChildReport child = run_child(request);
  Outcome outcome;
  outcome.seconds = child.cpu_seconds;
  if (child.ending != ChildEnding::left) {
    outcome.said = child.ending == ChildEnding::killed ? "the program crashed" : "no end within 300 s";
    return outcome;
  }
  if (child.code != 0) {
    const std::size_t words = child.complaint.find("mechanism: ");  // behind the lines of progress
    const std::string complaint = child.complaint.substr(words == std::string::npos ? 0 : words);
    outcome.said = printable_line(without(complaint, place.work + "/"), 1000);
    const bool has_reason = (child.code == 1 || child.code == 3) && !child.complaint.empty() &&
                            child.complaint.find("internal error") == std::string::npos;
    outcome.state = has_reason ? State::reported : State::fail;
    return outcome;
  }
  const formats::ResultsReader reader(results);
  const Json report = Json::parse(reader.report_json(), nullptr, false);
  outcome.worst = worst_error(cell, reader, report);
  outcome.said = doubts_of(report);
  outcome.state = outcome.worst <= 1.0 ? State::pass : outcome.said.empty() ? State::fail : State::reported;
  return outcome;
}

}  // namespace tisserand::stability
