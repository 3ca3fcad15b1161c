// SPDX-License-Identifier: GPL-3.0-or-later
// Cards of a Nastran deck by name: those that build the mesh, those that do not belong to a superelement, and
// unsupported ones.
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/text.hpp"
#include "reducer/decks/nastran/model.hpp"

namespace tisserand::reducer {
namespace {

/// Cards that build the mesh.
const std::set<std::string>& understood() {
  static const std::set<std::string> names{
      "GRID", "GRDSET", "CORD1R", "CORD1C", "CORD1S", "CORD2R", "CORD2C", "CORD2S", "CBAR",   "CBEAM",
      "CROD", "CONROD", "CTUBE",  "CQUAD4", "CQUADR", "CTRIA3", "CTRIAR", "CTETRA", "CHEXA",  "CPENTA",
      "PBAR", "PBARL",  "PBEAM",  "PBEAML", "PROD",   "PTUBE",  "PSHELL", "PCOMP",  "PSOLID", "MAT1",
      "MAT2", "MAT8",   "MAT9",   "CONM2",  "CELAS1", "CELAS2", "PELAS",  "CBUSH",  "PBUSH",  "RBE1",
      "RBE2", "RBE3",   "RBAR",   "MPC",    "ASET",   "ASET1",  "BSET",   "BSET1",  "BNDFIX", "BNDFIX1",
      "SPC",  "SPC1",   "PARAM",  "BAROR",  "BEAMOR", "SPCADD", "MPCADD"};
  return names;
}

/// Cards of analysis, loads and sets, which a reduction does not need: a remark, never an error.
const std::set<std::string>& left_out() {
  static const std::set<std::string> names{
      "EIGR",    "EIGRL",   "EIGB",   "EIGC",   "EIGP",   "FORCE",   "FORCE1",  "FORCE2",  "MOMENT",
      "MOMENT1", "MOMENT2", "PLOAD",  "PLOAD1", "PLOAD2", "PLOAD4",  "PLOADX1", "GRAV",    "ACCEL",
      "ACCEL1",  "RFORCE",  "LOAD",   "TEMP",   "TEMPD",  "TEMPP1",  "TEMPRB",  "DLOAD",   "DAREA",
      "LSEQ",    "RLOAD1",  "RLOAD2", "TLOAD1", "TLOAD2", "TABLED1", "TABLED2", "TABLED3", "TABDMP1",
      "FREQ",    "FREQ1",   "FREQ2",  "FREQ3",  "FREQ4",  "TSTEP",   "QSET",    "QSET1",   "SPOINT",
      "SET1",    "SET3",    "PLOTEL", "DTI",    "SUPORT", "SUPORT1"};
  return names;
}

void read_mass_parameters(NastranModel& model) {
  model.for_each("PARAM", [&](CardFields& f) {
    if (same_word(f.text(0), "WTMASS")) {
      model.mass_scale = f.real(1, "WTMASS");
      if (f.ok() && !(model.mass_scale > 0.0))
        f.fault(fmt::format("{:g} must be positive", model.mass_scale), "give a value > 0");
    } else if (same_word(f.text(0), "COUPMASS")) {
      const long value = f.integer(1, "COUPMASS", -1);
      model.mass_matrix = value > 0 ? formats::MassMatrix::consistent : formats::MassMatrix::lumped;
    } else {
      model.remarks.add("PARAM cards without effect on the mesh are ignored", capitals(f.text(0)));
    }
  });
}

/// Number of fields of cards after which none may follow, from the manuals.
const std::map<std::string, int>& field_count() {
  static const std::map<std::string, int> counts{{"GRID", 8},    {"CBAR", 16},   {"CROD", 8},   {"CONROD", 8},
                                                 {"CELAS1", 6},  {"CELAS2", 8},  {"CONM2", 14}, {"PROD", 6},
                                                 {"PBAR", 19},   {"PSHELL", 11}, {"MAT1", 12},  {"RBAR", 8},
                                                 {"CORD2R", 11}, {"CORD2C", 11}, {"CORD2S", 11}};
  return counts;
}

void report_extra_fields(NastranModel& model) {
  for (const auto& [name, count] : field_count())
    model.for_each(name, [&, most = count](CardFields& f) {
      for (int i = most; i < f.size(); ++i)
        if (!f.blank(i))
          model.remarks.add("values in fields that the card does not have are ignored",
                            fmt::format("{} (line {}, field {}: '{}')", f.label(), i / 8 + 1, i % 8 + 2, f.text(i)));
    });
}

void judge_unknown(const std::map<std::string, std::size_t>& unknown, const std::string& where,
                   const DeckOptions& options, NastranModel& model) {
  if (unknown.empty()) return;
  std::vector<std::string> names;
  for (const auto& [name, count] : unknown) names.push_back(fmt::format("{} ({})", name, count));
  const std::string text = "cards that are not understood: " + listed(names);
  if (options.unknown == UnknownCards::ignore)
    model.deck.mesh.warnings.push_back(text);
  else
    model.faults.add(text, where, "remove them, or write `unknown: ignore` under mesh if the part does not need them");
}

}  // namespace

void sort_cards(const DeckOptions& options, NastranModel& model) {
  std::map<std::string, std::size_t> unknown, other;
  std::string where;
  std::string_view last_name;
  std::vector<std::size_t>* last_rows = nullptr;
  for (std::size_t i = 0; i < model.cards.cards.size(); ++i) {
    const NastranCard& card = model.cards.cards[i];
    if (last_rows == nullptr || card.name != last_name) {
      last_name = card.name;
      const std::string name = capitals(card.name);
      last_rows = nullptr;
      if (understood().contains(name)) {
        last_rows = &model.rows[name];
      } else if (left_out().contains(name)) {
        ++other[name];
      } else {
        if (unknown.empty()) where = model.cards.where(card);
        ++unknown[name];
      }
    }
    if (last_rows != nullptr) last_rows->push_back(i);
  }
  for (const auto& [name, count] : other)
    model.remarks.add("cards without effect on stiffness and mass are ignored", fmt::format("{} ({})", name, count));
  judge_unknown(unknown, where, options, model);
  read_mass_parameters(model);
  report_extra_fields(model);
}

bool NastranModel::holds(CardFields& fields, const std::string& kind) {
  if (!cards.has_case_control) return true;
  const std::set<std::string>& selected = cards.selected[kind];
  const std::string set(fields.text(0));
  bool found = selected.contains(set);
  for_each(kind + "ADD", [&](CardFields& f) {
    if (!selected.contains(std::string(f.text(0)))) return;
    for (int i = 1; i < f.size(); ++i) found = found || f.text(i) == set;
  });
  if (!found && reported.insert(kind + set).second)
    remarks.add(fmt::format("sets of {} that case control does not select are ignored", kind), set);
  return found;
}

}  // namespace tisserand::reducer
