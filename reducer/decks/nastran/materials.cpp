// SPDX-License-Identifier: GPL-3.0-or-later
// MAT cards of a Nastran deck: elastic matrices for properties.
#include "reducer/decks/nastran/materials.hpp"

#include <cmath>

#include <fmt/format.h>

#include "reducer/decks/nastran/model.hpp"

namespace tisserand::reducer {
namespace {

/// Reads MAT1. Two of E, G, NU give the third by E = 2 (1 + ν) G; of three given ones each is used in its own terms.
void read_mat1(CardFields& f, NastranMaterial& m) {
  const bool has_E = !f.blank(1), has_G = !f.blank(2), has_nu = !f.blank(3);
  m.E = f.real(1, "E", 0.0);
  m.G = f.real(2, "G", 0.0);
  m.nu = f.real(3, "NU", 0.0);
  m.density = f.real(4, "RHO", 0.0);
  if (!f.ok()) return;
  if (has_E && !has_G && has_nu) m.G = 0.5 * m.E / (1.0 + m.nu);
  if (has_E && has_G && !has_nu) m.nu = m.G != 0.0 ? 0.5 * m.E / m.G - 1.0 : 0.0;
  if (!has_E && has_G && has_nu) m.E = 2.0 * (1.0 + m.nu) * m.G;
  if (!(m.E > 0.0)) return f.fault(fmt::format("E {:g} must be positive", m.E), "give two of E, G and NU");
  if (!(m.G >= 0.0) || !(m.nu > -1.0) || !std::isfinite(m.G))
    return f.fault(fmt::format("E {:g}, G {:g}, NU {:g} are not consistent", m.E, m.G, m.nu),
                   "give G >= 0 and NU > -1");
  const double plane = m.E / (1.0 - m.nu * m.nu);
  m.Q << plane, m.nu * plane, 0.0, m.nu * plane, plane, 0.0, 0.0, 0.0, m.G;
  m.shear = m.G * Eigen::Matrix2d::Identity();
  m.ply = {m.E, m.E, m.nu, m.G, m.G, m.G, m.density, 0.0, 0.0};
}

void read_mat2(CardFields& f, NastranMaterial& m) {
  const double G11 = f.real(1, "G11", 0.0), G12 = f.real(2, "G12", 0.0), G13 = f.real(3, "G13", 0.0);
  const double G22 = f.real(4, "G22", 0.0), G23 = f.real(5, "G23", 0.0), G33 = f.real(6, "G33", 0.0);
  m.density = f.real(7, "RHO", 0.0);
  m.Q << G11, G12, G13, G12, G22, G23, G13, G23, G33;
  m.shear << G11, G12, G12, G22;
}

void read_mat8(CardFields& f, NastranMaterial& m) {
  const double E1 = f.real(1, "E1"), E2 = f.real(2, "E2"), nu12 = f.real(3, "NU12", 0.0), G12 = f.real(4, "G12", 0.0);
  const double G1z = f.real(5, "G1Z", 0.0), G2z = f.real(6, "G2Z", 0.0);
  m.density = f.real(7, "RHO", 0.0);
  if (!f.ok()) return;
  const double nu21 = nu12 * E2 / E1, d = 1.0 - nu12 * nu21;
  if (!(E1 > 0.0 && E2 > 0.0 && G12 >= 0.0 && d > 0.0))
    return f.fault(fmt::format("E1 {:g}, E2 {:g}, NU12 {:g}, G12 {:g} are not a stable material", E1, E2, nu12, G12),
                   "give E1, E2 > 0, G12 >= 0 and NU12² < E1/E2");
  m.Q << E1 / d, nu12 * E2 / d, 0.0, nu12 * E2 / d, E2 / d, 0.0, 0.0, 0.0, G12;
  m.shear << (G1z > 0.0 ? G1z : G12), 0.0, 0.0, (G2z > 0.0 ? G2z : G12);
  m.ply = {E1, E2, nu12, G12, m.shear(0, 0), m.shear(1, 1), m.density, 0.0, 0.0};
}

void read_mat9(CardFields& f, NastranMaterial& m) {
  int index = 1;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j, ++index) m.C(i, j) = m.C(j, i) = f.real(index, fmt::format("G{}{}", i + 1, j + 1), 0.0);
  m.density = f.real(index, "RHO", 0.0);
}

std::optional<NastranMaterial> read_material(NastranModel& model, std::size_t row) {
  CardFields f = model.card(row);
  NastranMaterial m;
  m.label = f.label();
  m.where = f.where();
  if (same_word(f.card().name, "MAT1")) {
    read_mat1(f, m);
  } else if (same_word(f.card().name, "MAT2")) {
    m.kind = NastranMaterial::Kind::plane;
    read_mat2(f, m);
  } else if (same_word(f.card().name, "MAT8")) {
    m.kind = NastranMaterial::Kind::orthotropic;
    read_mat8(f, m);
  } else {
    m.kind = NastranMaterial::Kind::solid;
    read_mat9(f, m);
  }
  if (f.ok() && m.density < 0.0) f.fault(fmt::format("RHO {:g} is negative", m.density), "give a density >= 0");
  m.density *= model.mass_scale;
  m.ply.density = m.density;
  return f.ok() ? std::optional(m) : std::nullopt;
}

}  // namespace

void index_materials(NastranModel& model) {
  for (const char* name : {"MAT1", "MAT2", "MAT8", "MAT9"})
    model.for_each(name, [&](CardFields& f) {
      const long id = f.id(0, "MID");
      if (id > 0 && !model.materials.card.emplace(id, model.row(f)).second)
        f.fault(fmt::format("material {} is defined twice", id), "remove one of the cards");
    });
}

const NastranMaterial* material_of(NastranModel& model, CardFields& property, long id, std::string_view name) {
  if (!property.ok()) return nullptr;
  const auto card = model.materials.card.find(id);
  if (card == model.materials.card.end()) {
    property.fault(fmt::format("{} names material {}, which is missing", name, id), "add a MAT1, MAT2, MAT8 or MAT9");
    return nullptr;
  }
  const auto [read, fresh] = model.materials.read.try_emplace(id);
  if (fresh) read->second = read_material(model, card->second);
  return read->second ? &*read->second : nullptr;
}

const NastranMaterial* material(NastranModel& model, CardFields& property, int index, std::string_view name) {
  const long id = property.id(index, name);
  return id > 0 ? material_of(model, property, id, name) : nullptr;
}

}  // namespace tisserand::reducer
