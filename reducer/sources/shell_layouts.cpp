// SPDX-License-Identifier: GPL-3.0-or-later
// Plies from the names of their materials.
#include "reducer/sources/shell_layouts.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/properties/laminate.hpp"

namespace tisserand::reducer {
namespace {

const formats::Material* isotropic(const formats::Part& part, const std::string& name) {
  const auto found = std::ranges::find(part.materials, name, &formats::Material::name);
  return found == part.materials.end() ? nullptr : &*found;
}

[[noreturn]] void refuse_material(const std::string& name, const std::string& user, const std::string& where) {
  throw Error(fmt::format("{}: material '{}' does not exist", user, name), where, "define it under materials");
}

Ply ply_of(const formats::Part& part, const formats::Ply& given, const std::string& user, const std::string& where) {
  Ply ply;
  ply.thickness = given.thickness;
  ply.angle = given.angle;
  if (const formats::Material* m = isotropic(part, given.material)) {
    ply.E1 = ply.E2 = m->youngs_modulus;
    ply.nu12 = m->poisson_ratio;
    ply.G12 = ply.G13 = ply.G23 = m->shear_modulus();
    ply.density = m->density;
    return ply;
  }
  const auto found = std::ranges::find(part.orthotropic, given.material, &formats::OrthotropicMaterial::name);
  if (found == part.orthotropic.end()) refuse_material(given.material, user, where);
  ply.E1 = found->E1;
  ply.E2 = found->E2;
  ply.nu12 = found->nu12;
  ply.G12 = found->G12;
  ply.G13 = found->G13;
  ply.G23 = found->G23;
  ply.density = found->density;
  return ply;
}

}  // namespace

ShellProperty shell_property(const formats::Part& part, const formats::ShellLayout& layout, const std::string& user,
                             const std::string& where) {
  ShellProperty property;
  property.mass_matrix = layout.mass_matrix;
  property.name = user;
  const formats::Material* material = layout.plies.empty() ? isotropic(part, layout.material) : nullptr;
  if (material != nullptr) {
    constexpr double shear_correction = 5.0 / 6.0;  // parabolic shear stress
    property.section = isotropic_shell(material->youngs_modulus, material->poisson_ratio, material->density,
                                       layout.thickness, shear_correction);
    return property;
  }
  std::vector<formats::Ply> given = layout.plies;
  if (given.empty()) given.push_back({layout.material, layout.thickness, 0.0});
  std::vector<Ply> plies;
  double thickness = 0.0;
  for (const formats::Ply& ply : given) {
    plies.push_back(ply_of(part, ply, user, where));
    thickness += ply.thickness;
  }
  check_plies(plies, where);
  property.section = laminate(plies, -0.5 * thickness);
  return property;
}

SolidProperty solid_property(const formats::Part& part, const formats::SolidGroup& solid) {
  const std::string user = fmt::format("solid '{}'", solid.name);
  const formats::Material* material = isotropic(part, solid.material);
  if (material == nullptr) refuse_material(solid.material, user, solid.where);
  return {isotropic_solid(material->youngs_modulus, material->poisson_ratio, material->density), solid.mass_matrix,
          solid.name};
}

}  // namespace tisserand::reducer
