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

/// Material of a Nastran deck (MAT1, MAT2, MAT8 or MAT9).
struct NastranMaterial {
  enum class Kind { isotropic, orthotropic, plane, solid } kind = Kind::isotropic;  ///< MAT1, MAT8, MAT2, MAT9
  std::string label;  ///< name of the card for messages: "MAT1 5"
  std::string where;
  double density = 0.0;  ///< density times PARAM,WTMASS
  /// Young's modulus E, shear modulus G and Poisson's ratio of MAT1. If the card has E only, which suffices for rods,
  /// G is 0.
  double E = 0.0, G = 0.0, nu = 0.0;
  /// MAT1, 2, 8: stiffness in plane stress [xx yy xy], engineering shear.
  Eigen::Matrix3d Q = Eigen::Matrix3d::Zero();
  Eigen::Matrix2d shear = Eigen::Matrix2d::Zero();  ///< MAT1, 2, 8: transverse shear moduli of γxz, γyz
  Ply ply;                                          ///< MAT1, 8: material as a layer without thickness and angle
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();  ///< MAT9: elasticity, order [xx yy zz xy yz zx]
};

/// Materials of a deck. A material is read when a property needs it, so unused ones are not checked.
struct NastranMaterials {
  std::map<long, std::size_t> card;                     ///< key: id, value: index in NastranCards::cards
  std::map<long, std::optional<NastranMaterial>> read;  ///< materials read so far, by id; empty after a fault
};

/// Finds the cards MAT1, MAT2, MAT8 and MAT9, and adds faults for duplicate ids.
void index_materials(NastranModel& model);

/// Material whose id is in the field `index` of the card `property`; null after a fault. `name`: name of the field for
/// the message.
const NastranMaterial* material(NastranModel& model, CardFields& property, int index, std::string_view name);
const NastranMaterial* material_of(NastranModel& model, CardFields& property, long id, std::string_view name);

}  // namespace tisserand::reducer
