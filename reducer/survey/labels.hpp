// Where the names of surfaces are written in a picture of them.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "reducer/survey/projection.hpp"

namespace tisserand::reducer {

struct PictureLabel {
  std::string text;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();     ///< middle of the text
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< on the surface
  bool is_led = false;                              ///< a line joins both
};

/// Size of a text in pixels.
Eigen::Vector2d text_size(const std::string& text);

/// Whether the text can be written on the surface.
bool fits_inside(const SeenPlace& seen, const std::string& text);

/// Labels of one picture: first those that fit on their surface, then those beside it, at the nearest place that is
/// free, better on the background. What finds no place is left out.
class LabelPlacer {
 public:
  explicit LabelPlacer(const Projection& projection) : projection_(projection) {}

  void write_inside(const std::string& text, const SeenPlace& seen);
  bool write_beside(const std::string& text, const SeenPlace& seen);
  const std::vector<PictureLabel>& labels() const { return labels_; }

 private:
  bool is_free(const Eigen::Vector2d& at, const Eigen::Vector2d& size) const;

  const Projection& projection_;
  std::vector<PictureLabel> labels_;
};

}  // namespace tisserand::reducer
