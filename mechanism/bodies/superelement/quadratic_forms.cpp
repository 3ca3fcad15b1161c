// From matrices to their common pairs, and combinations of them.
#include "mechanism/bodies/superelement/quadratic_forms.hpp"

namespace tisserand::mechanism {

QuadraticForms quadratic_forms(const std::vector<Eigen::MatrixXd>& matrices, const Eigen::VectorXd& unit) {
  constexpr double round_off = 1e-15;
  QuadraticForms forms;
  forms.size = static_cast<int>(unit.size());
  const auto count = static_cast<Eigen::Index>(matrices.size());
  std::vector<Eigen::MatrixXd> symmetric;
  Eigen::VectorXd largest(count);
  for (const Eigen::MatrixXd& A : matrices) {
    largest[static_cast<Eigen::Index>(symmetric.size())] =
        (unit.asDiagonal() * A * unit.asDiagonal()).cwiseAbs().maxCoeff();
    symmetric.emplace_back(0.5 * (A + A.transpose()));
  }
  forms.entry.resize(count, unit.size() * (unit.size() + 1) / 2);
  for (int l = 0; l < forms.size; ++l)
    for (int k = 0; k <= l; ++k) {
      bool any = false;
      const auto column = static_cast<Eigen::Index>(forms.pairs.size());
      for (Eigen::Index a = 0; a < count; ++a) {
        const double value = symmetric[a](k, l);
        forms.entry(a, column) = value;
        any = any || std::abs(value) * unit[k] * unit[l] > round_off * largest[a];
      }
      if (any) forms.pairs.push_back({k, l});
    }
  forms.entry.conservativeResize(count, static_cast<Eigen::Index>(forms.pairs.size()));
  return forms;
}

void add_combination(const QuadraticForms& forms, double scale, const Eigen::VectorXd& factor,
                     Eigen::Ref<Eigen::MatrixXd> sum) {
  for (std::size_t p = 0; p < forms.pairs.size(); ++p) {
    const auto [k, l] = forms.pairs[p];
    sum(l, k) += scale * forms.entry.col(static_cast<Eigen::Index>(p)).dot(factor);
  }
}

}  // namespace tisserand::mechanism
