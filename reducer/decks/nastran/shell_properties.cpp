// SPDX-License-Identifier: GPL-3.0-or-later
// Sections of shells from PSHELL and PCOMP of a Nastran deck.
#include <vector>

#include <fmt/format.h>

#include "reducer/decks/nastran/model.hpp"
#include "reducer/properties/laminate.hpp"

namespace tisserand::reducer {
namespace {

/// Material with plane stress stiffness; null if the field is blank or after a fault.
const NastranMaterial* plane_material(NastranModel& model, CardFields& f, int index, std::string_view name) {
  if (f.blank(index) || parse_integer(f.text(index)) == 0) return nullptr;
  const NastranMaterial* m = material(model, f, index, name);
  if (m == nullptr) {
    if (f.ok()) f.fault(fmt::format("{} {} has errors", name, f.text(index)), "correct the material");
    return nullptr;
  }
  if (m->kind == NastranMaterial::Kind::solid)
    f.fault(fmt::format("{} names {}, a material for solids", name, m->label), "use MAT1, MAT2 or MAT8");
  else if (m->kind == NastranMaterial::Kind::isotropic && !(m->G > 0.0 && m->nu < 1.0))
    f.fault(fmt::format("{} has G {:g} and NU {:g}", m->label, m->G, m->nu), "shells need G > 0 and NU below 1");
  return f.ok() ? m : nullptr;
}

/// Reads PSHELL: N = T G1 ε + T² G4 χ, M = T² G4 ε + I G2 χ, Q = TS G3 γ. Since ε(z) = ε − z χ, κ = −χ and B = −T² G4.
std::optional<ShellSection> pshell_section(NastranModel& model, CardFields& f, double own_thickness) {
  if (f.integer(3, "MID2", 0) == -1) f.fault("MID2 -1 (plane strain) is not understood", "give a material");
  const double T = own_thickness > 0.0 ? own_thickness : f.real(2, "T");
  if (f.ok() && !(T > 0.0)) f.fault(fmt::format("T {:g} must be positive", T), "give the thickness");
  const NastranMaterial* membrane = plane_material(model, f, 1, "MID1");
  const NastranMaterial* bending = plane_material(model, f, 3, "MID2");
  const NastranMaterial* shear = plane_material(model, f, 5, "MID3");
  const NastranMaterial* coupling = plane_material(model, f, 10, "MID4");
  const double inertia = f.real(4, "12I/T**3", 1.0), ratio = f.real(6, "TS/T", 5.0 / 6.0), nsm = f.real(7, "NSM", 0.0);
  if (f.ok() && membrane == nullptr && bending == nullptr) f.fault("MID1 and MID2 are blank", "give a material");
  if (f.ok() && !(inertia > 0.0 && ratio >= 0.0 && nsm >= 0.0))
    f.fault(
        fmt::format("12I/T**3 {:g} must be positive; TS/T {:g} and NSM {:g} must not be negative", inertia, ratio, nsm),
        "correct them");
  if (!f.ok()) return std::nullopt;
  ShellSection s;
  s.thickness = T;
  if (membrane != nullptr) s.A = T * membrane->Q;
  if (bending != nullptr) s.D = inertia * T * T * T / 12.0 * bending->Q;
  if (coupling != nullptr) s.B = -T * T * coupling->Q;
  if (shear == nullptr) shear = bending;
  if (shear != nullptr && bending != nullptr) s.As = (ratio > 0.0 ? ratio : 5.0 / 6.0) * T * shear->shear;
  const double density = membrane != nullptr ? membrane->density : bending->density;
  s.mass = density * T + nsm * model.mass_scale;
  if (bending != nullptr) s.rotary_inertia = density * T * T * T / 12.0;  // without them rotations must have no mass
  return s;
}

struct Stack {
  std::vector<Ply> plies;  ///< lowest first
  double thickness = 0.0;
};

/// Reads four fields per ply from field 8 on: MID, T, THETA, SOUT; blank MID and T repeat those of the ply before.
std::optional<Stack> read_plies(NastranModel& model, CardFields& f) {
  Stack stack;
  long id = 0;
  double thickness = 0.0;
  for (int i = 8; i < f.size() && f.ok(); i += 4) {
    if (f.blank(i) && f.blank(i + 1) && f.blank(i + 2) && f.blank(i + 3)) continue;
    id = f.blank(i) ? id : f.id(i, "MID");
    thickness = f.real(i + 1, "T", thickness);
    const double angle = f.real(i + 2, "THETA", 0.0);
    if (!f.ok()) break;
    const NastranMaterial* m = id > 0 ? material_of(model, f, id, "MID") : nullptr;
    if (f.ok() && (m == nullptr ||
                   (m->kind != NastranMaterial::Kind::isotropic && m->kind != NastranMaterial::Kind::orthotropic)))
      f.fault(fmt::format("ply {}: MID {} is not a valid MAT1 or MAT8", stack.plies.size() + 1, id),
              "correct the material");
    if (!f.ok()) break;
    Ply ply = m->ply;
    ply.thickness = thickness;
    ply.angle = angle * degree;
    stack.plies.push_back(ply);
  }
  if (f.ok() && stack.plies.empty()) f.fault("there are no plies", "give MID and T of each ply");
  if (!f.ok()) return std::nullopt;
  const std::string_view kind = f.text(7);
  if (same_word(kind, "SYM")) {
    stack.plies.insert(stack.plies.end(), stack.plies.rbegin(), stack.plies.rend());
  } else if (!kind.empty())
    return f.refuse(fmt::format("LAM '{}' is not understood", kind), "leave it blank or use SYM");
  for (const Ply& ply : stack.plies) stack.thickness += ply.thickness;
  return stack;
}

/// Reads PCOMP. `offset`: distance of the middle from the reference surface, Z0 + thickness/2.
std::optional<ShellSection> pcomp_section(NastranModel& model, CardFields& f, double& offset) {
  std::optional<Stack> stack = read_plies(model, f);
  if (!stack) return std::nullopt;
  const double nsm = f.real(2, "NSM", 0.0);
  offset = f.real(1, "Z0", -0.5 * stack->thickness) + 0.5 * stack->thickness;
  if (f.ok() && nsm < 0.0) f.fault(fmt::format("NSM {:g} is negative", nsm), "give a value >= 0");
  if (!f.ok()) return std::nullopt;
  try {
    check_plies(stack->plies, f.where());
  } catch (const Error& error) {
    return f.refuse(error.message(), error.remedy());
  }
  ShellSection section = laminate(stack->plies, -0.5 * stack->thickness);
  section.mass += nsm * model.mass_scale;
  return section;
}

}  // namespace

PropertyRow read_shell_property(NastranModel& model, CardFields& f, double thickness) {
  PropertyRow result;
  const bool layered = same_word(f.card().name, "PCOMP");
  if (layered && thickness > 0.0)
    model.remarks.add("thicknesses of elements (T1 to T4) have no effect with PCOMP", f.label());
  const std::optional<ShellSection> section =
      layered ? pcomp_section(model, f, result.offset) : pshell_section(model, f, thickness);
  if (!section) return result;
  ShellProperty property;
  property.section = *section;
  property.mass_matrix = model.mass_matrix;
  property.name = f.label();
  result.row = add_row(model.deck.mesh.shell_properties, property);
  return result;
}

}  // namespace tisserand::reducer
