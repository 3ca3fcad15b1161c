// SPDX-License-Identifier: GPL-3.0-or-later
// Report of a run, as JSON and as text.
#include "mechanism/run/report.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

const char* outcome_name(RunOutcome outcome) {
  static constexpr const char* names[] = {"completed", "unstable", "not converged", "interrupted"};
  return names[static_cast<int>(outcome)];
}

/// Text on the choice of an effect: "flexibility off: crank (at most 0.2 times the tolerance: crank, t = 0.3 s); on:
/// rod".
std::string choice_text(const RunReport& report, const std::string& effect, const Units& units) {
  std::vector<std::string> texts;
  for (const bool on : {false, true}) {
    std::vector<std::string> names;
    const ChosenEffect* most = nullptr;
    for (const ChosenEffect& choice : report.automatic) {
      if (choice.effect != effect || choice.on != on) continue;
      names.push_back(choice.body);
      if (most == nullptr || choice.demand > most->demand) most = &choice;
    }
    if (names.empty()) continue;
    texts.push_back(fmt::format("{}: {}", on ? "on" : "off", listed(names)));
    if (most->demand == 0.0) continue;
    texts.back() += fmt::format(" ({}{:.2g} times the tolerance: {}, t = {:.6g}{})", on ? "" : "at most ", most->demand,
                                most->body, most->time, after_time(units));
  }
  return fmt::format("{} {}", effect, join(texts, "; "));
}

nlohmann::ordered_json automatic_json(const RunReport& report) {
  auto list = nlohmann::ordered_json::array();
  for (const ChosenEffect& choice : report.automatic)
    list.push_back({{"effect", choice.effect},
                    {"body", choice.body},
                    {"on", choice.on},
                    {"demand", choice.demand},
                    {"time", choice.time}});
  return list;
}

double relative_balance(const RunReport& report) {
  return report.energy_reference > 0.0 ? report.largest_balance / report.energy_reference : 0.0;
}

/// Whether the report has an energy balance. Work is counted in dynamics only, and the balance at stored instants only.
bool has_balance(const RunReport& report) {
  return report.analysis == formats::AnalysisKind::dynamics && report.rows > 0;
}

nlohmann::ordered_json solver_json(const RunReport& report) {
  const SolverHealth& health = report.solver_health;
  return {{"name", report.solver},
          {"unknowns", report.unknowns},
          {"nonzeros", report.nonzeros},
          {"least_reciprocal_condition", health.reciprocal_condition},
          {"least_reciprocal_pivot_growth", health.reciprocal_growth},
          {"largest_backward_error", health.backward_error},
          {"largest_fill", health.fill},
          {"refined_solutions", health.refined}};
}

nlohmann::ordered_json preflight_json(const Preflight& preflight) {
  nlohmann::ordered_json json;
  json["open_joints"] = nlohmann::ordered_json::array();
  for (const JointGap& gap : preflight.gaps)
    json["open_joints"].push_back({{"joint", gap.joint}, {"length", gap.length}, {"angle", gap.angle}});
  json["connected_groups"] = preflight.groups;
  json["doubts"] = preflight.doubts;
  return json;
}

}  // namespace

std::string report_json(const RunReport& report) {
  nlohmann::ordered_json json;
  json["outcome"] = outcome_name(report.outcome);
  json["reason"] = report.reason;
  json["time"] = report.time;
  json["steps"] = report.steps;
  json["iterations"] = report.iterations;
  json["factorisations"] = report.factorisations;
  json["choices_of_constraint_rows"] = report.row_choices;
  json["rejected_steps"] = report.rejected;
  json["rejected_for_accuracy"] = report.inaccurate;
  json["least_step"] = report.least_step;
  json["greatest_step"] = report.greatest_step;
  json["rejections"] = report.rejections;
  json["largest_constraint_violation"] = report.largest_constraint;
  json["stored_instants"] = report.rows;
  if (has_balance(report))
    json["energy"] = {{"balance", report.balance},
                      {"largest_balance", report.largest_balance},
                      {"reference", report.energy_reference},
                      {"largest_relative_balance", relative_balance(report)}};
  json["reactions_not_unique"] = report.not_unique;
  json["mobility"] = {{"coordinates", report.mobility.coordinates},
                      {"constraints", report.mobility.constraints},
                      {"rank", report.mobility.rank},
                      {"degrees_of_freedom", report.mobility.degrees_of_freedom},
                      {"bodies", report.mobility.parts},
                      {"gruebler", report.mobility.gruebler()},
                      {"rigid_mobility", report.mobility.rigid_mobility}};
  json["preflight"] = preflight_json(report.preflight);
  json["initial_correction"] = {{"position", report.projection.position}, {"velocity", report.projection.velocity}};
  json["linear_solver"] = solver_json(report);
  json["doubts"] = report.doubts;
  json["effects"] = report.effects;
  json["switches"] = report.switches;
  if (!report.automatic.empty()) {
    json["automatic"] = automatic_json(report);
    json["automatic_tolerance"] = report.tolerance;
    json["repeated_steps"] = report.repeated;
  }
  json["notes"] = report.notes;
  if (!report.table.empty()) json["table"] = {{"title", report.table_title}, {"lines", report.table}};
  const auto before = nlohmann::ordered_json::parse(report.before, nullptr, false);
  if (before.is_object() && !before.empty()) json["before"] = before;
  json["seconds"] = {{"model", report.seconds_model},
                     {"start", report.seconds_start},
                     {"steps", report.seconds_steps},
                     {"output", report.seconds_output}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);  // file names may be no UTF-8
}

std::string report_text(const RunReport& report, const Units& units) {
  std::string text;
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<16} {}\n", name, value);
  };
  for (const std::string& note : report.notes) line("note", note);
  line("model", join(report.effects, ", "));
  line("effects", report.switches);
  if (report.tolerance > 0.0)
    line("auto", fmt::format("tolerance {:.6g}{}", report.tolerance,
                             report.automatic.empty() ? ": the run chooses the effects" : ""));
  std::vector<std::string> reported;
  for (const ChosenEffect& choice : report.automatic) {
    if (std::ranges::count(reported, choice.effect) > 0) continue;
    reported.push_back(choice.effect);
    line("auto", choice_text(report, choice.effect, units));
  }
  line("mobility", fmt::format("{} degrees of freedom: {} coordinates, {} constraints of rank {}",
                               report.mobility.degrees_of_freedom, report.mobility.coordinates,
                               report.mobility.constraints, report.mobility.rank));
  for (const PreflightLine& row : report.steps == 0 ? preflight_table(report.preflight, report.mobility, units)
                                                    : preflight_doubts(report.preflight, units))
    line(row.name.c_str(), row.value);
  line("solver", fmt::format("{}, {} unknowns, {} nonzeros", report.solver, report.unknowns, report.nonzeros));
  if (report.steps == 0 && report.outcome == RunOutcome::completed) return text;
  line("outcome", report.reason.empty() ? outcome_name(report.outcome)
                                        : fmt::format("{}: {}", outcome_name(report.outcome), report.reason));
  line("reached", fmt::format("t = {:.6g}{}", report.time, after_time(units)));
  line("steps",
       fmt::format("{} ({} rejected{}), {} iterations, {} factorisations", report.steps, report.rejected,
                   report.repeated > 0 ? fmt::format(", {} in runs repeated with more effects", report.repeated) : "",
                   report.iterations, report.factorisations));
  constexpr std::size_t shown = 3;
  for (std::size_t i = 0; i < std::min(shown, report.rejections.size()); ++i) line("rejected", report.rejections[i]);
  if (report.rejected > static_cast<long>(shown) && !report.rejections.empty())
    line("", fmt::format("and {} more; the report in the results file lists the first {}",
                         report.rejected - static_cast<long>(shown), report.rejections.size()));
  if (has_balance(report))
    line("energy", fmt::format("largest balance error {:.2e} of the largest energy or work, at stored instants",
                               relative_balance(report)));
  line("constraints", fmt::format("largest violation {:.2e}", report.largest_constraint));
  const SolverHealth& health = report.solver_health;
  line("conditioning",
       fmt::format("least reciprocal condition {:.1e}, pivot growth {:.1e}, backward error {:.1e}, {} "
                   "solutions refined{}",
                   health.reciprocal_condition, health.reciprocal_growth, health.backward_error, health.refined,
                   health.fill > 0.0 ? fmt::format(", largest fill {:.2g}", health.fill) : ""));
  if (!report.table.empty()) text += fmt::format("  {}\n", report.table_title);
  for (const std::string& row : report.table) text += fmt::format("    {}\n", row);
  line("seconds", fmt::format("{:.3f} model, {:.3f} start, {:.3f} steps, {:.3f} output", report.seconds_model,
                              report.seconds_start, report.seconds_steps, report.seconds_output));
  for (const std::string& doubt : report.doubts) line("warning", doubt);
  return text;
}

void drop_reported_notes(RunReport& report, std::vector<std::string>& reported) {
  const std::vector<std::string> before = reported;
  for (const std::string& note : report.scene_notes)
    if (std::ranges::find(before, note) == before.end())
      reported.push_back(note);
    else
      std::erase(report.notes, note);
}

}  // namespace tisserand::mechanism
