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

/// Poses over the shown instants: T x 3 and T x 4 [w x y z]. Without rows there is none.
struct Track {
  formats::PageRows position;
  formats::PageRows rotation;

  bool has_position() const { return position.rows() > 0; }
  bool has_rotation() const { return rotation.rows() > 0; }
  Eigen::Quaterniond turn(Eigen::Index t) const {
    if (!has_rotation()) return Eigen::Quaterniond::Identity();
    return {rotation(t, 0), rotation(t, 1), rotation(t, 2), rotation(t, 3)};
  }
};

struct ViewedBody {
  std::string name;
  std::string kind;  ///< as in SimulatedBody, or "unknown" in older files
  formats::SimulatedBody file;
  const formats::BodySpec* spec = nullptr;           ///< null: the file does not hold the text of the scene
  std::vector<int> nodes;                            ///< stored nodes on it
  Track frame;                                       ///< frame of its shapes: floating frame, part frame, or a node
  bool is_part_frame = false;                        ///< the frame is the part frame of a body that keeps its shape
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< origin of the frame of the undeformed body, in the part frame
  int superelement = -1;                             ///< index in the layout; -1: none
};

struct ViewedRun {
  std::unique_ptr<formats::ResultsReader> reader;
  std::vector<std::size_t> rows;  ///< rows of the shown instants
  Eigen::VectorXd times;
  std::vector<Track> nodes;  ///< nodes of the layout
  std::vector<ViewedBody> bodies;
  std::vector<int> body_of_node;
  formats::DrawnScene drawn;       ///< scene from its text
  std::vector<std::string> notes;  ///< whole sentences on what could not be shown, and why

  const formats::ResultsLayout& layout() const { return reader->layout(); }
};

/// Reads a run with at most `instants` rows. Throws Error: no nodes, no instants, positions not finite.
ViewedRun read_viewed_run(const std::string& file, std::size_t instants);

/// `count` evenly spaced rows of 0 .. all - 1, with the first and the last.
std::vector<std::size_t> even_rows(std::size_t all, std::size_t count);

/// Positions R^T (x - x_0) of a place in the axes of a frame, T x 3.
formats::PageRows local_positions(const Track& frame, const formats::PageRows& position);

/// Position of a stored node in the axes of the frame of its undeformed body; in older files at the first instant.
Eigen::Vector3d place_at_rest(const ViewedRun& run, const ViewedBody& body, int node);

/// Pose of a marker on a carrier.
Track carried(const Track& carrier, const Eigen::Vector3d& position, const Eigen::Quaterniond& orientation);

}  // namespace tisserand::mechanism
