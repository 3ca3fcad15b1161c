// SPDX-License-Identifier: GPL-3.0-or-later
// Random overconstrained linkages of one loop and one degree of freedom, by the parameters of Denavit and Hartenberg.
#pragma once

#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "formats/scene/scene.hpp"

namespace tisserand::test_support {

/// From the axis of a joint to that of the next: a turn by the angle of the joint and a shift by `offset` along z, then
/// a shift by `length` along x, which is the common normal, and a twist of the axis about it.
struct LinkageLink {
  double length = 0.0, twist = 0.0, offset = 0.0;
  Eigen::Isometry3d motion(double angle) const;
};

/// Families, with their conditions on lengths a, twists α and offsets R; link ij goes from joint i to joint j. R = 0
/// unless it is given.
enum class LinkageFamily {
  /// a12 = a34, a23 = a41, α12 = α34, α23 = α41, a12/sin α12 = a23/sin α23 (Bennett, Engineering 76, 1903, 777).
  bennett,
  /// Five links: two Bennett linkages of one ratio ρ = a/sin α share a link, which is left out, and two of their links
  /// are
  /// joined to one: a23 = b + c, α23 = β + γ; a12 = a34, a45 = c, a51 = b (Goldberg, Trans. ASME 65, 1943, 649).
  goldberg,
  /// Five links, symmetric to a plane: a12 = a51, a23 = a45, a34 = 0, α23 = α45 = π/2, α51 = π - α12, α34 = π - 2 α12,
  /// a12 = a23 sin α12 (Myard, Bull. Soc. Math. France 59, 1931, 183).
  myard,
  /// Six links, symmetric to a line: links and offsets i and i + 3 are equal (Bricard, Leçons de cinématique II, 1927,
  /// 7-12).
  bricard_line,
  /// Six links, symmetric to a plane: a12 = a61, a23 = a56, a34 = a45, α12 + α61 = α34 + α45 = π, α23 + α56 = 2π, R1 =
  /// R4 = 0,
  /// R2 = R6, R3 = R5 (Bricard, as above; signs of the offsets as in Chen, Design of structural mechanisms, Oxford
  /// 2003, 2.3).
  bricard_plane,
  /// Six links, axes at right angles: α12 = α34 = α56 = π/2, α23 = α45 = α61 = 3π/2, a12² + a34² + a56² = a23² + a45² +
  /// a61²
  /// (trihedral; Bricard, as above).
  bricard_trihedral
};

std::string name_of(LinkageFamily family);

struct Linkage {
  std::vector<LinkageLink> links;
  std::vector<double> angles;   ///< of the joints, closed
  std::vector<double> tangent;  ///< of the path on which the linkage moves, of length 1
  double path = 0.0;            ///< length of the path that was examined [rad]
  double least_singular = 0.0;  ///< smallest singular value but one of its Jacobian over the largest, along that path

  int size() const { return static_cast<int>(links.size()); }
};

/// Places of the joint axes (z) for these angles; the last one is the first if the loop is closed.
std::vector<Eigen::Isometry3d> joint_axes(const std::vector<LinkageLink>& links, const std::vector<double>& angles);

/// Distance and angle [rad] by which the loop is open, the larger one.
double opening(const std::vector<LinkageLink>& links, const std::vector<double>& angles);

/// Random parameters, and a closed position by Newton's iteration from random angles. Each linkage moves with one
/// degree of freedom along its whole path (once round, or 40 rad of it), and the path stays away from positions at
/// which the linkage could change to another way of moving: `least_singular` is 0.02 or more.
Linkage random_linkage(LinkageFamily family, std::mt19937& random);

/// The linkage with bodies of random mass and inertia between joints j1, j2, ..., link n being the ground. Gravity has
/// a random direction, and the joint that moves most has a random rate of 0.5 to 2.5 rad/s.
formats::Scene moving_linkage(const Linkage& linkage, std::mt19937& random);

}  // namespace tisserand::test_support
