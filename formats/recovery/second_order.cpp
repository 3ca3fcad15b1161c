// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates quadratic forms at instants.
#include "formats/recovery/second_order.hpp"

#include <algorithm>

namespace tisserand::formats {

Eigen::MatrixXd second_order_amplitudes(const std::vector<Eigen::MatrixXd>& forms, const Eigen::MatrixXd& y) {
  Eigen::MatrixXd amplitudes(static_cast<Eigen::Index>(forms.size()), y.cols());
  for (std::size_t r = 0; r < forms.size(); ++r)
    amplitudes.row(static_cast<Eigen::Index>(r)) = 0.5 * y.cwiseProduct(forms[r] * y).colwise().sum();
  return amplitudes;
}

Eigen::MatrixXd add_second_order(const SecondOrderForms& forms, const Eigen::RowVectorXd& stiffened,
                                 const std::vector<Eigen::Index>& left_out, Eigen::MatrixXd& y) {
  const Eigen::MatrixXd amplitudes = second_order_amplitudes(forms.of_shape, y) * stiffened.asDiagonal();
  const Eigen::MatrixXd of_coordinates = second_order_amplitudes(forms.of_coordinate, y) * stiffened.asDiagonal();
  for (std::size_t i = 0; i < forms.coordinate.size(); ++i)
    if (std::ranges::find(left_out, forms.coordinate[i]) != left_out.end())
      y.row(forms.coordinate[i]) += of_coordinates.row(static_cast<Eigen::Index>(i));
  return amplitudes;
}

Eigen::RowVectorXd stiffened_instants(std::optional<bool> stiffened, const Eigen::MatrixXd& y,
                                      const Eigen::MatrixXd& y_strain) {
  if (stiffened) return Eigen::RowVectorXd::Constant(y.cols(), *stiffened ? 1.0 : 0.0);
  if (y.rows() == 0 || y_strain.size() != y.size()) return Eigen::RowVectorXd::Zero(y.cols());
  return (y_strain.array() != y.array()).cast<double>().colwise().maxCoeff();
}

}  // namespace tisserand::formats
