// SPDX-License-Identifier: GPL-3.0-or-later
// Road: height of the ground under tyres with its gradient, in axes of the road, which are at rest.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/math/dual.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/forces/curve.hpp"
#include "mechanism/tyres/height_grid.hpp"
#include "mechanism/tyres/reference_line.hpp"

namespace tisserand::mechanism {

/// Height z = h(x, y) of a road with its slopes ∂h/∂x and ∂h/∂y, in axes of the road.
struct RoadHeight {
  double value = 0.0;
  double by_x = 0.0;
  double by_y = 0.0;
};

/// Piece of one track of a road: height over x. Outside of the piece it is 0, or for curves the height of the near end.
struct RoadPiece {
  formats::RoadPieceShape shape = formats::RoadPieceShape::cosine;
  double start = 0.0, length = 0.0, height = 0.0, ramp = 0.0;
  Curve curve = 0.0;

  /// Height and slope of the piece at x.
  RoadHeight at(double x) const;
};

/// Surface of a road by heights on a grid, along a line if it has one, else along x.
struct RoadSurface {
  HeightGrid grid;
  std::optional<ReferenceLine> line;
};

/// Reason why there is no road at a place: it is beyond an end, or in a hole.
struct RoadLack {
  bool hole = false;
  char axis = 'x';                          ///< x, y, or u, v along and beside a line
  double at = 0.0, begin = 0.0, end = 0.0;  ///< place and limits on the axis
  Eigen::Vector2d place;                    ///< the place: x, y, or u, v along a line
};

/// Road at rest: height of the ground and friction over x and y, in axes of the road.
struct Road {
  std::string name;
  Eigen::Vector3d p = Eigen::Vector3d::Zero();      ///< origin of the road, from the origin of the model
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< R_WR: axes of the road in world axes
  std::vector<RoadPiece> left, right;               ///< tracks; right: empty if there is one track
  double transition = 0.0;                          ///< width about y = 0 where tracks blend; 0: one track
  double begin, end;                                ///< limits of the road in x, or in u along a line
  std::shared_ptr<const RoadSurface> surface;       ///< replaces the tracks; null: none
  /// Factors of the friction of tyres on the left (y > 0, along a line v > 0) and on the right.
  double friction = 1.0, friction_right = 1.0;

  /// Makes a road. `origin`: world position that is the origin of the model (Model::origin).
  Road(const formats::RoadSpec& spec, const Eigen::Vector3d& origin);
  /// Height and slopes at a place.
  RoadHeight at(double x, double y) const;
  /// Reason why there is no road at a place. It is absent if the road exists there.
  std::optional<RoadLack> lack(double x, double y) const;
  /// Factor of the friction of tyres at a place. `strip`: width about y = 0 (along a line v = 0) in which the factors
  /// of both sides blend.
  double friction_at(double x, double y, double strip) const;
};

inline double road_height(const Road& road, double x, double y) { return road.at(x, y).value; }
inline Dual road_height(const Road& road, const Dual& x, const Dual& y) {
  const RoadHeight h = road.at(x.value, y.value);
  return {h.value, h.by_x * x.derivative + h.by_y * y.derivative};
}

}  // namespace tisserand::mechanism
