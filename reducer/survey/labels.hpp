// SPDX-License-Identifier: GPL-3.0-or-later
// Places of the names of surfaces in a picture.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "reducer/survey/projection.hpp"

namespace tisserand::reducer {

/// Label in a picture: text, position and the point that it names.
struct PictureLabel {
  std::string text;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();     ///< middle of the text
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< point on the surface that the label names
  bool is_led = false;                              ///< a line joins `at` and `point`
};

/// Size of a text in pixels.
Eigen::Vector2d text_size(const std::string& text);

/// Whether the text fits on the visible surface at `seen`.
bool fits_inside(const SeenPlace& seen, const std::string& text);

/// Placer of the labels of one picture. It first places those that fit on their surface, then the others at the
/// nearest free place, preferably on the background. A label without a free place is omitted.
class LabelPlacer {
 public:
  explicit LabelPlacer(const PictureProjection& projection) : projection_(projection) {}

  void write_inside(const std::string& text, const SeenPlace& seen);
  bool write_beside(const std::string& text, const SeenPlace& seen);
  const std::vector<PictureLabel>& labels() const { return labels_; }

 private:
  bool is_free(const Eigen::Vector2d& at, const Eigen::Vector2d& size) const;

  const PictureProjection& projection_;
  std::vector<PictureLabel> labels_;
};

}  // namespace tisserand::reducer
