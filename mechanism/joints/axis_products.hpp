// SPDX-License-Identifier: GPL-3.0-or-later
// Products of axes in relations, shared by their formulas in space and in the plane.
#pragma once

#include <array>

#include "mechanism/joints/relation.hpp"

namespace tisserand::mechanism {

/// Term sign · a_i·b_j, with axis i of marker A and axis j of marker B (0 x, 1 y, 2 z).
struct NormalTerm {
  int i;
  int j;
  double sign;
};

/// Sum of the first `count` terms of products of axes.
struct NormalSum {
  std::array<NormalTerm, 2> term;
  int count;
};

inline NormalSum normal_sum(const Relation& r) { return {{{{r.i, r.j, 1.0}, {}}}, 1}; }
inline constexpr NormalSum twist_sum{{{{0, 1, 1.0}, {1, 0, -1.0}}}, 2};

/// Sine and cosine of the angle of marker B from A about an axis, as sums of products of axes; the angle is atan2(sine,
/// cosine), THEORY (55). About z it is that of the rotation R_AB with z_B near z_A, exact if both axes agree.
/// About x it requires x_A normal to y_B, about y it requires y_B normal to x_A. These are the two pins of a universal
/// joint, R_AB = R_x R_y.
struct AngleTerms {
  NormalSum sine;
  NormalSum cosine;
};

inline AngleTerms angle_terms(const Relation& r) {
  if (r.i == 0) return {{{{{2, 1, 1.0}, {}}}, 1}, {{{{1, 1, 1.0}, {}}}, 1}};
  if (r.i == 1) return {{{{{0, 2, 1.0}, {}}}, 1}, {{{{0, 0, 1.0}, {}}}, 1}};
  return {{{{{1, 0, 1.0}, {0, 1, -1.0}}}, 2}, {{{{0, 0, 1.0}, {1, 1, 1.0}}}, 2}};
}

}  // namespace tisserand::mechanism
