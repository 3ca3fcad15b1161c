// SPDX-License-Identifier: GPL-3.0-or-later
// Equations of an averaging spider. Large spiders have a tree of groups.
#include "reducer/ties/averaging.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::reducer {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Term of Σ w s u: the coordinate u and its factor w s.
struct Item {
  int coordinate = 0;
  Vector6 factor;
};

/// Sums of the spider. Moments are divided and rotations multiplied by the length L.
struct Fit {
  double length = 1.0;
  Matrix6 matrix = Matrix6::Zero();       ///< Σ w s sᵀ
  std::vector<std::vector<Item>> items;   ///< items of each node
  std::vector<Eigen::Vector3d> position;  ///< position of each node from the reference
};

double mean_distance(const std::vector<Eigen::Vector3d>& position) {
  double sum = 0.0;
  for (const Eigen::Vector3d& r : position) sum += r.norm();
  return sum > 0.0 ? sum / static_cast<double>(position.size()) : 1.0;
}

/// s of component c of a node at r: its motion for a rigid motion of the reference.
Vector6 motion_factor(const Spider& spider, int c, const Eigen::Vector3d& r, double length) {
  const Eigen::Vector3d e = spider.axes.col(c % 3);
  Vector6 s;
  if (c < 3)
    s << e, r.cross(e) / length;
  else
    s << Eigen::Vector3d::Zero(), e / length;
  return s;
}

Fit make_fit(const Mesh& mesh, const Coordinates& coordinates, const Spider& spider) {
  Fit fit;
  for (const int n : spider.nodes) fit.position.push_back(mesh.position.col(n) - mesh.position.col(spider.reference));
  fit.length = mean_distance(fit.position);
  fit.items.resize(spider.nodes.size());
  for (std::size_t i = 0; i < spider.nodes.size(); ++i) {
    const int n = spider.nodes[i];
    Eigen::Matrix<double, 6, 3> factor[2] = {Eigen::Matrix<double, 6, 3>::Zero(), Eigen::Matrix<double, 6, 3>::Zero()};
    for (int c = 0; c < 6; ++c) {
      if (((spider.node_components >> c) & 1) == 0 || (c >= 3 && !coordinates.rotates(n))) continue;
      const Vector6 s = motion_factor(spider, c, fit.position[i], fit.length);
      const double w = spider.weight[i] * (c < 3 ? 1.0 : fit.length * fit.length);
      fit.matrix += w * s * s.transpose();
      factor[c / 3] += w * s * spider.axes.col(c % 3).transpose();
    }
    for (int c = 0; c < 6; ++c)
      if (!factor[c / 3].col(c % 3).isZero(0.0))
        fit.items[i].push_back({coordinates.of(n, c), factor[c / 3].col(c % 3)});
  }
  return fit;
}

/// Computes the sum over `nodes` (rows of Fit::items) with few items.
class Gatherer {
 public:
  Gatherer(const Fit& fit, TieSystem& ties) : fit_(fit), ties_(ties) {}

  /// Items of the whole sum.
  std::vector<Item> gather() {
    std::vector<int> order(fit_.items.size());
    std::iota(order.begin(), order.end(), 0);
    return inside(order.begin(), order.end());
  }

 private:
  using Iterator = std::vector<int>::iterator;

  std::vector<Item> inside(Iterator begin, Iterator end) {
    if (end - begin > averaging_group) return parts(begin, end, 16);
    std::vector<Item> items;
    for (Iterator i = begin; i != end; ++i) items.insert(items.end(), fit_.items[*i].begin(), fit_.items[*i].end());
    return items;
  }

  /// Divides the nodes across their longest extent until there are `pieces` or the pieces are small. Compresses each.
  std::vector<Item> parts(Iterator begin, Iterator end, int pieces) {
    if (pieces == 1 || end - begin <= averaging_group) return compress(inside(begin, end));
    Eigen::Array3d low = fit_.position[*begin], high = low;
    for (Iterator i = begin; i != end; ++i) {
      low = low.min(fit_.position[*i].array());
      high = high.max(fit_.position[*i].array());
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const Iterator middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [&](int a, int b) { return fit_.position[a][axis] < fit_.position[b][axis]; });
    std::vector<Item> items = parts(begin, middle, pieces / 2), more = parts(middle, end, pieces / 2);
    items.insert(items.end(), more.begin(), more.end());
    return items;
  }

  /// y = Q₁ᵀ x as auxiliary coordinates for items x (as lengths) with factors B: Bᵀ P = Q R, so B x = P R₁ᵀ y.
  std::vector<Item> compress(const std::vector<Item>& items) {
    Eigen::MatrixXd Bt(static_cast<Eigen::Index>(items.size()), 6);
    for (std::size_t i = 0; i < items.size(); ++i) Bt.row(i) = items[i].factor.transpose() / scale(items[i]);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(Bt);
    qr.setThreshold(1e-12);
    const Eigen::Index rank = qr.rank();
    const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(Bt.rows(), rank);
    const Eigen::MatrixXd R1 = qr.matrixR().topRows(rank).triangularView<Eigen::Upper>();
    const Eigen::MatrixXd factor = qr.colsPermutation() * R1.transpose();
    std::vector<Item> result;
    const int group = ties_.coordinates;
    for (Eigen::Index j = 0; j < rank; ++j) result.push_back({define(items, Q.col(j), group), factor.col(j)});
    return result;
  }

  /// Appends y = qᵀ x, a coordinate of the group that begins with number `group`.
  int define(const std::vector<Item>& items, const Eigen::VectorXd& q, int group) {
    const int y = ties_.coordinates++;
    LinearEquation equation{{{y, -1.0}}, -1, group};
    Vector6 rigid = Vector6::Zero();
    for (std::size_t i = 0; i < items.size(); ++i) {
      const double coefficient = q[i] * scale(items[i]);
      equation.terms.push_back({items[i].coordinate, coefficient});
      rigid += coefficient * ties_.rigid[items[i].coordinate];
    }
    ties_.rigid.push_back(rigid);
    ties_.scale.push_back(1.0);
    ties_.auxiliary_tie.push_back(ties_.last_tie());
    ties_.add(std::move(equation));
    return y;
  }

  double scale(const Item& item) const { return ties_.scale[item.coordinate]; }

  const Fit& fit_;
  TieSystem& ties_;
};

/// (Σ w s sᵀ)⁺, and the projection on motions that the nodes cannot define.
struct Inverse {
  Matrix6 inverse = Matrix6::Zero();
  Matrix6 undefined = Matrix6::Zero();
};

Inverse invert(const Matrix6& matrix) {
  constexpr double limit = 1e-10;  // nodes within 1e-5 of their mean distance from a line count as collinear
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(matrix)};
  Inverse result;
  for (int k = 0; k < 6; ++k) {
    const double value = solver.eigenvalues()[k];
    const Matrix6 square = solver.eigenvectors().col(k) * solver.eigenvectors().col(k).transpose();
    if (value > limit * solver.eigenvalues()[5])
      result.inverse += square / value;
    else
      result.undefined += square;
  }
  return result;
}

[[noreturn]] void fail_undefined(const Mesh& mesh, const Spider& spider, const std::vector<int>& components,
                                 const std::string& name, const std::string& where) {
  std::vector<std::string> words;
  for (const int c : components) words.push_back(component_text(c));
  throw Error(
      fmt::format("{}: its {} nodes do not define {} of its reference {}", name, spider.nodes.size(), join(words, ", "),
                  mesh.node_label[spider.reference]),
      where,
      "use nodes that are not on one line, or a rigid spider; in a deck you can also average rotations, or remove "
      "these components of the reference node");
}

}  // namespace

void append_averaging(const Mesh& mesh, const Coordinates& coordinates, const Spider& spider, const std::string& where,
                      TieSystem& ties) {
  TISSERAND_ENSURE(spider.weight.size() == spider.nodes.size(), "{} weights for {} nodes", spider.weight.size(),
                   spider.nodes.size());
  const Fit fit = make_fit(mesh, coordinates, spider);
  const Inverse fitted = invert(fit.matrix);
  std::vector<int> undefined;
  std::vector<std::pair<int, Vector6>> wanted;  // component and its direction
  for (int c = 0; c < 6; ++c) {
    if (((spider.reference_components >> c) & 1) == 0) continue;
    Vector6 direction = Vector6::Zero();
    direction.segment<3>(c < 3 ? 0 : 3) = spider.axes.col(c % 3);
    if ((fitted.undefined * direction).norm() > 1e-6) undefined.push_back(c);
    wanted.emplace_back(c, direction);
  }
  if (!undefined.empty()) fail_undefined(mesh, spider, undefined, ties.name.back(), where);

  const std::vector<Item> items = Gatherer(fit, ties).gather();
  for (const auto& [c, direction] : wanted) {
    const Vector6 row = fitted.inverse * direction / (c < 3 ? 1.0 : fit.length);
    LinearEquation equation;
    for (int k = 0; k < 3; ++k) {
      const double e = spider.axes(k, c % 3);
      const int coordinate = coordinates.of(spider.reference, (c < 3 ? 0 : 3) + k);
      if (e != 0.0) equation.terms.push_back({coordinate, -e});
      if (std::abs(e) == 1.0) equation.preferred = coordinate;
    }
    for (const Item& item : items) equation.terms.push_back({item.coordinate, row.dot(item.factor)});
    ties.add(std::move(equation));
  }
}

}  // namespace tisserand::reducer
