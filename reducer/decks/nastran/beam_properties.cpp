// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of beams from PBAR, PBARL, PBEAM, PBEAML and the constants of rods of a Nastran deck.
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "reducer/decks/nastran/model.hpp"
#include "reducer/properties/beam_taper.hpp"
#include "reducer/properties/pbarl.hpp"

namespace tisserand::reducer {
namespace {

/// Both ends of a beam, and the non-structural mass (before scaling by PARAM,WTMASS).
struct BeamSections {
  formats::Section first, second;
  bool tapered = false;  ///< false: `first` everywhere
  AddedMass added;
};

/// Material with E and G of the card, the only constants that beams use.
std::optional<formats::Material> beam_material(NastranModel& model, CardFields& f) {
  const NastranMaterial* m = material(model, f, 1, "MID");
  if (m == nullptr) return std::nullopt;
  if (m->kind != NastranMaterial::Kind::isotropic || !(m->G > 0.0))
    return f.refuse(fmt::format("{} gives no E and G", m->label), "beams need a MAT1 with two of E, G and NU");
  return formats::Material{m->label, m->E, 0.5 * m->E / m->G - 1.0, m->density, m->where};
}

void judge(CardFields& f, const formats::Section& s) {
  if (!f.ok()) return;
  const double Iy = s.second_moment_y, Iz = s.second_moment_z, Iyz = s.second_moment_yz;
  if (!(s.area > 0.0)) return f.fault(fmt::format("A {:g} must be positive", s.area), "give the area");
  if (!(Iy >= 0.0 && Iz >= 0.0 && s.torsion_constant >= 0.0))
    return f.fault(fmt::format("I1 {:g}, I2 {:g}, J {:g} must not be negative", Iz, Iy, s.torsion_constant),
                   "correct them");
  if (Iyz * Iyz > Iy * Iz)
    f.fault(fmt::format("I12 {:g} exceeds the square root of I1 I2, {:g}", Iyz, std::sqrt(Iy * Iz)), "correct I12");
}

/// Section of A, I1, I2 and so on: I1 = ∫y² dA bends in plane 1 (x-y), I2 = ∫z² dA in plane 2.
formats::Section constants(double A, double I1, double I2, double I12, double J) {
  formats::Section s;
  s.area = A;
  s.second_moment_y = I2;
  s.second_moment_z = I1;
  s.second_moment_yz = I12;
  s.torsion_constant = J;
  s.polar_moment = I1 + I2;
  return s;
}

/// Reads PBAR. Blank K1, K2: no shear flexibility, also if I12 is not zero (as in Nastran).
BeamSections read_pbar(CardFields& f) {
  const double A = f.real(2, "A"), I1 = f.real(3, "I1", 0.0), I2 = f.real(4, "I2", 0.0), J = f.real(5, "J", 0.0);
  const double K1 = f.real(16, "K1", 0.0), K2 = f.real(17, "K2", 0.0), I12 = f.real(18, "I12", 0.0);
  BeamSections b;
  b.first = constants(A, I1, I2, I12, J);
  if (I12 == 0.0) {
    b.first.shear_area_y = K1 * A;
    b.first.shear_area_z = K2 * A;
  }
  b.added.first = b.added.second = f.real(6, "NSM", 0.0);
  judge(f, b.first);
  return b;
}

/// Section of the sizes from field `start` on; faults for unknown types and invalid sizes.
std::optional<formats::Section> shaped(CardFields& f, const std::string& type, int start) {
  std::vector<double> sizes;
  for (int i = 0; i < pbarl_sizes(type); ++i) sizes.push_back(f.real(start + i, fmt::format("DIM{}", i + 1)));
  if (!f.ok()) return std::nullopt;
  try {
    return pbarl_section(type, sizes, f.where());
  } catch (const Error& error) {
    return f.refuse(error.message(), error.remedy());
  }
}

BeamSections read_pbarl(CardFields& f) {
  BeamSections b;
  const std::string type = capitals(f.text(3));
  const std::optional<formats::Section> section = shaped(f, type, 8);
  if (section) b.first = on_bar_axis(*section);
  b.added.first = b.added.second = f.real(8 + pbarl_sizes(type), "NSM", 0.0);
  return b;
}

bool is_station(std::string_view text) {
  return same_word(text, "YES") || same_word(text, "YESA") || same_word(text, "NO");
}

/// Reads stations of PBEAML: SO, X/XB, sizes, NSM; the one with X/XB = 1 is end B.
BeamSections read_pbeaml(NastranModel& model, CardFields& f) {
  BeamSections b;
  const std::string type = capitals(f.text(3));
  const int sizes = pbarl_sizes(type);
  const std::optional<formats::Section> first = shaped(f, type, 8);
  if (!first) return b;
  b.first = on_shear_axis(*first);
  b.added.first = b.added.second = f.real(8 + sizes, "NSM", 0.0);
  for (int i = 9 + sizes; i < f.size() && f.ok(); i += sizes + 3) {
    const double at = f.real(i + 1, "X/XB", 1.0);
    if (at < 1.0) {
      model.remarks.add("stations between the ends of tapered beams are ignored; the taper follows from both ends",
                        f.label());
      continue;
    }
    if (f.blank(i + 2)) continue;
    const std::optional<formats::Section> second = shaped(f, type, i + 2);
    if (!second) break;
    b.second = on_shear_axis(*second);
    b.tapered = true;
    b.added.second = f.real(i + 2 + sizes, "NSM", b.added.first);
  }
  return b;
}

/// One end of PBEAM: A, I1, I2, I12, J, NSM from field `start` on; blanks are copied from `before`.
formats::Section pbeam_end(CardFields& f, int start, const formats::Section& before) {
  formats::Section s =
      constants(f.real(start, "A", before.area), f.real(start + 1, "I1", before.second_moment_z),
                f.real(start + 2, "I2", before.second_moment_y), f.real(start + 3, "I12", before.second_moment_yz),
                f.real(start + 4, "J", before.torsion_constant));
  judge(f, s);
  return s;
}

/// Sets the centroid from N1, N2, its distance from the line of shear centres along y and z; blanks from `before`.
void place_centroid(CardFields& f, int N1, const formats::Section& before, formats::Section& s) {
  s.centroid_y = f.real(N1, "N1", before.centroid_y);
  s.centroid_z = f.real(N1 + 1, "N2", before.centroid_z);
  s.shear_center_y = -s.centroid_y;
  s.shear_center_z = -s.centroid_z;
}

/// Reads the last lines of PBEAM: K1, K2 (blank: 1), S1, S2, NSI, CW; M1, M2 (the centre of NSM), N1, N2. Values that
/// the beam has once are means of both ends.
void read_pbeam_tail(NastranModel& model, CardFields& f, int tail, BeamSections& b) {
  const double K1 = f.real(tail, "K1", 1.0), K2 = f.real(tail + 1, "K2", 1.0);
  const double nsi = f.real(tail + 4, "NSI(A)", 0.0);
  b.added.inertia = 0.5 * (nsi + f.real(tail + 5, "NSI(B)", nsi));
  const double M1 = f.real(tail + 8, "M1(A)", 0.0), M2 = f.real(tail + 9, "M2(A)", 0.0);
  b.added.offset_y = 0.5 * (M1 + f.real(tail + 10, "M1(B)", M1));
  b.added.offset_z = 0.5 * (M2 + f.real(tail + 11, "M2(B)", M2));
  for (formats::Section* s : {&b.first, &b.second}) {
    s->shear_area_y = K1 * s->area;
    s->shear_area_z = K2 * s->area;
  }
  const auto given = [&](int from, int to) {
    bool any = false;
    for (int i = from; i < to; ++i) any = any || f.real(i, "value", 0.0) != 0.0;
    return any;
  };
  if (given(tail + 2, tail + 4)) model.remarks.add("shear relief S1, S2 of tapered beams is ignored", f.label());
  if (given(tail + 6, tail + 8)) model.remarks.add("warping CW is ignored", f.label());
  place_centroid(f, tail + 12, {}, b.first);
  place_centroid(f, tail + 14, b.first, b.second);
}

/// Reads PBEAM: ends, each with optional lines of stress points (C1 to F2), then the tail.
BeamSections read_pbeam(NastranModel& model, CardFields& f) {
  BeamSections b;
  formats::Section none;
  if (f.blank(2)) f.fault("A(A) is blank", "give the area");
  b.first = pbeam_end(f, 2, none);
  b.second = b.first;
  b.added.first = b.added.second = f.real(7, "NSM", 0.0);
  int line = is_station(f.text(8)) ? 8 : 16;
  while (f.ok() && is_station(f.text(line))) {
    if (f.real(line + 1, "X/XB", 1.0) < 1.0) {
      model.remarks.add("stations between the ends of tapered beams are ignored; the taper follows from both ends",
                        f.label());
    } else {
      b.second = pbeam_end(f, line + 2, b.first);
      b.added.second = f.real(line + 7, "NSM", b.added.first);
    }
    line += same_word(f.text(line), "YES") ? 16 : 8;
  }
  read_pbeam_tail(model, f, line, b);
  const auto same = [](const formats::Section& p, const formats::Section& q) {
    return p.area == q.area && p.second_moment_y == q.second_moment_y && p.second_moment_z == q.second_moment_z &&
           p.second_moment_yz == q.second_moment_yz && p.torsion_constant == q.torsion_constant &&
           p.centroid_y == q.centroid_y && p.centroid_z == q.centroid_z;
  };
  b.tapered = !same(b.first, b.second);
  return b;
}

}  // namespace

int read_beam_property(NastranModel& model, CardFields& f) {
  const std::optional<formats::Material> m = beam_material(model, f);
  if (!m) return -1;
  const std::string name = capitals(f.card().name);
  const BeamSections b = name == "PBAR"     ? read_pbar(f)
                         : name == "PBARL"  ? read_pbarl(f)
                         : name == "PBEAML" ? read_pbeaml(model, f)
                                            : read_pbeam(model, f);
  const AddedMass& added = b.added;
  if (f.ok() && !(added.first >= 0.0 && added.second >= 0.0 && added.inertia >= 0.0))
    f.fault(fmt::format("NSM {:g}, {:g} and NSI {:g} must not be negative", added.first, added.second, added.inertia),
            "give values >= 0");
  if (!f.ok()) return -1;
  BeamProperty property;
  property.name = f.label();
  property.data.section = b.first;
  property.data.section.name = property.name;
  property.data.material = *m;
  property.data.mass_matrix = model.mass_matrix;
  property.data.rotary_inertia =
      model.mass_matrix == formats::MassMatrix::consistent ? RotaryInertia::without : RotaryInertia::with;
  if (b.tapered) property.data.stations = taper_stations(b.first, b.second);
  property.data.added_mass = added;
  property.data.added_mass.first *= model.mass_scale;
  property.data.added_mass.second *= model.mass_scale;
  property.data.added_mass.inertia *= model.mass_scale;
  return add_row(model.deck.mesh.beam_properties, property);
}

int add_rod_property(NastranModel& model, CardFields& f, int material_index, const RodConstants& rod) {
  const NastranMaterial* m = material(model, f, material_index, "MID");
  if (m != nullptr && m->kind != NastranMaterial::Kind::isotropic)
    f.fault(fmt::format("{} is not a material for rods", m->label), "use MAT1");
  if (f.ok() && !(rod.area >= 0.0 && rod.torsion_constant >= 0.0 && rod.mass_per_length >= 0.0))
    f.fault(fmt::format("A {:g}, J {:g}, NSM {:g} must not be negative", rod.area, rod.torsion_constant,
                        rod.mass_per_length),
            "give values >= 0");
  if (f.ok() && !(rod.area > 0.0)) f.fault("A is zero", "give an area > 0");
  if (m == nullptr || !f.ok()) return -1;
  BeamProperty property;
  property.name = f.label();
  property.data.section = constants(rod.area, 0.0, 0.0, 0.0, m->G > 0.0 ? rod.torsion_constant : 0.0);
  property.data.section.name = property.name;
  const double nu = m->G > 0.0 ? 0.5 * m->E / m->G - 1.0 : 0.0;
  property.data.material = {m->label, m->E, nu, m->density, m->where};
  property.data.added_mass.first = property.data.added_mass.second = rod.mass_per_length * model.mass_scale;
  property.data.theory = formats::BeamTheory::euler_bernoulli;
  property.data.mass_matrix = model.mass_matrix;
  property.data.rotary_inertia = RotaryInertia::without;
  return add_row(model.deck.mesh.beam_properties, property);
}

}  // namespace tisserand::reducer
