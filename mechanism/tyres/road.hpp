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

/// Height z = h(x, y) with ∂h/∂x and ∂h/∂y.
struct RoadHeight {
  double value = 0.0;
  double by_x = 0.0;
  double by_y = 0.0;
};

/// Piece of one track: height over x, 0 outside (curves: as at their ends).
struct RoadPiece {
  formats::RoadPieceShape shape = formats::RoadPieceShape::cosine;
  double start = 0.0, length = 0.0, height = 0.0, ramp = 0.0;
  Curve curve = 0.0;

  /// Height and its slope at x.
  RoadHeight at(double x) const;
};

/// Heights on a grid, along a line or along x.
struct RoadSurface {
  HeightGrid grid;
  std::optional<ReferenceLine> line;
};

/// Reason why there is no road at a place: it is beyond an end, or in a hole.
struct RoadLack {
  bool hole = false;
  char axis = 'x';                          ///< x, y; u, v along and beside a line
  double at = 0.0, begin = 0.0, end = 0.0;  ///< place and limits on that axis
  Eigen::Vector2d place;                    ///< x, y or u, v
};

struct Road {
  std::string name;
  Eigen::Vector3d p = Eigen::Vector3d::Zero();      ///< origin, relative to that of the model
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< R_WR
  std::vector<RoadPiece> left, right;               ///< right: empty if one track is the whole road
  double transition = 0.0;  ///< width of the strip about y = 0 where the tracks are blended; 0: one track
  double begin, end;        ///< limits of the road in x (in u along a line)
  std::shared_ptr<const RoadSurface> surface;   ///< instead of the tracks; null: none
  double friction = 1.0, friction_right = 1.0;  ///< factors of the friction of tyres where y > 0 (v > 0), and y < 0

  /// `origin`: origin of the model.
  Road(const formats::RoadSpec& spec, const Eigen::Vector3d& origin);
  RoadHeight at(double x, double y) const;
  /// Reason why the road is missing at a place; absent: it exists there.
  std::optional<RoadLack> lack(double x, double y) const;
  /// Factor of the friction. `strip`: width about y = 0 in which the sides blend.
  double friction_at(double x, double y, double strip) const;
};

inline double road_height(const Road& road, double x, double y) { return road.at(x, y).value; }
inline Dual road_height(const Road& road, const Dual& x, const Dual& y) {
  const RoadHeight h = road.at(x.value, y.value);
  return {h.value, h.by_x * x.derivative + h.by_y * y.derivative};
}

}  // namespace tisserand::mechanism
