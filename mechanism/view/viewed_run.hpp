// SPDX-License-Identifier: GPL-3.0-or-later
// Results file for pictures: instants, nodes in motion, bodies with a frame each.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "formats/page/page_blocks.hpp"
#include "formats/results/results.hpp"
#include "formats/scene/scene.hpp"

namespace tisserand::mechanism {

/// Motion of a frame over the T shown instants: positions (T x 3) and orientations as quaternions [w x y z] (T x 4).
/// Without rows the position or the orientation is unknown.
struct Track {
  formats::PageRows position;
  formats::PageRows rotation;

  bool has_position() const { return position.rows() > 0; }
  bool has_rotation() const { return rotation.rows() > 0; }
  /// Orientation at instant `t`; identity if it is unknown.
  Eigen::Quaterniond turn(Eigen::Index t) const {
    if (!has_rotation()) return Eigen::Quaterniond::Identity();
    return {rotation(t, 0), rotation(t, 1), rotation(t, 2), rotation(t, 3)};
  }
};

/// Body of a results file as a picture needs it: kind, nodes, and the motion of its frame.
struct ViewedBody {
  std::string name;
  std::string kind;                         ///< kind as in SimulatedBody, or "unknown" in older files
  formats::SimulatedBody file;              ///< description in the results file
  const formats::BodySpec* spec = nullptr;  ///< specification in the scene; null: the file does not hold its text
  std::vector<int> nodes;                   ///< indices of the stored nodes on the body
  /// Motion of the frame of its shapes: floating frame, part frame, or a node.
  Track frame;
  /// Whether this frame is the part frame of a body that keeps its shape.
  bool is_part_frame = false;
  /// Origin of the frame of the undeformed body, in the part frame.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  int superelement = -1;  ///< index of its superelement in the layout; -1: none
};

/// Run as a picture needs it: shown instants, motion of nodes and bodies, and the scene.
struct ViewedRun {
  std::unique_ptr<formats::ResultsReader> reader;
  std::vector<std::size_t> rows;  ///< indices of the rows of the shown instants
  Eigen::VectorXd times;
  std::vector<Track> nodes;  ///< motions of the nodes of the layout
  std::vector<ViewedBody> bodies;
  std::vector<int> body_of_node;   ///< index of the body of each node; −1: none
  formats::DrawnScene drawn;       ///< what the text of the scene says about drawing
  std::vector<std::string> notes;  ///< whole sentences on what could not be shown, and why

  const formats::ResultsLayout& layout() const { return reader->layout(); }
};

/// Reads a run with at most `instants` rows. Throws Error if the file has no nodes, no instants, or positions that are
/// not finite.
ViewedRun read_viewed_run(const std::string& file, std::size_t instants);

/// Evenly spaced row numbers, `count` of 0 .. all - 1, including the first and the last.
std::vector<std::size_t> even_rows(std::size_t all, std::size_t count);

/// Positions R^T (x - x_0) of a place in the axes of a frame (T x 3), with the pose x_0, R of the frame. `position`:
/// positions x in the world.
formats::PageRows local_positions(const Track& frame, const formats::PageRows& position);

/// Position of a stored node in the axes of the frame of its undeformed body. In older files it is that at the first
/// instant.
Eigen::Vector3d place_at_rest(const ViewedRun& run, const ViewedBody& body, int node);

/// Motion of a marker that is fixed to a moving carrier. `position` and `orientation`: pose of the marker in axes of
/// the carrier.
Track carried(const Track& carrier, const Eigen::Vector3d& position, const Eigen::Quaterniond& orientation);

}  // namespace tisserand::mechanism
