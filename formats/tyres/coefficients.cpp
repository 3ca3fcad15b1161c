// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the coefficients, by sections of a file.
#include "formats/tyres/coefficients.hpp"

#include <vector>

namespace tisserand::formats {
namespace {

constexpr Coefficient with_units[] = {
    {"UNLOADED_RADIUS", &MagicFormula::UNLOADED_RADIUS, Versions::both, Quantity::length},
    {"FNOMIN", &MagicFormula::FNOMIN, Versions::both, Quantity::force},
    {"VERTICAL_STIFFNESS", &MagicFormula::VERTICAL_STIFFNESS, Versions::both, Quantity::stiffness},
    {"VERTICAL_DAMPING", &MagicFormula::VERTICAL_DAMPING, Versions::both, Quantity::damping},
    {"LONGVL", &MagicFormula::LONGVL, Versions::both, Quantity::speed},
    {"VXLOW", &MagicFormula::VXLOW, Versions::both, Quantity::speed},
    {"FZMIN", &MagicFormula::FZMIN, Versions::both, Quantity::force},
    {"FZMAX", &MagicFormula::FZMAX, Versions::both, Quantity::force},
    {"LONGITUDINAL_STIFFNESS", &MagicFormula::LONGITUDINAL_STIFFNESS, Versions::only_6_1, Quantity::stiffness},
    {"LATERAL_STIFFNESS", &MagicFormula::LATERAL_STIFFNESS, Versions::only_6_1, Quantity::stiffness},
    {"NOMPRES", &MagicFormula::NOMPRES, Versions::only_6_1, Quantity::pressure},
    {"INFLPRES", &MagicFormula::INFLPRES, Versions::only_6_1, Quantity::pressure},
    {"PRESMIN", &MagicFormula::PRESMIN, Versions::only_6_1, Quantity::pressure},
    {"PRESMAX", &MagicFormula::PRESMAX, Versions::only_6_1, Quantity::pressure}};

/// Coefficients without a unit.
struct Number {
  const char* name;
  double MagicFormula::*value;
};
constexpr Number numbers[] = {
    {"LFZO", &MagicFormula::LFZO},     {"LCX", &MagicFormula::LCX},       {"LMUX", &MagicFormula::LMUX},
    {"LEX", &MagicFormula::LEX},       {"LKX", &MagicFormula::LKX},       {"LHX", &MagicFormula::LHX},
    {"LVX", &MagicFormula::LVX},       {"LCY", &MagicFormula::LCY},       {"LMUY", &MagicFormula::LMUY},
    {"LEY", &MagicFormula::LEY},       {"LKY", &MagicFormula::LKY},       {"LHY", &MagicFormula::LHY},
    {"LVY", &MagicFormula::LVY},       {"LTR", &MagicFormula::LTR},       {"LRES", &MagicFormula::LRES},
    {"LXAL", &MagicFormula::LXAL},     {"LYKA", &MagicFormula::LYKA},     {"LVYKA", &MagicFormula::LVYKA},
    {"LS", &MagicFormula::LS},         {"LMX", &MagicFormula::LMX},       {"LVMX", &MagicFormula::LVMX},
    {"LMY", &MagicFormula::LMY},       {"LSGKP", &MagicFormula::LSGKP},   {"LSGAL", &MagicFormula::LSGAL},
    {"BREFF", &MagicFormula::BREFF},   {"DREFF", &MagicFormula::DREFF},   {"FREFF", &MagicFormula::FREFF},
    {"PCX1", &MagicFormula::PCX1},     {"PDX1", &MagicFormula::PDX1},     {"PDX2", &MagicFormula::PDX2},
    {"PDX3", &MagicFormula::PDX3},     {"PEX1", &MagicFormula::PEX1},     {"PEX2", &MagicFormula::PEX2},
    {"PEX3", &MagicFormula::PEX3},     {"PEX4", &MagicFormula::PEX4},     {"PKX1", &MagicFormula::PKX1},
    {"PKX2", &MagicFormula::PKX2},     {"PKX3", &MagicFormula::PKX3},     {"PHX1", &MagicFormula::PHX1},
    {"PHX2", &MagicFormula::PHX2},     {"PVX1", &MagicFormula::PVX1},     {"PVX2", &MagicFormula::PVX2},
    {"RBX1", &MagicFormula::RBX1},     {"RBX2", &MagicFormula::RBX2},     {"RCX1", &MagicFormula::RCX1},
    {"REX1", &MagicFormula::REX1},     {"REX2", &MagicFormula::REX2},     {"RHX1", &MagicFormula::RHX1},
    {"PTX1", &MagicFormula::PTX1},     {"PTX2", &MagicFormula::PTX2},     {"PTX3", &MagicFormula::PTX3},
    {"PCY1", &MagicFormula::PCY1},     {"PDY1", &MagicFormula::PDY1},     {"PDY2", &MagicFormula::PDY2},
    {"PDY3", &MagicFormula::PDY3},     {"PEY1", &MagicFormula::PEY1},     {"PEY2", &MagicFormula::PEY2},
    {"PEY3", &MagicFormula::PEY3},     {"PEY4", &MagicFormula::PEY4},     {"PKY1", &MagicFormula::PKY1},
    {"PKY2", &MagicFormula::PKY2},     {"PKY3", &MagicFormula::PKY3},     {"PHY1", &MagicFormula::PHY1},
    {"PHY2", &MagicFormula::PHY2},     {"PVY1", &MagicFormula::PVY1},     {"PVY2", &MagicFormula::PVY2},
    {"PVY3", &MagicFormula::PVY3},     {"PVY4", &MagicFormula::PVY4},     {"RBY1", &MagicFormula::RBY1},
    {"RBY2", &MagicFormula::RBY2},     {"RBY3", &MagicFormula::RBY3},     {"RCY1", &MagicFormula::RCY1},
    {"REY1", &MagicFormula::REY1},     {"REY2", &MagicFormula::REY2},     {"RHY1", &MagicFormula::RHY1},
    {"RHY2", &MagicFormula::RHY2},     {"RVY1", &MagicFormula::RVY1},     {"RVY2", &MagicFormula::RVY2},
    {"RVY3", &MagicFormula::RVY3},     {"RVY4", &MagicFormula::RVY4},     {"RVY5", &MagicFormula::RVY5},
    {"RVY6", &MagicFormula::RVY6},     {"PTY1", &MagicFormula::PTY1},     {"PTY2", &MagicFormula::PTY2},
    {"QSX1", &MagicFormula::QSX1},     {"QSX2", &MagicFormula::QSX2},     {"QSX3", &MagicFormula::QSX3},
    {"QSY1", &MagicFormula::QSY1},     {"QSY2", &MagicFormula::QSY2},     {"QSY3", &MagicFormula::QSY3},
    {"QSY4", &MagicFormula::QSY4},     {"QBZ1", &MagicFormula::QBZ1},     {"QBZ2", &MagicFormula::QBZ2},
    {"QBZ3", &MagicFormula::QBZ3},     {"QBZ4", &MagicFormula::QBZ4},     {"QBZ5", &MagicFormula::QBZ5},
    {"QBZ9", &MagicFormula::QBZ9},     {"QBZ10", &MagicFormula::QBZ10},   {"QCZ1", &MagicFormula::QCZ1},
    {"QDZ1", &MagicFormula::QDZ1},     {"QDZ2", &MagicFormula::QDZ2},     {"QDZ3", &MagicFormula::QDZ3},
    {"QDZ4", &MagicFormula::QDZ4},     {"QDZ6", &MagicFormula::QDZ6},     {"QDZ7", &MagicFormula::QDZ7},
    {"QDZ8", &MagicFormula::QDZ8},     {"QDZ9", &MagicFormula::QDZ9},     {"QEZ1", &MagicFormula::QEZ1},
    {"QEZ2", &MagicFormula::QEZ2},     {"QEZ3", &MagicFormula::QEZ3},     {"QEZ4", &MagicFormula::QEZ4},
    {"QEZ5", &MagicFormula::QEZ5},     {"QHZ1", &MagicFormula::QHZ1},     {"QHZ2", &MagicFormula::QHZ2},
    {"QHZ3", &MagicFormula::QHZ3},     {"QHZ4", &MagicFormula::QHZ4},     {"SSZ1", &MagicFormula::SSZ1},
    {"SSZ2", &MagicFormula::SSZ2},     {"SSZ3", &MagicFormula::SSZ3},     {"SSZ4", &MagicFormula::SSZ4},
    {"KPUMIN", &MagicFormula::KPUMIN}, {"KPUMAX", &MagicFormula::KPUMAX}, {"ALPMIN", &MagicFormula::ALPMIN},
    {"ALPMAX", &MagicFormula::ALPMAX}, {"CAMMIN", &MagicFormula::CAMMIN}, {"CAMMAX", &MagicFormula::CAMMAX}};
constexpr Number numbers_of_5_2[] = {{"LGAX", &MagicFormula::LGAX},
                                     {"LGAY", &MagicFormula::LGAY},
                                     {"LGAZ", &MagicFormula::LGAZ},
                                     {"PHY3", &MagicFormula::PHY3}};
constexpr Number numbers_of_6_1[] = {
    {"LKYC", &MagicFormula::LKYC},   {"LKZC", &MagicFormula::LKZC},   {"PFZ1", &MagicFormula::PFZ1},
    {"PPX1", &MagicFormula::PPX1},   {"PPX2", &MagicFormula::PPX2},   {"PPX3", &MagicFormula::PPX3},
    {"PPX4", &MagicFormula::PPX4},   {"RBX3", &MagicFormula::RBX3},   {"PCFX1", &MagicFormula::PCFX1},
    {"PCFX2", &MagicFormula::PCFX2}, {"PCFX3", &MagicFormula::PCFX3}, {"PEY5", &MagicFormula::PEY5},
    {"PKY4", &MagicFormula::PKY4},   {"PKY5", &MagicFormula::PKY5},   {"PKY6", &MagicFormula::PKY6},
    {"PKY7", &MagicFormula::PKY7},   {"PPY1", &MagicFormula::PPY1},   {"PPY2", &MagicFormula::PPY2},
    {"PPY3", &MagicFormula::PPY3},   {"PPY4", &MagicFormula::PPY4},   {"PPY5", &MagicFormula::PPY5},
    {"RBY4", &MagicFormula::RBY4},   {"PCFY1", &MagicFormula::PCFY1}, {"PCFY2", &MagicFormula::PCFY2},
    {"PCFY3", &MagicFormula::PCFY3}, {"QSX4", &MagicFormula::QSX4},   {"QSX5", &MagicFormula::QSX5},
    {"QSX6", &MagicFormula::QSX6},   {"QSX7", &MagicFormula::QSX7},   {"QSX8", &MagicFormula::QSX8},
    {"QSX9", &MagicFormula::QSX9},   {"QSX10", &MagicFormula::QSX10}, {"QSX11", &MagicFormula::QSX11},
    {"QSX12", &MagicFormula::QSX12}, {"QSX13", &MagicFormula::QSX13}, {"QSX14", &MagicFormula::QSX14},
    {"PPMX1", &MagicFormula::PPMX1}, {"QSY5", &MagicFormula::QSY5},   {"QSY6", &MagicFormula::QSY6},
    {"QSY7", &MagicFormula::QSY7},   {"QSY8", &MagicFormula::QSY8},   {"QDZ10", &MagicFormula::QDZ10},
    {"QDZ11", &MagicFormula::QDZ11}, {"PPZ1", &MagicFormula::PPZ1},   {"PPZ2", &MagicFormula::PPZ2},
    {"Q_FZ1", &MagicFormula::QFZ1},  {"Q_FZ2", &MagicFormula::QFZ2}};

std::vector<Coefficient> all_coefficients() {
  std::vector<Coefficient> all(std::begin(with_units), std::end(with_units));
  const auto add = [&all](std::span<const Number> list, Versions versions) {
    for (const Number& number : list) all.push_back({number.name, number.value, versions});
  };
  add(numbers, Versions::both);
  add(numbers_of_5_2, Versions::only_5_2);
  add(numbers_of_6_1, Versions::only_6_1);
  return all;
}

}  // namespace

std::span<const Coefficient> tyre_coefficients() {
  static const std::vector<Coefficient> all = all_coefficients();
  return all;
}

}  // namespace tisserand::formats
