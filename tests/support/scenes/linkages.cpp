// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry of overconstrained linkages: closure by Newton's iteration, and the path on which they move.
#include "tests/support/scenes/linkages.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <Eigen/SVD>

#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

double between(std::mt19937& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
}

double either_sign(std::mt19937& random) { return random() % 2 == 0 ? 1.0 : -1.0; }

std::vector<double> as_angles(const VectorXd& q) { return {q.data(), q.data() + q.size()}; }

/// Motion of the end of the chain relative to its beginning, [point at the origin; rotation vector]: zero if it is
/// closed.
Eigen::Matrix<double, 6, 1> gap(const Isometry3d& end) {
  const Eigen::AngleAxisd turn(end.linear());
  Eigen::Matrix<double, 6, 1> e;
  e << end.translation(), turn.angle() * turn.axis();
  return e;
}

/// Velocity of the end, as seen at the origin, of unit rates of the joints.
Jacobian jacobian(const std::vector<Isometry3d>& axes) {
  Jacobian J(6, static_cast<Eigen::Index>(axes.size()) - 1);
  for (Eigen::Index i = 0; i < J.cols(); ++i) {
    const Isometry3d& at = axes[static_cast<std::size_t>(i)];
    const Vector3d z = at.linear().col(2);
    J.col(i) << at.translation().cross(z), z;
  }
  return J;
}

struct Position {
  VectorXd angles, tangent;
  double singular = 0.0;  ///< smallest singular value but one over the largest
};

/// The closed position near these angles, by Newton's iteration with the shortest corrections.
std::optional<Position> closed_near(const std::vector<LinkageLink>& links, VectorXd angles) {
  constexpr int most = 30;
  for (int iteration = 0; iteration < most; ++iteration) {
    const std::vector<Isometry3d> axes = joint_axes(links, as_angles(angles));
    Eigen::JacobiSVD<Jacobian> svd(jacobian(axes), Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix<double, 6, 1> e = gap(axes.back());
    const Eigen::Index last = angles.size() - 1;
    if (e.norm() < 1e-12)
      return Position{angles, svd.matrixV().col(last), svd.singularValues()[last - 1] / svd.singularValues()[0]};
    svd.setThreshold(1e-3);  // the smallest singular value is zero where the loop is closed
    VectorXd step = svd.solve(e);
    if (step.norm() > 0.5) step *= 0.5 / step.norm();
    angles -= step;
  }
  return std::nullopt;
}

/// Smallest `singular` along the path through the position, and the length of the path.
bool examine(Linkage& linkage, const Position& start, double least) {
  constexpr double step = 0.04, longest = 40.0;
  linkage.least_singular = start.singular;
  Position at = start;
  for (linkage.path = 0.0; linkage.path < longest; linkage.path += step) {
    std::optional<Position> next = closed_near(linkage.links, at.angles + step * at.tangent);
    if (!next || std::abs((next->angles - at.angles).norm() / step - 1.0) > 0.2) return false;
    // One degree of freedom: the Jacobian loses one rank, along the whole path.
    const std::vector<Isometry3d> axes = joint_axes(linkage.links, as_angles(next->angles));
    if ((jacobian(axes) * next->tangent).norm() > 1e-9) return false;
    if (next->tangent.dot(at.tangent) < 0.0) next->tangent *= -1.0;
    at = *next;
    linkage.least_singular = std::min(linkage.least_singular, at.singular);
    if (linkage.least_singular < least) return false;
    VectorXd away = at.angles - start.angles;
    for (double& angle : away) angle = std::remainder(angle, 2.0 * pi);
    if (linkage.path > 10.0 * step && away.norm() < step) break;
  }
  return true;
}

std::vector<LinkageLink> bennett_links(std::mt19937& random) {
  const double alpha = between(random, 0.3, 1.3), beta = between(random, 1.4, 2.6), a = between(random, 0.5, 1.5);
  const double b = a * std::sin(beta) / std::sin(alpha);
  return {{a, alpha}, {b, beta}, {a, alpha}, {b, beta}};
}

std::vector<LinkageLink> goldberg_links(std::mt19937& random) {
  const double ratio = between(random, 0.8, 1.5);
  const double alpha = between(random, 0.4, 1.2), beta = between(random, 0.4, 2.6), gamma = between(random, 0.4, 2.6);
  const double a = ratio * std::sin(alpha), b = ratio * std::sin(beta), c = ratio * std::sin(gamma);
  return {{a, alpha}, {b + c, beta + gamma}, {a, alpha}, {c, gamma}, {b, beta}};
}

std::vector<LinkageLink> myard_links(std::mt19937& random) {
  const double alpha = between(random, 0.3, 1.3), b = between(random, 0.6, 1.5), a = b * std::sin(alpha);
  return {{a, alpha}, {b, 0.5 * pi}, {0.0, pi - 2.0 * alpha}, {b, 0.5 * pi}, {a, pi - alpha}};
}

LinkageLink any_link(std::mt19937& random) {
  return {between(random, 0.4, 1.4), between(random, 0.4, 2.7), either_sign(random) * between(random, 0.0, 0.6)};
}

std::vector<LinkageLink> line_symmetric_links(std::mt19937& random) {
  const LinkageLink first = any_link(random), second = any_link(random), third = any_link(random);
  return {first, second, third, first, second, third};
}

/// The offset of a link is that of the joint at its beginning: R1 of link 12.
std::vector<LinkageLink> plane_symmetric_links(std::mt19937& random) {
  const LinkageLink l12 = any_link(random), l23 = any_link(random), l34 = any_link(random);
  const double R2 = l12.offset, R3 = l23.offset;
  return {{l12.length, l12.twist, 0.0},
          {l23.length, l23.twist, R2},
          {l34.length, l34.twist, R3},
          {l34.length, pi - l34.twist, 0.0},
          {l23.length, 2.0 * pi - l23.twist, R3},
          {l12.length, pi - l12.twist, R2}};
}

std::vector<LinkageLink> trihedral_links(std::mt19937& random) {
  for (;;) {
    double a[6], square = 0.0;
    for (int i = 0; i < 5; ++i) {
      a[i] = between(random, 0.4, 1.4);
      square += (i % 2 == 0 ? 1.0 : -1.0) * a[i] * a[i];
    }
    if (square < 0.16 || square > 2.0) continue;
    a[5] = std::sqrt(square);
    std::vector<LinkageLink> links;
    for (int i = 0; i < 6; ++i) links.push_back({a[i], i % 2 == 0 ? 0.5 * pi : 1.5 * pi});
    return links;
  }
}

std::vector<LinkageLink> random_links(LinkageFamily family, std::mt19937& random) {
  switch (family) {
    case LinkageFamily::bennett:
      return bennett_links(random);
    case LinkageFamily::goldberg:
      return goldberg_links(random);
    case LinkageFamily::myard:
      return myard_links(random);
    case LinkageFamily::bricard_line:
      return line_symmetric_links(random);
    case LinkageFamily::bricard_plane:
      return plane_symmetric_links(random);
    case LinkageFamily::bricard_trihedral:
      return trihedral_links(random);
  }
  return {};
}

Vector3d random_vector(std::mt19937& random, double size) {
  return {between(random, -size, size), between(random, -size, size), between(random, -size, size)};
}

}  // namespace

Isometry3d LinkageLink::motion(double angle) const {
  return Eigen::AngleAxisd(angle, Vector3d::UnitZ()) * Eigen::Translation3d(length, 0, offset) *
         Eigen::AngleAxisd(twist, Vector3d::UnitX());
}

std::string name_of(LinkageFamily family) {
  switch (family) {
    case LinkageFamily::bennett:
      return "Bennett";
    case LinkageFamily::goldberg:
      return "Goldberg";
    case LinkageFamily::myard:
      return "Myard";
    case LinkageFamily::bricard_line:
      return "Bricard, symmetric to a line";
    case LinkageFamily::bricard_plane:
      return "Bricard, symmetric to a plane";
    case LinkageFamily::bricard_trihedral:
      return "Bricard, trihedral";
  }
  return "";
}

std::vector<Isometry3d> joint_axes(const std::vector<LinkageLink>& links, const std::vector<double>& angles) {
  std::vector<Isometry3d> axes = {Isometry3d::Identity()};
  for (std::size_t i = 0; i < links.size(); ++i) axes.push_back(axes.back() * links[i].motion(angles[i]));
  return axes;
}

double opening(const std::vector<LinkageLink>& links, const std::vector<double>& angles) {
  const Eigen::Matrix<double, 6, 1> e = gap(joint_axes(links, angles).back());
  return std::max(e.head<3>().norm(), e.tail<3>().norm());
}

Linkage random_linkage(LinkageFamily family, std::mt19937& random) {
  constexpr double least = 0.02;
  constexpr int most = 1000;
  for (int tries = 0; tries < most; ++tries) {
    Linkage linkage;
    linkage.links = random_links(family, random);
    VectorXd angles(linkage.size());
    for (double& angle : angles) angle = between(random, -pi, pi);
    const std::optional<Position> start = closed_near(linkage.links, angles);
    if (!start || start->singular < least || !examine(linkage, *start, least)) continue;
    linkage.angles = as_angles(start->angles);
    linkage.tangent = as_angles(start->tangent);
    return linkage;
  }
  throw std::runtime_error("no linkage of the family " + name_of(family) + " closes and moves");
}

formats::Scene moving_linkage(const Linkage& linkage, std::mt19937& random) {
  formats::Scene scene = empty_scene(1e-3, 3.0);
  scene.output.interval = 0.01;
  scene.gravity = 9.81 * random_vector(random, 1.0).normalized();
  const std::vector<Isometry3d> axes = joint_axes(linkage.links, linkage.angles);
  const int n = linkage.size();
  const auto name = [n](int link) {
    return link == 0 || link == n ? std::string("ground") : "l" + std::to_string(link);
  };
  for (int i = 1; i < n; ++i) {
    const double mass = between(random, 0.5, 3.0);
    const double length = linkage.links[static_cast<std::size_t>(i - 1)].length, radius = 0.15 + 0.2 * length;
    const Vector3d half = mass * radius * radius * (Vector3d(0.55, 0.55, 0.55) + random_vector(random, 0.45));
    formats::RigidBodySpec body = rigid_body(name(i), mass, Vector3d(-0.5 * length, 0, 0) + random_vector(random, 0.15),
                                             {half[1] + half[2], half[0] + half[2], half[0] + half[1]});
    const Isometry3d& end = axes[static_cast<std::size_t>(i)];
    body.start.pose = {end.translation(), Eigen::Quaterniond(end.linear())};
    scene.bodies.emplace_back(body);
  }
  for (int i = 0; i < n; ++i) {
    const Isometry3d& at = axes[static_cast<std::size_t>(i)];
    scene.joints.push_back(joint("j" + std::to_string(i + 1), formats::JointKind::revolute, name(i), name(i + 1),
                                 at.translation(), at.linear().col(2)));
  }
  const auto most = std::max_element(linkage.tangent.begin(), linkage.tangent.end(),
                                     [](double a, double b) { return std::abs(a) < std::abs(b); });
  formats::InitialSpec initial;
  initial.coordinate.name = "j" + std::to_string(most - linkage.tangent.begin() + 1);
  initial.rate = either_sign(random) * between(random, 0.5, 2.5);
  scene.initial.push_back(initial);
  return scene;
}

}  // namespace tisserand::test_support
