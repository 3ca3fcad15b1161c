// SPDX-License-Identifier: GPL-3.0-or-later
// Property cards of a Nastran deck: rows of properties of the mesh from their fields.
#include "reducer/decks/nastran/properties.hpp"

#include <numbers>

#include <fmt/format.h>

#include "reducer/decks/nastran/model.hpp"
#include "reducer/properties/solid_anisotropic.hpp"

namespace tisserand::reducer {
namespace {

template <class Read>
void index_cards(NastranModel& model, PropertyCards<Read>& cards) {
  for (const std::string& name : cards.names)
    model.for_each(name, [&](CardFields& f) {
      const long id = f.id(0, "PID");
      if (id > 0 && !cards.card.emplace(id, model.row(f)).second)
        f.fault(fmt::format("property {} is defined twice", id), "remove one of the cards");
    });
}

/// Result of read(card) for the property, cached; a default value with a fault of the element if the card is missing.
template <class Read, class Reader>
const Read& read_once(NastranModel& model, CardFields& element, PropertyCards<Read>& cards,
                      const std::pair<long, double>& key, const Reader& read) {
  static const Read none{};
  const auto known = cards.read.find(key);
  if (known != cards.read.end()) return known->second;
  if (!element.ok()) return none;
  const auto found = cards.card.find(key.first);
  if (found != cards.card.end()) {
    CardFields card = model.card(found->second);
    return cards.read[key] = read(card);
  }
  element.fault(fmt::format("PID names property {}, which is missing", key.first), "add a " + cards.kinds);
  return none;
}

/// Reads PELAS with two springs per card: PID, K, GE, S.
void read_pelas(NastranModel& model) {
  model.for_each("PELAS", [&](CardFields& f) {
    for (const int start : {0, 4}) {
      if (start > 0 && f.blank(start)) continue;
      const long id = f.id(start, "PID");
      ElasticProperty property;
      property.stiffness = f.real(start + 1, "K", 0.0);
      if (f.ok() && !model.properties.elastic.emplace(id, property).second)
        f.fault(fmt::format("property {} is defined twice", id), "remove one of the cards");
    }
  });
}

/// Reads PROD or PTUBE.
int read_rod(NastranModel& model, CardFields& f) {
  RodConstants rod;
  if (same_word(f.card().name, "PROD")) {
    rod = {f.real(2, "A"), f.real(3, "J", 0.0), f.real(5, "NSM", 0.0)};
  } else {
    const double outer = f.real(2, "OD"), thickness = f.real(3, "T", 0.5 * outer);
    if (f.real(5, "OD2", outer) != outer)
      f.fault("tubes with OD2 are not understood", "use CBEAM with a tapered PBEAM");
    if (f.ok() && !(thickness > 0.0 && thickness <= 0.5 * outer))
      f.fault(fmt::format("T {:g} must lie between 0 and OD/2 = {:g}", thickness, 0.5 * outer), "correct OD or T");
    const double inner = outer - 2.0 * thickness, a = outer * outer, b = inner * inner;
    rod = {0.25 * std::numbers::pi * (a - b), std::numbers::pi / 32.0 * (a * a - b * b), f.real(4, "NSM", 0.0)};
  }
  return add_rod_property(model, f, 1, rod);
}

/// Axes of the material of a solid: CORDM 0 is the basic system.
std::optional<Eigen::Matrix3d> solid_axes(NastranModel& model, CardFields& f) {
  const long id = f.integer(2, "CORDM", 0);
  if (id == 0 || !f.ok()) return Eigen::Matrix3d::Identity();
  if (id < 0)
    return f.refuse("CORDM -1 (material axes that follow each element) is not understood", "name a CORD2R system");
  const int row = model.frames.find(id);
  if (row < 0)
    return f.refuse(fmt::format("CORDM names coordinate system {}, which is missing", id), "add its CORD card");
  const NastranFrame& frame = model.frames.frames[row];
  if (frame.kind != FrameKind::rectangular)
    return f.refuse(fmt::format("CORDM {}: a solid with MAT9 needs a rectangular system", id), "name a CORD2R system");
  return frame.axes;
}

int read_solid(NastranModel& model, CardFields& f) {
  const NastranMaterial* m = material(model, f, 1, "MID");
  if (m == nullptr) return -1;
  if (same_word(f.text(6), "PFLUID")) f.fault("fluids are not understood", "remove the fluid");
  SolidProperty property;
  property.mass_matrix = model.mass_matrix;
  property.name = f.label();
  if (m->kind == NastranMaterial::Kind::isotropic) {
    if (!(m->nu > -1.0 && m->nu < 0.5) || !(m->G > 0.0))
      f.fault(fmt::format("{} has NU {:g} and G {:g}", m->label, m->nu, m->G), "solids need NU between -1 and 0.5");
    else
      property.material = isotropic_solid(m->E, m->nu, m->density);
  } else if (m->kind == NastranMaterial::Kind::solid) {
    const std::optional<Eigen::Matrix3d> axes = solid_axes(model, f);
    if (axes) try {
        property.material = anisotropic_solid(m->C, *axes, m->density, m->where);
      } catch (const Error& error) {
        f.fault(fmt::format("{}: {}", m->label, error.message()), error.remedy());
      }
  } else {
    f.fault(fmt::format("{} is not a material for solids", m->label), "use MAT1 or MAT9");
  }
  if (!f.ok()) return -1;
  return add_row(model.deck.mesh.solid_properties, property);
}

/// Reads lines of "K", "B", "GE", "RCV", "M", each with six values.
std::optional<BushProperty> read_bush(CardFields& f) {
  BushProperty property;
  for (int line = 0; line < f.size(); line += 8) {
    if (!same_word(f.text(line + 1), "K")) continue;
    for (int i = 0; i < 6; ++i)
      property.stiffness(i) = same_word(f.text(line + 2 + i), "RIGID") ? 0.0 : f.real(line + 2 + i, "K", 0.0);
    for (int i = 0; i < 6; ++i)
      if (same_word(f.text(line + 2 + i), "RIGID")) f.fault("RIGID stiffness is not understood", "use RBE2 or RBAR");
  }
  if (f.ok() && !(property.stiffness.minCoeff() >= 0.0)) f.fault("a stiffness K is negative", "give K >= 0");
  return f.ok() ? std::optional(property) : std::nullopt;
}

}  // namespace

void index_properties(NastranModel& model) {
  NastranProperties& p = model.properties;
  index_cards(model, p.beam);
  index_cards(model, p.rod);
  index_cards(model, p.shell);
  index_cards(model, p.solid);
  index_cards(model, p.bush);
  read_pelas(model);
}

int beam_property(NastranModel& model, CardFields& element, long id) {
  const auto read = [&](CardFields& card) { return PropertyRow{read_beam_property(model, card)}; };
  return read_once(model, element, model.properties.beam, {id, 0.0}, read).row;
}

int rod_property(NastranModel& model, CardFields& element, long id) {
  const auto read = [&](CardFields& card) { return PropertyRow{read_rod(model, card)}; };
  return read_once(model, element, model.properties.rod, {id, 0.0}, read).row;
}

PropertyRow shell_property(NastranModel& model, CardFields& element, long id, double thickness) {
  const auto read = [&](CardFields& card) { return read_shell_property(model, card, thickness); };
  return read_once(model, element, model.properties.shell, {id, thickness}, read);
}

int solid_property(NastranModel& model, CardFields& element, long id) {
  const auto read = [&](CardFields& card) { return PropertyRow{read_solid(model, card)}; };
  return read_once(model, element, model.properties.solid, {id, 0.0}, read).row;
}

const BushProperty* bush_property(NastranModel& model, CardFields& element, long id) {
  const auto& read = read_once(model, element, model.properties.bush, {id, 0.0}, read_bush);
  return read ? &*read : nullptr;
}

}  // namespace tisserand::reducer
