// SPDX-License-Identifier: GPL-3.0-or-later
// Elastic constants from the forms of *ELASTIC.
#include "reducer/decks/abaqus/materials.hpp"

#include <fmt/format.h>
#include <Eigen/LU>

#include "common/text.hpp"
#include "reducer/properties/solid_anisotropic.hpp"

namespace tisserand::reducer::abaqus {
namespace {

/// All numbers of the data lines. Empty, with a fault, unless there are exactly `wanted` numbers: a further one would
/// be a temperature or a second row of a table.
std::optional<std::vector<double>> constants_of(Model& model, const Block& block, std::size_t wanted) {
  std::vector<double> values;
  for (const Line& line : block.data)
    for (const std::string_view field : split(line.text)) {
      const std::optional<double> value = to_number(field);
      if (!value)
        return model.refuse(fmt::format("{}: '{}' is not a number", block.title, field), line, "write a finite number");
      values.push_back(*value);
      if (values.size() > 2 * wanted) break;
    }
  const bool has_temperature = values.size() == wanted + 1 && block.data.size() <= (wanted + 7) / 8;
  if (values.size() == wanted || has_temperature) {
    values.resize(wanted);
    return values;
  }
  return model.refuse(fmt::format("{}: {} values are given, expected {}", block.title, values.size(), wanted), block,
                      "give one set of constants: values for several temperatures are not understood");
}

void read_isotropic(Model& model, const Block& block, AbaqusMaterial& material) {
  const auto c = constants_of(model, block, 2);
  if (!c) return;
  if (!((*c)[0] > 0.0) || !((*c)[1] > -1.0 && (*c)[1] < 0.5))
    return model.fault(fmt::format("material '{}': E = {}, nu = {}", material.name, (*c)[0], (*c)[1]), block,
                       "give E > 0 and -1 < nu < 0.5");
  material.kind = AbaqusMaterial::Kind::isotropic;
  material.E = (*c)[0];
  material.nu = (*c)[1];
}

/// Reads E1 E2 nu12 G12 G13 G23.
void read_lamina(Model& model, const Block& block, AbaqusMaterial& material) {
  const auto c = constants_of(model, block, 6);
  if (!c) return;
  material.lamina = {(*c)[0], (*c)[1], (*c)[2], (*c)[3], (*c)[4], (*c)[5]};
  Ply ply = material.lamina;
  ply.thickness = 1.0;
  check_plies({ply}, model.where(block));
  material.kind = AbaqusMaterial::Kind::lamina;
}

/// Reads E1 E2 E3 nu12 nu13 nu23 G12 G13 G23.
void read_engineering(Model& model, const Block& block, AbaqusMaterial& material) {
  const auto c = constants_of(model, block, 9);
  if (!c) return;
  OrthotropicConstants constants;
  constants.E1 = (*c)[0], constants.E2 = (*c)[1], constants.E3 = (*c)[2];
  constants.nu12 = (*c)[3], constants.nu13 = (*c)[4], constants.nu23 = (*c)[5];
  constants.G12 = (*c)[6], constants.G31 = (*c)[7], constants.G23 = (*c)[8];
  material.C = orthotropic_elasticity(constants, model.where(block));
  material.kind = AbaqusMaterial::Kind::orthotropic;
}

/// Reads D1111 D1122 D2222 D1133 D2233 D3333 D1212 D1313 D2323.
void read_orthotropic(Model& model, const Block& block, AbaqusMaterial& material) {
  const auto c = constants_of(model, block, 9);
  if (!c) return;
  const std::vector<double>& d = *c;
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();
  C.topLeftCorner<3, 3>() << d[0], d[1], d[3], d[1], d[2], d[4], d[3], d[4], d[5];
  C(3, 3) = d[6];
  C(5, 5) = d[7];
  C(4, 4) = d[8];
  material.C = anisotropic_solid(C, Eigen::Matrix3d::Identity(), 0.0, model.where(block)).C;
  material.kind = AbaqusMaterial::Kind::orthotropic;
}

void read_elastic(Model& model, const Block& block, AbaqusMaterial& material) {
  const std::string type = block.word_of("TYPE", "ISOTROPIC");
  try {
    if (type == "ISOTROPIC" || type == "ISO")
      read_isotropic(model, block, material);
    else if (type == "LAMINA")
      read_lamina(model, block, material);
    else if (type == "ENGINEERINGCONSTANTS")
      read_engineering(model, block, material);
    else if (type == "ORTHOTROPIC" || type == "ORTHO")
      read_orthotropic(model, block, material);
    else
      model.fault(fmt::format("*ELASTIC, TYPE={} is not understood", type), block,
                  "use ISOTROPIC, ENGINEERING CONSTANTS, ORTHOTROPIC or LAMINA");
  } catch (const Error& error) {
    model.fault(error.message(), block, error.remedy());
  }
}

void read_density(Model& model, const Block& block, AbaqusMaterial& material) {
  const auto density = constants_of(model, block, 1);
  if (density && (*density)[0] >= 0.0)
    material.density = (*density)[0];
  else if (density)
    model.fault(fmt::format("material '{}': density {} < 0", material.name, (*density)[0]), block,
                "give a density >= 0");
}

}  // namespace

void read_materials(Model& model) {
  AbaqusMaterial* present = nullptr;
  for (const Block* block : model.scopes[0].blocks) {
    if (block->keyword == "MATERIAL") {
      const std::string name = block->name_of("NAME");
      const auto [entry, is_new] = model.materials.try_emplace(name);
      if (!is_new) model.fault(fmt::format("material '{}' is defined twice", name), *block, "delete one of them");
      present = &entry->second;
      present->name = name;
      present->where = model.where(*block);
    }
    if (block->keyword != "ELASTIC" && block->keyword != "DENSITY") continue;
    if (present == nullptr)
      model.fault(fmt::format("{} comes before the first *MATERIAL", block->title), *block,
                  "write *MATERIAL, NAME=... before it");
    else if (block->keyword == "ELASTIC")
      read_elastic(model, *block, *present);
    else
      read_density(model, *block, *present);
  }
}

const AbaqusMaterial* find_material(Model& model, const std::string& name, const std::string& where) {
  const auto found = model.materials.find(lower(name));
  if (found == model.materials.end()) {
    std::vector<std::string> known;
    for (const auto& [key, material] : model.materials) known.push_back(key);
    const std::optional<std::string> close = nearest(name, known);
    model.fault(fmt::format("material '{}' does not exist", name), where,
                close ? fmt::format("is '{}' meant?", *close) : "define it with *MATERIAL, NAME=...");
    return nullptr;
  }
  if (found->second.kind != AbaqusMaterial::Kind::none) return &found->second;
  model.fault(fmt::format("material '{}' has no elastic constants", name), where,
              fmt::format("add *ELASTIC to it (it begins at {})", found->second.where));
  return nullptr;
}

const AbaqusMaterial* find_material(Model& model, const Block& block) {
  const std::string* name = block.find("MATERIAL");
  return find_material(model, name == nullptr ? "" : *name, model.where(block));
}

Ply ply_of(const AbaqusMaterial& material) {
  Ply ply;
  switch (material.kind) {
    case AbaqusMaterial::Kind::none:
      break;
    case AbaqusMaterial::Kind::isotropic:
      ply.E1 = ply.E2 = material.E;
      ply.nu12 = material.nu;
      ply.G12 = ply.G13 = ply.G23 = 0.5 * material.E / (1.0 + material.nu);
      break;
    case AbaqusMaterial::Kind::lamina:
      ply = material.lamina;
      break;
    case AbaqusMaterial::Kind::orthotropic: {
      const Eigen::Matrix3d compliance = material.C.topLeftCorner<3, 3>().inverse();
      ply.E1 = 1.0 / compliance(0, 0);
      ply.E2 = 1.0 / compliance(1, 1);
      ply.nu12 = -compliance(0, 1) / compliance(0, 0);
      ply.G12 = material.C(3, 3);
      ply.G23 = material.C(4, 4);
      ply.G13 = material.C(5, 5);
      break;
    }
  }
  ply.density = material.density;
  return ply;
}

SolidMaterial solid_of(const AbaqusMaterial& material, const Eigen::Matrix3d& R_PM) {
  if (material.kind == AbaqusMaterial::Kind::isotropic)
    return isotropic_solid(material.E, material.nu, material.density);
  return anisotropic_solid(material.C, R_PM, material.density, material.where);
}

}  // namespace tisserand::reducer::abaqus
