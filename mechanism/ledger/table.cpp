// SPDX-License-Identifier: GPL-3.0-or-later
// Text and JSON of a ledger.
#include "mechanism/ledger/table.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tisserand::mechanism {
namespace {

std::string changes_text(const LedgerLine& line) {
  if (line.changes.empty()) return "no measured quantity";
  return fmt::format("{} by {}", line.changes.front().of, percent_text(line.changes.front().part));
}

std::string cost_text(double cost) {
  return fmt::format("{} {:.0f} % per step", cost < 0.0 ? "save" : "cost", 100.0 * std::abs(cost));
}

/// Reason without its part in brackets. The JSON has the whole.
std::string without_details(const std::string& reason) { return reason.substr(0, reason.find(" (")); }

std::string line_text(const LedgerLine& line) {
  const Toggle& toggle = line.toggle;
  std::string text = fmt::format("{}: {}; ", toggle.subject(), toggle.is);
  if (!line.replayed)
    text += line.failure.empty() ? "not tried" : fmt::format("'{}' cannot be tried: {}", toggle.becomes, line.failure);
  else
    text += fmt::format("{}{} would change {}{}, {}", toggle.becomes,
                        toggle.with.empty() ? "" : fmt::format(" (with {})", toggle.with), changes_text(line),
                        line.whole_run ? " in the whole run" : "", cost_text(line.cost));
  if (line.replayed && !line.failure.empty()) text += fmt::format("; ended early: {}", without_details(line.failure));
  if (line.activity) text += fmt::format("; activity {}", percent_text(line.share));
  return text;
}

nlohmann::ordered_json line_json(const LedgerLine& line) {
  const Toggle& toggle = line.toggle;
  nlohmann::ordered_json json{{"effect", toggle.effect},   {"of", toggle.owner},  {"is", toggle.is},
                              {"becomes", toggle.becomes}, {"with", toggle.with}, {"replayed", line.replayed}};
  json["changes"] = nlohmann::ordered_json::array();
  for (const LedgerChange& change : line.changes) json["changes"].push_back({{"of", change.of}, {"part", change.part}});
  json["whole_run"] = line.whole_run;
  if (line.replayed) json["cost_per_step"] = line.cost;
  if (line.toggle.effect == inertia_word && line.replayed) json["differs_from_F"] = line.from_best;
  if (line.activity) {
    json["activity"] = *line.activity;
    json["activity_share"] = line.share;
  }
  if (!line.failure.empty()) json["failure"] = line.failure;
  return json;
}

}  // namespace

std::string percent_text(double part) {
  const double percent = 100.0 * part;
  if (percent == 0.0) return "0 %";
  if (percent < 1e-6) return "less than 1e-6 %";
  if (percent > 1e4) return "more than 10000 %";
  if (percent < 0.1) return fmt::format("{:.1g} %", percent);
  return percent < 99.5 ? fmt::format("{:.2g} %", percent) : fmt::format("{:.0f} %", percent);
}

std::string ledger_text(const Ledger& ledger, const Units& units) {
  const std::string time = unit_label(units, 0, 0, 1);
  std::string text =
      fmt::format("{} window{} of {:.4g}{}{}; {:.3g} µs of processor time per step, scatter of times {:.0f} %\n",
                  ledger.windows, ledger.windows == 1 ? "" : "s", ledger.window, time.empty() ? "" : " ", time,
                  1e6 * ledger.seconds_per_step, std::ceil(100.0 * ledger.scatter));
  for (const LedgerLine& line : ledger.lines) text += fmt::format("  {}\n", line_text(line));
  for (const std::string& verdict : ledger.verdicts) text += fmt::format("  {}\n", verdict);
  if (!ledger.doubt.empty()) text += fmt::format("  warning: {}\n", ledger.doubt);
  if (ledger.interrupted) text += "  interrupted: some effects are missing\n";
  return text;
}

std::string ledger_json(const Ledger& ledger) {
  nlohmann::ordered_json json{{"scene", ledger.scene},     {"windows", ledger.windows},
                              {"window", ledger.window},   {"seconds_per_step", ledger.seconds_per_step},
                              {"scatter", ledger.scatter}, {"interrupted", ledger.interrupted}};
  json["effects"] = nlohmann::ordered_json::array();
  for (const LedgerLine& line : ledger.lines) json["effects"].push_back(line_json(line));
  json["inertia"] = ledger.verdicts;
  if (!ledger.doubt.empty()) json["doubt"] = ledger.doubt;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace tisserand::mechanism
