// SPDX-License-Identifier: GPL-3.0-or-later
// Fit of surface forms: first guesses by linear algebra, then Gauss-Newton on distances.
#include "reducer/faces/surface_form.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace tisserand::reducer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector7 = Eigen::Matrix<double, 7, 1>;
using Points = std::vector<Vector3d>;

constexpr std::size_t most_fitted = 600;  // points in the fit; the distances of all are checked
constexpr int most_steps = 30;

Vector3d mean_of(const Points& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& x : points) sum += x;
  return sum / static_cast<double>(points.size());
}

double size_of_points(const Points& points) {
  Vector3d low = points.front(), high = low;
  for (const Vector3d& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  return (high - low).norm();
}

/// Direction of the least extent of vectors about `middle`.
Vector3d least_direction(const Points& vectors, const Vector3d& middle) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Vector3d& v : vectors) sum += (v - middle) * (v - middle).transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(0);
}

/// Least squares of rows by the pseudo-inverse of the normal equations; directions without effect are not changed.
template <class Matrix, class Vector>
Vector least_squares(const Matrix& normal_matrix, const Vector& right) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(normal_matrix);
  const double least = 1e-15 * solver.eigenvalues().cwiseAbs().maxCoeff();
  const Vector inverse =
      solver.eigenvalues().unaryExpr([least](double value) { return value > least ? 1.0 / value : 0.0; });
  return solver.eigenvectors() * inverse.cwiseProduct(solver.eigenvectors().transpose() * right);
}

/// Centre and radius of the sphere or circle |x|^2 = 2 c x + d (Kasa's fit, exact for points on it).
template <int n>
std::pair<Eigen::Matrix<double, n, 1>, double> round_through(const std::vector<Eigen::Matrix<double, n, 1>>& points) {
  using Row = Eigen::Matrix<double, n + 1, 1>;
  using Square = Eigen::Matrix<double, n + 1, n + 1>;
  Eigen::Matrix<double, n, 1> middle = Eigen::Matrix<double, n, 1>::Zero();
  for (const auto& x : points) middle += x / static_cast<double>(points.size());
  double size = 0.0;
  for (const auto& x : points) size = std::max(size, (x - middle).norm());
  Square sum = Square::Zero();
  Row right = Row::Zero();
  for (const auto& x : points) {
    Row row;
    row << 2.0 * (x - middle) / size, 1.0;
    sum += row * row.transpose();
    right += row * ((x - middle) / size).squaredNorm();
  }
  const Row found = least_squares<Square, Row>(sum, right);
  const Eigen::Matrix<double, n, 1> center = found.template head<n>();
  return {middle + size * center, size * std::sqrt(std::max(0.0, found[n] + center.squaredNorm()))};
}

SurfaceForm plane_through(const Points& points) {
  SurfaceForm form;
  form.kind = FormKind::plane;
  form.point = mean_of(points);
  form.axis = least_direction(points, form.point);
  return form;
}

/// Two unit vectors that complete the axis.
std::array<Vector3d, 2> across(const Vector3d& axis) {
  const Vector3d first = axis.unitOrthogonal();
  return {first, axis.cross(first)};
}

SurfaceForm cylinder_through(const SurfaceSamples& samples) {
  SurfaceForm form;
  form.kind = FormKind::cylinder;
  form.axis = least_direction(samples.normal, Vector3d::Zero());
  const auto [u, v] = across(form.axis);
  std::vector<Vector2d> flat;
  for (const Vector3d& x : samples.point) flat.emplace_back(x.dot(u), x.dot(v));
  const auto [center, radius] = round_through<2>(flat);
  form.point = center.x() * u + center.y() * v + mean_of(samples.point).dot(form.axis) * form.axis;
  form.radius = radius;
  return form;
}

SurfaceForm sphere_through(const Points& points) {
  SurfaceForm form;
  form.kind = FormKind::sphere;
  const auto [center, radius] = round_through<3>(points);
  form.point = center;
  form.radius = radius;
  return form;
}

/// Cone whose apex is the common point of all tangent planes.
SurfaceForm cone_through(const SurfaceSamples& samples) {
  SurfaceForm form;
  form.kind = FormKind::cone;
  const Vector3d mean_normal = mean_of(samples.normal);
  form.axis = least_direction(samples.normal, mean_normal);
  form.half_angle = std::asin(std::clamp(std::abs(mean_normal.dot(form.axis)), 0.0, 1.0));
  const Vector3d middle = mean_of(samples.place);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  for (std::size_t k = 0; k < samples.normal.size(); ++k) {
    const Vector3d& n = samples.normal[k];
    sum += n * n.transpose();
    right += n * n.dot(samples.place[k] - middle);
  }
  form.point = middle + least_squares<Eigen::Matrix3d, Vector3d>(sum, right);
  if ((mean_of(samples.point) - form.point).dot(form.axis) < 0.0) form.axis = -form.axis;
  return form;
}

/// Torus whose axis (a; b = q x a) meets all lines of normals (n; x x n): n . b + (x x n) . a = 0.
std::optional<SurfaceForm> torus_through(const SurfaceSamples& samples) {
  const Vector3d middle = mean_of(samples.place);
  const double size = size_of_points(samples.place);
  Matrix6 sum = Matrix6::Zero();
  for (std::size_t k = 0; k < samples.normal.size(); ++k) {
    Vector6 row;
    row << ((samples.place[k] - middle) / size).cross(samples.normal[k]), samples.normal[k];
    sum += row * row.transpose();
  }
  const Vector6 line = Eigen::SelfAdjointEigenSolver<Matrix6>(sum).eigenvectors().col(0);
  const Vector3d a = line.head<3>(), b = line.tail<3>();
  if (a.norm() < 1e-6) return std::nullopt;
  SurfaceForm form;
  form.kind = FormKind::torus;
  form.axis = a.normalized();
  form.point = middle + size * a.cross(b) / a.squaredNorm();
  std::vector<Vector2d> meridian;
  for (const Vector3d& x : samples.point) {
    const Vector3d d = x - form.point;
    meridian.emplace_back(d.cross(form.axis).norm(), d.dot(form.axis));
  }
  const auto [center, radius] = round_through<2>(meridian);
  form.radius = center.x();
  form.minor_radius = radius;
  form.point += center.y() * form.axis;
  return form;
}

/// The form after a shift, a turn about two axes across its own, and a change of radii. Lengths in units of `size`.
SurfaceForm changed(const SurfaceForm& form, const Vector7& by, double size) {
  SurfaceForm result = form;
  const auto [u, v] = across(form.axis);
  result.point += size * by.head<3>();
  result.axis = (form.axis + by[3] * u + by[4] * v).normalized();
  result.radius += size * by[5];
  if (form.kind == FormKind::cone)
    result.half_angle += by[6];
  else
    result.minor_radius += size * by[6];
  return result;
}

double sum_of_squares(const SurfaceForm& form, const Points& points) {
  double sum = 0.0;
  for (const Vector3d& x : points) sum += distance(form, x) * distance(form, x);
  return sum;
}

/// Form by Gauss-Newton with central differences, whose error does not move the minimum of exact points.
SurfaceForm refined(SurfaceForm form, const Points& points, double size) {
  constexpr double step = 1e-6;
  double sum = sum_of_squares(form, points);
  for (int k = 0; k < most_steps; ++k) {
    std::array<SurfaceForm, 7> more, less;
    for (int i = 0; i < 7; ++i) {
      more[i] = changed(form, step * Vector7::Unit(i), size);
      less[i] = changed(form, -step * Vector7::Unit(i), size);
    }
    Matrix7 matrix = Matrix7::Zero();
    Vector7 right = Vector7::Zero();
    for (const Vector3d& x : points) {
      Vector7 slope;
      for (int i = 0; i < 7; ++i) slope[i] = (distance(more[i], x) - distance(less[i], x)) / (2.0 * step * size);
      matrix += slope * slope.transpose();
      right -= slope * distance(form, x) / size;
    }
    const SurfaceForm next = changed(form, least_squares<Matrix7, Vector7>(matrix, right), size);
    const double next_sum = sum_of_squares(next, points);
    if (!(next_sum < sum)) break;
    const bool settled = next_sum > 0.999 * sum;
    form = next;
    sum = next_sum;
    if (settled) break;
  }
  return form;
}

bool fits(const SurfaceForm& form, const SurfaceSamples& samples) {
  if (!form.point.allFinite() || !form.axis.allFinite()) return false;
  for (const Vector3d& x : samples.point)
    if (!(std::abs(distance(form, x)) <= samples.tolerance)) return false;
  const double least = std::cos(samples.angle);
  for (std::size_t k = 0; k < samples.normal.size(); ++k)
    if (!(std::abs(normal_at(form, samples.place[k]).dot(samples.normal[k])) >= least)) return false;
  return true;
}

std::optional<SurfaceForm> guess(FormKind kind, const SurfaceSamples& samples) {
  switch (kind) {
    case FormKind::plane:
      return plane_through(samples.point);
    case FormKind::cylinder:
      return cylinder_through(samples);
    case FormKind::cone:
      return cone_through(samples);
    case FormKind::sphere:
      return sphere_through(samples.point);
    case FormKind::torus:
      return torus_through(samples);
    case FormKind::curved:
      break;
  }
  return std::nullopt;
}

Points thinned_points(const Points& points) {
  const std::size_t step = 1 + points.size() / most_fitted;
  Points few;
  for (std::size_t k = 0; k < points.size(); k += step) few.push_back(points[k]);
  return few;
}

Vector3d unit_or(const Vector3d& v, const Vector3d& instead) {
  const double length = v.norm();
  return length > 0.0 ? Vector3d(v / length) : instead;
}

}  // namespace

const char* form_word(FormKind kind) {
  constexpr std::array<const char*, 6> words{"plane", "cylinder", "cone", "sphere", "torus", "curved"};
  return words[static_cast<std::size_t>(kind)];
}

double distance(const SurfaceForm& form, const Vector3d& x) {
  const Vector3d d = x - form.point;
  const double along = d.dot(form.axis);
  const double across_axis = (d - along * form.axis).norm();
  switch (form.kind) {
    case FormKind::plane:
      return along;
    case FormKind::cylinder:
      return across_axis - form.radius;
    case FormKind::cone:
      return across_axis * std::cos(form.half_angle) - along * std::sin(form.half_angle);
    case FormKind::sphere:
      return d.norm() - form.radius;
    case FormKind::torus:
      return std::hypot(across_axis - form.radius, along) - form.minor_radius;
    case FormKind::curved:
      break;
  }
  return std::numeric_limits<double>::infinity();
}

Vector3d normal_at(const SurfaceForm& form, const Vector3d& x) {
  const Vector3d d = x - form.point;
  const double along = d.dot(form.axis);
  const Vector3d radial = unit_or(d - along * form.axis, form.axis.unitOrthogonal());
  switch (form.kind) {
    case FormKind::plane:
    case FormKind::curved:
      return form.axis;
    case FormKind::cylinder:
      return radial;
    case FormKind::cone:
      return std::cos(form.half_angle) * radial - std::sin(form.half_angle) * form.axis;
    case FormKind::sphere:
      return unit_or(d, form.axis);
    case FormKind::torus:
      return unit_or(d - form.radius * radial, radial);
  }
  return form.axis;
}

SurfaceForm fitted_form(const SurfaceSamples& samples) {
  constexpr std::size_t fewest = 3;
  if (samples.point.size() < fewest || samples.normal.empty()) return {};
  const double size = size_of_points(samples.point);
  if (!(size > 0.0)) return {};
  const Points few = thinned_points(samples.point);
  for (const FormKind kind : {FormKind::plane, FormKind::cylinder, FormKind::cone, FormKind::sphere, FormKind::torus}) {
    const std::optional<SurfaceForm> first = guess(kind, samples);
    if (!first) continue;
    const SurfaceForm form = refined(*first, few, size);
    if (fits(form, samples)) return form;
  }
  return {};
}

}  // namespace tisserand::reducer
