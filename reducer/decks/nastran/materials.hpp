// SPDX-License-Identifier: GPL-3.0-or-later
// MAT cards of a Nastran deck: elastic matrices for properties.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include "reducer/properties/laminate.hpp"

namespace tisserand::reducer {

struct NastranModel;
class CardFields;

struct NastranMaterial {
  enum class Kind { isotropic, orthotropic, plane, solid } kind = Kind::isotropic;  ///< MAT1, MAT8, MAT2, MAT9
  std::string label;                                                                ///< "MAT1 5"
  std::string where;
  double density = 0.0;  ///< scaled by PARAM,WTMASS
  /// Constants of MAT1 only. G = 0: the card has E only, which suffices for rods.
  double E = 0.0, G = 0.0, nu = 0.0;
  Eigen::Matrix3d Q = Eigen::Matrix3d::Zero();      ///< MAT1, 2, 8: plane stress [xx yy xy], engineering shear
  Eigen::Matrix2d shear = Eigen::Matrix2d::Zero();  ///< MAT1, 2, 8: moduli of γxz, γyz
  Ply ply;                                          ///< MAT1, 8: without thickness and angle
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();  ///< MAT9: [xx yy zz xy yz zx]
};

/// Materials. They are read when a property needs them, so unused ones are not checked.
struct NastranMaterials {
  std::map<long, std::size_t> card;                     ///< key: id, value: index in NastranCards::cards
  std::map<long, std::optional<NastranMaterial>> read;  ///< empty after a fault
};

/// Finds the MAT1, MAT2, MAT8, MAT9 cards; faults for duplicate ids.
void index_materials(NastranModel& model);

/// Material named in a field of a property; null after a fault.
const NastranMaterial* material(NastranModel& model, CardFields& property, int index, std::string_view name);
const NastranMaterial* material_of(NastranModel& model, CardFields& property, long id, std::string_view name);

}  // namespace tisserand::reducer
