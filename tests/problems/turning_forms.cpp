// SPDX-License-Identifier: GPL-3.0-or-later
// Products of the rows of each element, summed over its masses, loads and pivots.
#include "tests/problems/turning_forms.hpp"

#include <array>

namespace tisserand::testing {

using namespace reducer;

TurningForms turning_forms(const TurningMass& mass) {
  TurningForms forms(mass.load.rows());
  const Eigen::Index count = mass.translation.rows() / 3;
  std::array<Eigen::MatrixXd, 6> product;
  for (int a = 0, at = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b, ++at)
      product[at] =
          mass.translation.middleRows(a * count, count).transpose() * mass.momentum.middleRows(b * count, count);
  add_translations(product, forms);
  for (int l = 0; l < inertial_loads && mass.turn.cols() > 0; ++l) {
    const Eigen::MatrixXd half = mass.turn.transpose() * mass.turned.middleRows<3>(3 * l);
    forms.of(TurningPivot::work + l) += half + half.transpose();
  }
  for (const TurningPivot& pivot : mass.pivots)
    for (int item = 0; item < TurningPivot::items; ++item)
      if ((pivot.present >> static_cast<unsigned>(item) & 1U) != 0)
        forms.of(item) += pivot.rotation.transpose() * (pivot.form[item] * pivot.rotation);
  return forms;
}

}  // namespace tisserand::testing
