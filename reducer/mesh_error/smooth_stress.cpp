// SPDX-License-Identifier: GPL-3.0-or-later
// Superconvergent patch recovery.
#include "reducer/mesh_error/smooth_stress.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "common/parallel.hpp"
#include "reducer/elements/mesh_error.hpp"
#include "reducer/elements/shell/geometry.hpp"
#include "reducer/mesh_error/surround.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Number of terms: 1, x, y (shells); 1, x, y, z; and with their products.
int terms(bool shell, bool quadratic) { return shell ? 3 : quadratic ? 10 : 4; }

Eigen::RowVectorXd monomials(const Eigen::Vector3d& x, int count) {
  Eigen::Matrix<double, 1, 10> all;
  all << 1.0, x.x(), x.y(), x.z(), x.x() * x.x(), x.y() * x.y(), x.z() * x.z(), x.x() * x.y(), x.y() * x.z(),
      x.z() * x.x();
  return all.head(count);
}

/// Least squares by orthogonalisation of one term after the other over the samples. If the new part of a term is small
/// there relative to its values at the nodes, the samples do not determine it, and it is omitted.
MatrixXd least_squares(MatrixXd at_samples, MatrixXd at_nodes, const MatrixXd& values) {
  constexpr double known_share = 0.05;
  const Index count = at_samples.cols();
  MatrixXd combination = MatrixXd::Identity(count, count);  // column k: term k minus those before it
  MatrixXd coefficient = MatrixXd::Zero(count, values.cols());
  std::vector<Index> kept;
  for (Index k = 0; k < count; ++k) {
    for (int pass = 0; pass < 2; ++pass)
      for (const Index j : kept) {
        const double share = at_samples.col(j).dot(at_samples.col(k));
        at_samples.col(k) -= share * at_samples.col(j);
        at_nodes.col(k) -= share * at_nodes.col(j);
        combination.col(k) -= share * combination.col(j);
      }
    const double norm = at_samples.col(k).norm();
    if (norm <= known_share * std::sqrt(static_cast<double>(at_samples.rows())) * at_nodes.col(k).cwiseAbs().maxCoeff())
      continue;
    at_samples.col(k) /= norm;
    at_nodes.col(k) /= norm;
    combination.col(k) /= norm;
    coefficient.noalias() += combination.col(k) * (at_samples.col(k).transpose() * values);
    kept.push_back(k);
  }
  return coefficient;
}

/// Relation of a shell to axes of another tangent plane: cosine and sine of the turn from its x axis, and whether its
/// normal is opposite (then z → −z and y → −y first).
struct PlaneTurn {
  double c = 1.0, s = 0.0;
  bool flipped = false;
};

PlaneTurn plane_turn(const Eigen::Matrix3d& shell, const Eigen::Matrix3d& axes) {
  PlaneTurn turn;
  turn.flipped = shell.col(2).dot(axes.col(2)) < 0.0;
  const double sign = turn.flipped ? -1.0 : 1.0;
  const double c = shell.col(0).dot(axes.col(0)) + sign * shell.col(1).dot(axes.col(1));
  const double s = shell.col(0).dot(axes.col(1)) - sign * shell.col(1).dot(axes.col(0));
  const double size = std::hypot(c, s);
  if (size > 0.0) {
    turn.c = c / size;
    turn.s = s / size;
  }
  return turn;
}

/// Transforms [xx yy xy] to axes turned back by the angle, those from which the turn was measured.
void rotate(Eigen::Ref<Eigen::Vector3d> t, double c, double s) {
  const double xx = t[0], yy = t[1], xy = t[2];
  t << c * c * xx + s * s * yy - 2.0 * c * s * xy, s * s * xx + c * c * yy + 2.0 * c * s * xy,
      c * s * (xx - yy) + (c * c - s * s) * xy;
}

void flip(Eigen::Ref<Eigen::Matrix<double, 6, 1>> resultants) {
  resultants[2] *= -1.0;
  resultants[3] *= -1.0;
  resultants[4] *= -1.0;
}

void to_plane(const PlaneTurn& turn, Eigen::Ref<Eigen::Matrix<double, 6, 1>> resultants) {
  if (turn.flipped) flip(resultants);
  rotate(resultants.head<3>(), turn.c, turn.s);
  rotate(resultants.tail<3>(), turn.c, turn.s);
}

/// Transforms [N; M; Q] back to the axes of the shell.
void from_plane(const PlaneTurn& turn, Eigen::Ref<Eigen::Matrix<double, 8, 1>> resultants) {
  rotate(resultants.head<3>(), turn.c, -turn.s);
  rotate(resultants.segment<3>(3), turn.c, -turn.s);
  const double x = resultants[6], y = resultants[7];
  resultants[6] = turn.c * x + turn.s * y;
  resultants[7] = turn.c * y - turn.s * x;
  if (!turn.flipped) return;
  flip(resultants.head<6>());
  resultants[6] *= -1.0;
}

/// Axes of a patch: x along that of the first shell, z along the mean normal.
Eigen::Matrix3d mean_axes(const std::vector<int>& shells, const std::vector<Eigen::Matrix3d>& axes) {
  const Eigen::Matrix3d& first = axes[shells.front()];
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const int e : shells) normal += std::copysign(1.0, axes[e].col(2).dot(first.col(2))) * axes[e].col(2);
  Eigen::Matrix3d mean;
  mean.col(2) = normal.normalized();
  mean.col(0) = (first.col(0) - mean.col(2) * mean.col(2).dot(first.col(0))).normalized();
  mean.col(1) = mean.col(2).cross(mean.col(0));
  return mean;
}

Eigen::Matrix3d axes_of_shell(const Mesh& mesh, const ShellElement& shell) {
  return shell.corners() == 3 ? shell_geometry<3>(mesh, shell).R_PE : shell_geometry<4>(mesh, shell).R_PE;
}

/// Samples that have modes within points, as points x (6 · modes).
MatrixXd by_points(const StressSamples& samples, Index modes) {
  const Index points = samples.place.cols();
  MatrixXd rows(points, 6 * modes);
  for (Index k = 0; k < points; ++k)
    for (Index m = 0; m < modes; ++m) rows.block<1, 6>(k, 6 * m) = samples.stress.col(k * modes + m).transpose();
  return rows;
}

/// Shape function of a shell's corner at one of its samples: the middle of a triangle, or a fifth of the way from the
/// middle to the corner `sample` of a quadrilateral.
double sample_weight(int corners, int sample, int corner) {
  if (corners == 3) return 1.0 / 3.0;
  const int apart = std::abs(sample - corner);
  return apart == 0 ? 0.36 : apart == 2 ? 0.16 : 0.24;
}

}  // namespace

MatrixXd motion_of(const ShellElement& shell, const MatrixXd& motion) {
  MatrixXd u(6 * shell.corners(), motion.cols());
  for (int i = 0; i < shell.corners(); ++i) u.middleRows<6>(6 * i) = motion.middleRows<6>(6 * shell.nodes[i]);
  return u;
}

MatrixXd motion_of(const SolidElement& solid, const MatrixXd& motion) {
  const int count = node_count(solid.shape);
  MatrixXd u(3 * count, motion.cols());
  for (int i = 0; i < count; ++i) u.middleRows<3>(3 * i) = motion.middleRows<3>(6 * solid.nodes[i]);
  return u;
}

SmoothStress::SmoothStress(const Mesh& mesh, const MatrixXd& motion)
    : mesh_(mesh), modes_(motion.cols()), patches_(stress_patches(mesh)), surround_(surroundings(mesh, patches_)) {
  const int shells = count_of(mesh.shells), elements = shells + count_of(mesh.solids);
  const int threads = core_count(), patches = count_of(patches_.patch);
  axes_.resize(mesh.shells.size());
  place_.resize(static_cast<std::size_t>(elements));
  sample_.resize(place_.size());
  on_threads(threads, [&](int t) {
    StressSamples samples;
    const Share share = share_of(elements, t, threads);
    for (int e = share.first; e < share.end; ++e) {
      if (e < shells) {
        axes_[e] = axes_of_shell(mesh, mesh.shells[e]);
        sample_stresses(mesh, mesh.shells[e], motion_of(mesh.shells[e], motion), samples);
      } else {
        const SolidElement& solid = mesh.solids[e - shells];
        sample_stresses(mesh, solid, motion_of(solid, motion), samples);
      }
      place_[e] = samples.place;
      sample_[e] = by_points(samples, modes_);
    }
  });
  polynomial_.resize(patches_.patch.size());
  on_threads(threads, [&](int t) {
    const Share share = share_of(patches, t, threads);
    for (int p = share.first; p < share.end; ++p)
      if (patches_.patch[p].source.front() == p) polynomial_[p] = fit(patches_.patch[p]);
  });
}

SmoothStress::Polynomial SmoothStress::fit(const StressPatch& patch) const {
  const int shells = count_of(mesh_.shells);
  const bool shell = patch.elements.front() < shells;
  bool quadratic = false;
  Index samples = 0, nodes = 0;
  for (const int e : patch.elements) {
    samples += place_[e].cols();
    nodes += corners_of(mesh_, e);
    quadratic = quadratic || (!shell && is_second_order(mesh_.solids[e - shells].shape));
  }
  Polynomial result;
  result.origin = mesh_.position.col(patch.node);
  result.axes = shell ? mean_axes(patch.elements, axes_) : Eigen::Matrix3d::Identity();
  result.size = 0.0;
  for (const int e : patch.elements)
    for (Index k = 0; k < place_[e].cols(); ++k)
      result.size = std::max(result.size, (place_[e].col(k) - result.origin).norm());
  const auto local = [&](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(result.axes.transpose() * (x - result.origin) / result.size);
  };
  const int count = terms(shell, quadratic);
  MatrixXd at_samples(samples, count), at_nodes(nodes, count), values(samples, 6 * modes_);
  Index row = 0, node = 0;
  for (const int e : patch.elements) {
    values.middleRows(row, sample_[e].rows()) = sample_[e];
    if (shell) {
      const PlaneTurn turn = plane_turn(axes_[e], result.axes);
      for (Index k = row; k < row + sample_[e].rows(); ++k)
        for (Index m = 0; m < modes_; ++m) {
          Eigen::Matrix<double, 6, 1> resultants = values.block<1, 6>(k, 6 * m).transpose();
          to_plane(turn, resultants);
          values.block<1, 6>(k, 6 * m) = resultants.transpose();
        }
    }
    for (Index k = 0; k < place_[e].cols(); ++k) at_samples.row(row++) = monomials(local(place_[e].col(k)), count);
    for (int c = 0; c < corners_of(mesh_, e); ++c)
      at_nodes.row(node++) = monomials(local(mesh_.position.col(corner_node(mesh_, e, c))), count);
  }
  result.coefficient = least_squares(std::move(at_samples), std::move(at_nodes), values);
  return result;
}

/// Mean of the polynomials of a patch at a place: 6 x modes, for solids.
MatrixXd SmoothStress::at(int patch, const Eigen::Vector3d& place) const {
  const std::vector<int>& source = patches_.patch[patch].source;
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(6 * modes_);
  for (const int p : source) {
    const Polynomial& polynomial = polynomial_[p];
    const Eigen::Vector3d x = (place - polynomial.origin) / polynomial.size;
    sum += monomials(x, static_cast<int>(polynomial.coefficient.rows())) * polynomial.coefficient;
  }
  return sum.reshaped(6, modes_) / static_cast<double>(source.size());
}

MatrixXd SmoothStress::of_shell(int shell) const {
  const ShellElement& element = mesh_.shells[shell];
  MatrixXd result = MatrixXd::Zero(8 * element.corners(), modes_);
  for (int i = 0; i < element.corners(); ++i) {
    const std::vector<int>& source = patches_.patch[patches_.of_corner[patches_.first[shell] + i]].source;
    for (const int p : source) {
      const Polynomial& polynomial = polynomial_[p];
      const PlaneTurn turn = plane_turn(axes_[shell], polynomial.axes);
      const Eigen::Vector3d x =
          polynomial.axes.transpose() * (mesh_.position.col(element.nodes[i]) - polynomial.origin) / polynomial.size;
      const Eigen::RowVectorXd value = monomials(x, 3) * polynomial.coefficient;
      for (Index m = 0; m < modes_; ++m) {
        const auto slope = polynomial.coefficient.block<2, 3>(1, 6 * m + 3) / polynomial.size;  // of [xx yy xy] of M
        Eigen::Matrix<double, 8, 1> resultants;
        resultants << value.segment<6>(6 * m).transpose(), slope(0, 0) + slope(1, 2), slope(0, 2) + slope(1, 1);
        from_plane(turn, resultants);
        result.block<8, 1>(8 * i, m) += resultants / static_cast<double>(source.size());
      }
    }
  }
  return result;
}

MatrixXd SmoothStress::of_solid(int solid) const {
  const SolidElement& element = mesh_.solids[solid];
  const int e = count_of(mesh_.shells) + solid, corners = corner_count(element.shape);
  const auto patch = [&](int corner) { return patches_.of_corner[patches_.first[e] + corner]; };
  MatrixXd result(6 * node_count(element.shape), modes_);
  for (int k = 0; k < node_count(element.shape); ++k) {
    const Eigen::Vector3d place = mesh_.position.col(element.nodes[k]);
    if (k < corners) {
      result.middleRows<6>(6 * k) = at(patch(k), place);
      continue;
    }
    const auto [a, b] = ends_of_edge_node(element.shape, k);
    result.middleRows<6>(6 * k) = 0.5 * (at(patch(a), place) + at(patch(b), place));
  }
  return result;
}

MatrixXd SmoothStress::samples(int element) const {
  const Index points = place_[element].cols();
  MatrixXd result(6, points * modes_);
  for (Index q = 0; q < points; ++q)
    result.middleCols(q * modes_, modes_) = sample_[element].row(q).reshaped(6, modes_);
  return result;
}

MatrixXd SmoothStress::scatter(int element) const {
  MatrixXd gap = -samples(element);
  const int shells = count_of(mesh_.shells), corners = corners_of(mesh_, element);
  const MatrixXd at_corners = element < shells ? of_shell(element) : MatrixXd();
  for (Index q = 0; q < place_[element].cols(); ++q)
    for (int i = 0; i < corners; ++i) {
      auto here = gap.middleCols(q * modes_, modes_);
      if (element < shells) {
        here += sample_weight(corners, static_cast<int>(q), i) * at_corners.middleRows<6>(8 * i);
      } else {
        here += at(patches_.of_corner[patches_.first[element] + i], place_[element].col(q)) / corners;
      }
    }
  return gap;
}

}  // namespace tisserand::reducer
