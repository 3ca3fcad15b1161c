// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes of moving objects over time.
#include "mechanism/view/motion_extent.hpp"

#include <algorithm>
#include <cmath>

namespace tisserand::mechanism {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr std::size_t most_instants = 50;
/// Limit in sizes at one instant. A rod that turns about its end fills 2.83 times its own diagonal.
constexpr double leaves_its_place = 3.0;

/// Row of a track at row `t` of the run; the only row of a track at rest.
Eigen::Index row_at(const Track& track, std::size_t t) {
  return std::min(static_cast<Eigen::Index>(t), track.position.rows() - 1);
}

AlignedBox3d box_of(const formats::PageRows& position) {
  AlignedBox3d box;
  if (position.rows() == 0) return box;
  box.extend(Vector3d(position.colwise().minCoeff().transpose()));
  box.extend(Vector3d(position.colwise().maxCoeff().transpose()));
  return box;
}

}  // namespace

MotionExtent::MotionExtent(const ViewedRun& run)
    : run_(run), rows_(even_rows(run.rows.size(), most_instants)), at_(rows_.size()) {
  const auto add_points = [this](const Track& track) {
    box_.extend(box_of(track.position));
    for (std::size_t k = 0; track.has_position() && k < rows_.size(); ++k)
      at_[k].extend(Vector3d(track.position.row(row_at(track, rows_[k])).transpose()));
  };
  for (const Track& node : run.nodes) add_points(node);
  for (const ViewedBody& body : run.bodies) add_points(body.frame);
  for (const formats::SimulatedLink& link : run.layout().simulated.links) {
    if (link.kind == "tyre" || link.kind.starts_with("load/")) continue;
    const std::size_t drawn = link.kind.starts_with("joint/") ? 1 : 2;  // a joint is drawn at its first marker
    for (std::size_t k = 0; k < drawn; ++k) {
      if (link.ends[k].node != formats::SimulatedMarker::ground) continue;
      for (AlignedBox3d& box : at_) box.extend(link.ends[k].position);
      box_.extend(link.ends[k].position);
    }
  }
}

void MotionExtent::add(const formats::Surface& surface, const Track& frame) {
  AlignedBox3d local;
  for (const Vector3d& vertex : surface.vertices) local.extend(vertex);
  if (local.isEmpty()) return;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Eigen::Index t = row_at(frame, rows_[i]);
    for (int k = 0; k < 8; ++k)
      at_[i].extend(Vector3d(frame.position.row(t).transpose() +
                             frame.turn(t) * local.corner(static_cast<AlignedBox3d::CornerType>(k))));
    box_.extend(at_[i]);
  }
}

double MotionExtent::size() const {
  double size = 0.0;
  for (const AlignedBox3d& box : at_)
    if (!box.isEmpty()) size = std::max(size, box.diagonal().norm());
  return size;
}

int MotionExtent::followed() const {
  if (box_.isEmpty() || !(box_.diagonal().norm() > leaves_its_place * size())) return -1;
  int best = -1;
  double heaviest = -1.0;
  for (int b = 0; b < std::ssize(run_.bodies); ++b) {
    const ViewedBody& body = run_.bodies[b];
    const double mass = std::isfinite(body.file.mass) ? body.file.mass : 0.0;
    const bool goes = box_of(body.frame.position).diagonal().norm() > 0.5 * box_.diagonal().norm();
    if (goes && mass > heaviest) heaviest = mass, best = b;
  }
  return best;
}

}  // namespace tisserand::mechanism
