// SPDX-License-Identifier: GPL-3.0-or-later
// Reading of the motion of nodes and bodies from a results file.
#include "mechanism/view/viewed_run.hpp"

#include <cmath>
#include <map>
#include <optional>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

using formats::PageRows;
/// Three or four columns of one item. An item that is not-a-number everywhere lacks the quantity. Throws Error if it is
/// not-a-number at some instants only.
PageRows columns_of(const Eigen::MatrixXd& all, int item, int width, const std::string& name, const ViewedRun& run) {
  if (all.cols() == 0) return {};
  PageRows values = all.middleCols(static_cast<Eigen::Index>(item) * width, width);
  if (values.allFinite()) return values;
  if (values.array().isNaN().all()) return PageRows(0, width);
  for (Eigen::Index t = 0; t < values.rows(); ++t)
    if (!values.row(t).allFinite())
      throw Error(fmt::format("{} is not a number at t = {:.6g}{}", printable(name), run.times[t],
                              after_time(run.layout().units)),
                  run.reader->path(), "check the run: it failed at this time, or the file was changed");
  return values;
}

void read_nodes(ViewedRun& run) {
  const formats::ResultsLayout& layout = run.layout();
  const Eigen::MatrixXd position = run.reader->read_dataset("nodes/position", run.rows),
                        rotation = run.reader->read_dataset("nodes/rotation", run.rows);
  if (position.cols() == 0)
    throw Error("contains no positions of nodes, so there is nothing to show", run.reader->path(),
                "add nodes/position and nodes/rotation to output.channels, or remove this key, and run again");
  if (rotation.cols() == 0)
    run.notes.push_back("nodes/rotation is not stored: bodies move with their nodes, but do not rotate");
  for (int i = 0; i < std::ssize(layout.nodes); ++i) {
    const int item = i;
    run.nodes.push_back({columns_of(position, item, 3, "nodes/position/" + layout.nodes[i], run),
                         columns_of(rotation, item, 4, "nodes/rotation/" + layout.nodes[i], run)});
  }
}

/// Bodies of older files, from the names of their nodes.
void name_bodies(ViewedRun& run) {
  std::map<std::string, int> index;
  for (const std::string& node : run.layout().nodes) {
    const std::string name = node.substr(0, node.rfind('/'));
    if (index.emplace(name, count_of(run.bodies)).second) {
      run.bodies.emplace_back();
      run.bodies.back().name = name;
      run.bodies.back().kind = "unknown";
    }
    run.body_of_node.push_back(index.at(name));
  }
}

void take_bodies(ViewedRun& run) {
  const formats::SimulatedScene& scene = run.layout().simulated;
  if (!scene.text.empty()) {
    try {
      run.drawn = formats::read_drawn_scene(scene.text, scene.file);
    } catch (const Error& error) {
      run.notes.push_back(fmt::format("this program cannot read the text of the scene: {}", error.what()));
    }
  }
  std::map<std::string, const formats::BodySpec*> specs;
  for (const formats::BodySpec& spec : run.drawn.bodies)
    specs[std::visit([](const auto& one) { return one.name; }, spec)] = &spec;
  for (const formats::SimulatedBody& body : scene.bodies) {
    run.bodies.emplace_back();
    run.bodies.back().name = body.name;
    run.bodies.back().kind = body.kind;
    run.bodies.back().file = body;
    if (const auto spec = specs.find(body.name); spec != specs.end()) run.bodies.back().spec = spec->second;
  }
  run.body_of_node = scene.body_of_node;
}

/// Pose of a node in the part frame of a body that keeps its shape, if the scene contains it.
std::optional<formats::Pose> pose_in_part(const ViewedBody& body, const std::string& node) {
  if (node == body.name) return formats::Pose{};
  if (body.spec == nullptr) return {};
  const auto search = [&](const std::vector<formats::RigidNodeSpec>& nodes) -> std::optional<formats::Pose> {
    for (const formats::RigidNodeSpec& one : nodes)
      if (body.name + "/" + one.name == node) return one.pose;
    return {};
  };
  if (const auto* rigid = std::get_if<formats::RigidBodySpec>(body.spec)) return search(rigid->nodes);
  if (const auto* massless = std::get_if<formats::VirtualBodySpec>(body.spec)) return search(massless->nodes);
  return {};
}

/// Sets the origin of a frame that is a node.
void set_origin(const ViewedRun& run, int node, ViewedBody& body) {
  const Eigen::Matrix3Xd& reference = run.layout().simulated.node_reference;
  if (node < reference.cols()) body.origin = reference.col(node);
}

/// Finds the part frame of a body that keeps its shape, from any of its nodes; for others the node of the body's name.
bool find_part_frame(const ViewedRun& run, ViewedBody& body) {
  for (const int node : body.nodes) {
    const Track& track = run.nodes[node];
    const std::optional<formats::Pose> pose = pose_in_part(body, run.layout().nodes[node]);
    if (!pose || !track.has_position() || !track.has_rotation()) continue;
    const Eigen::Quaterniond back = pose->orientation.normalized().conjugate();
    body.frame = carried(track, back * Eigen::Vector3d(-pose->position), back);
    if (body.kind != "rigid" && body.kind != "virtual") set_origin(run, node, body);
    return true;
  }
  return false;
}

/// Takes a node as frame if the file holds none: the first node that turns, or the first that moves, without turning.
void take_node_as_frame(const ViewedRun& run, ViewedBody& body) {
  for (const bool must_turn : {true, false})
    for (const int node : body.nodes) {
      const Track& track = run.nodes[node];
      if (!track.has_position() || (must_turn && !track.has_rotation())) continue;
      body.frame = track;
      set_origin(run, node, body);
      if (track.has_rotation()) return;
      body.frame.rotation = PageRows::Zero(track.position.rows(), 4);
      body.frame.rotation.col(0).setOnes();
      return;
    }
}

void find_frames(ViewedRun& run) {
  const formats::ResultsLayout& layout = run.layout();
  const Eigen::MatrixXd position = run.reader->read_dataset("superelements/frame_position", run.rows),
                        rotation = run.reader->read_dataset("superelements/frame_rotation", run.rows);
  std::map<std::string, int> superelements;
  for (int i = 0; i < std::ssize(layout.superelements); ++i) superelements[layout.superelements[i]] = i;
  for (ViewedBody& body : run.bodies) {
    const auto found = superelements.find(body.name);
    if (found != superelements.end() && position.cols() > 0 && rotation.cols() > 0) {
      body.superelement = found->second;
      body.origin = body.file.origin;
      if (body.kind == "unknown") body.kind = "superelement";
      body.frame = {columns_of(position, found->second, 3, "superelements/frame_position/" + body.name, run),
                    columns_of(rotation, found->second, 4, "superelements/frame_rotation/" + body.name, run)};
    } else if (find_part_frame(run, body)) {
      body.is_part_frame = body.kind == "rigid" || body.kind == "virtual";
    } else {
      take_node_as_frame(run, body);
    }
  }
}

/// Removes bodies whose motion the file does not hold.
void drop_unseen(ViewedRun& run) {
  std::vector<ViewedBody> seen;
  std::vector<int> number(run.bodies.size(), -1);
  std::vector<std::string> unseen;
  for (std::size_t i = 0; i < run.bodies.size(); ++i) {
    if (!run.bodies[i].frame.has_position()) {
      unseen.push_back(run.bodies[i].name);
      continue;
    }
    number[i] = count_of(seen);
    seen.push_back(std::move(run.bodies[i]));
  }
  run.bodies = std::move(seen);
  for (int& body : run.body_of_node) body = body < 0 ? -1 : number[body];
  if (!unseen.empty()) run.notes.push_back("bodies not shown, because their motion is not stored: " + listed(unseen));
}

}  // namespace

std::vector<std::size_t> even_rows(std::size_t all, std::size_t count) {
  std::vector<std::size_t> rows;
  const std::size_t kept = std::min(all, std::max<std::size_t>(count, 2));
  for (std::size_t i = 0; i < kept; ++i)
    rows.push_back(kept < 2
                       ? 0
                       : static_cast<std::size_t>(std::llround(static_cast<double>(i) * static_cast<double>(all - 1) /
                                                               static_cast<double>(kept - 1))));
  return rows;
}

PageRows local_positions(const Track& frame, const PageRows& position) {
  PageRows local(position.rows(), 3);
  for (Eigen::Index t = 0; t < position.rows(); ++t)
    local.row(t) = frame.turn(t).conjugate() * Eigen::Vector3d((position.row(t) - frame.position.row(t)).transpose());
  return local;
}

Eigen::Vector3d place_at_rest(const ViewedRun& run, const ViewedBody& body, int node) {
  const Eigen::Matrix3Xd& reference = run.layout().simulated.node_reference;
  if (node < reference.cols()) return reference.col(node) - body.origin;
  return local_positions({body.frame.position.topRows(1), body.frame.rotation.topRows(1)},
                         run.nodes[node].position.topRows(1))
      .transpose();
}

Track carried(const Track& carrier, const Eigen::Vector3d& position, const Eigen::Quaterniond& orientation) {
  Track track{carrier.position, carrier.rotation};
  for (Eigen::Index t = 0; t < carrier.position.rows(); ++t) {
    const Eigen::Quaterniond turn = carrier.turn(t), q = turn * orientation;
    track.position.row(t) += (turn * position).transpose();
    if (carrier.has_rotation()) track.rotation.row(t) << q.w(), q.x(), q.y(), q.z();
  }
  return track;
}

ViewedRun read_viewed_run(const std::string& file, std::size_t instants) {
  ViewedRun run;
  run.reader = std::make_unique<formats::ResultsReader>(file);
  if (run.reader->rows() == 0)
    throw Error("holds no instants", run.reader->path(), "the run stopped before its first row; find out why");
  run.rows = even_rows(run.reader->rows(), instants);
  run.times = run.reader->read_dataset("time", run.rows);
  if (!run.times.allFinite())
    throw Error("/time contains values that are not numbers", run.reader->path(), "run the scene again");
  read_nodes(run);
  if (run.layout().simulated.empty()) {
    run.notes.push_back("the format of the file is older than version 1.5: it contains no shapes and joints");
    name_bodies(run);
  } else {
    take_bodies(run);
  }
  for (int i = 0; i < std::ssize(run.body_of_node); ++i)
    if (run.body_of_node[i] >= 0 && run.nodes[i].has_position()) run.bodies[run.body_of_node[i]].nodes.push_back(i);
  find_frames(run);
  drop_unseen(run);
  return run;
}

}  // namespace tisserand::mechanism
