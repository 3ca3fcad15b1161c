// SPDX-License-Identifier: GPL-3.0-or-later
// Breadth-first search from the carrier of each group along its fixed joints.
#include "mechanism/build/virtual_bodies.hpp"

#include <deque>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

/// Round-off limit of the gap of a loop of ties, relative to the characteristic length and in radians.
constexpr double loop_tolerance = 1e-9;

double angle_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::Quaterniond(a).angularDistance(Eigen::Quaterniond(b));
}

/// Fixed joint with a virtual body on at least one side; markers as found by name.
struct Edge {
  const formats::JointSpec* spec;
  Marker a;
  Marker b;
  bool is_done = false;
};

class Grouping {
 public:
  Grouping(const formats::Scene& scene, const Model& model, int first, MarkerTable& markers)
      : scene_(scene), model_(model), first_(first), markers_(markers), placed_(count(), false), edges_of_(count()) {
    result_.pose.resize(count());
    for (const formats::JointSpec& spec : scene.joints) {
      if (joint_law(spec.kind).holds.size() < 6) continue;
      const Edge edge{&spec, markers.find(spec.a), markers.find(spec.b)};
      if (edge.a.node == edge.b.node) continue;
      for (const int node : {edge.a.node, edge.b.node})
        if (is_virtual(node)) edges_of_[index(node)].push_back(edges_.size());
      if (is_virtual(edge.a.node) || is_virtual(edge.b.node)) edges_.push_back(edge);
    }
  }

  TiedBodies run() {
    for (std::size_t i = 0; i < count(); ++i)
      if (!placed_[i]) place_group(group_of(i));
    // rows of followers first
    result_.ties.insert(result_.ties.end(), loops_.begin(), loops_.end());
    return std::move(result_);
  }

 private:
  std::size_t count() const { return markers_.start.size() - static_cast<std::size_t>(first_); }
  bool is_virtual(int node) const { return node >= first_; }
  std::size_t index(int node) const { return static_cast<std::size_t>(node - first_); }

  /// Virtual bodies that are tied to `start` through virtual bodies alone; `start` is the first.
  std::vector<std::size_t> group_of(std::size_t start) const {
    std::vector<std::size_t> group{start};
    std::set<std::size_t> seen{start};
    for (std::size_t at = 0; at < group.size(); ++at)
      for (const std::size_t e : edges_of_[group[at]])
        for (const int node : {edges_[e].a.node, edges_[e].b.node})
          if (is_virtual(node) && seen.insert(index(node)).second) group.push_back(index(node));
    return group;
  }

  void place_group(const std::vector<std::size_t>& group) {
    const int carrier = choose_carrier(group);
    std::deque<std::size_t> queue;
    if (is_virtual(carrier)) {
      place(index(carrier), {carrier, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()});
      result_.roots.push_back(carrier - first_);
      queue.push_back(index(carrier));
    } else {
      for (const std::size_t member : group)
        for (const std::size_t e : edges_of_[member])
          if (edges_[e].a.node == carrier || edges_[e].b.node == carrier) follow(edges_[e], queue);
    }
    for (; !queue.empty(); queue.pop_front())
      for (const std::size_t e : edges_of_[queue.front()])
        if (is_virtual(edges_[e].a.node) && is_virtual(edges_[e].b.node)) follow(edges_[e], queue);
  }

  int choose_carrier(const std::vector<std::size_t>& group) const {
    std::vector<std::string> turning;  // nodes without rotations
    int carrier = first_ + static_cast<int>(group.front());
    for (const std::size_t member : group)
      for (const std::size_t e : edges_of_[member])
        for (const int node : {edges_[e].a.node, edges_[e].b.node}) {
          if (node < 0) return node;
          if (is_virtual(node)) continue;
          if (!has_translation(model_, node) || !has_rotation(model_, node))
            turning.push_back("'" + model_.nodes[node].name + "'");
          else if (is_virtual(carrier))
            carrier = node;
        }
    if (is_virtual(carrier) && !turning.empty())
      throw Error(fmt::format("nothing determines the orientation of virtual body '{}': it is tied only to nodes "
                              "without rotations ({})",
                              name(group.front()), listed(turning)),
                  where(group.front()),
                  "tie it to a node with rotations, or connect it to three of these nodes with spherical joints");
    return carrier;
  }

  const std::string& name(std::size_t body) const { return spec(body).name; }
  const std::string& where(std::size_t body) const { return spec(body).where; }
  const formats::VirtualBodySpec& spec(std::size_t body) const {
    for (const formats::BodySpec& one : scene_.bodies)
      if (const auto* found = std::get_if<formats::VirtualBodySpec>(&one); found != nullptr && body-- == 0)
        return *found;
    throw std::out_of_range("virtual body");
  }

  void place(std::size_t body, const Marker& pose) {
    result_.pose[body] = pose;
    placed_[body] = true;
  }

  /// Pose of a node of the table on its carrier, which its whole group shares.
  Marker pose_of(int node) const { return is_virtual(node) ? result_.pose[index(node)] : Marker{node}; }
  bool is_placed(int node) const { return !is_virtual(node) || placed_[index(node)]; }

  /// Follows a tie with one placed end: places the other end, or checks the loop that it closes.
  void follow(Edge& edge, std::deque<std::size_t>& queue) {
    if (std::exchange(edge.is_done, true)) return;
    place_markers(markers_, *edge.spec, edge.a, edge.b);
    Tie tie{edge.spec->name, edge.a, edge.b, -1, Tie::Side::b, false};
    note_arms(edge);
    const bool a_is_placed = is_placed(edge.a.node), b_is_placed = is_placed(edge.b.node);
    if (a_is_placed && b_is_placed) {
      tie.is_loop = true;
    } else {
      const Marker& known = a_is_placed ? edge.a : edge.b;
      const Marker& other = a_is_placed ? edge.b : edge.a;
      tie.child = a_is_placed ? Tie::Side::b : Tie::Side::a;
      tie.parent = pose_of(known.node).follower;
      hang(index(other.node), composed(pose_of(known.node), known), other, *edge.spec);
      queue.push_back(index(other.node));
    }
    tie.a = composed(pose_of(edge.a.node), edge.a);
    tie.b = composed(pose_of(edge.b.node), edge.b);
    result_.vanished.insert(tie.name);
    if (tie.is_loop) require_closed(tie, *edge.spec);
    (tie.is_loop ? loops_ : result_.ties).push_back(std::move(tie));
  }

  void note_arms(const Edge& edge) {
    Joint joint;
    set_relations(JointKind::fixed, {}, joint);
    joint.a = edge.a;
    joint.b = edge.b;
    add_rigid_arms(markers_, *edge.spec, joint, model_.length, result_.arms);
  }

  /// Places a body so that its marker `own` is at `place_of_marker` on the carrier.
  void hang(std::size_t body, const Marker& place_of_marker, const Marker& own, const formats::JointSpec& joint) {
    Marker pose = place_of_marker;
    pose.R = place_of_marker.R * own.R.transpose();
    pose.p = place_of_marker.p - pose.R * own.p;
    pose.follower = count_of(result_.ties);
    const NodeMotion carrier = markers_.motion(pose.node);
    NodeMotion& start = markers_.start[static_cast<std::size_t>(first_) + body];
    const Eigen::Vector3d x = marker_position(pose, carrier);
    const Eigen::Matrix3d R = marker_rotation(pose, carrier);
    const double gap = (start.x - x).norm(), turn = angle_between(start.R, R);
    if (!(gap <= scene_.initial_tolerance * model_.length && turn <= scene_.initial_tolerance))
      throw Error(fmt::format("virtual body '{}' is at a distance of {:.3g} and an angle of {:.3g} rad from the pose "
                              "that joint '{}' requires (initial_tolerance allows {:.3g} and {:.3g} rad)",
                              name(body), gap, turn, joint.name, scene_.initial_tolerance * model_.length,
                              scene_.initial_tolerance),
                  where(body), "correct its pose or the markers of the joint, or raise initial_tolerance");
    start.x = x;
    start.R = R;
    place(body, pose);
  }

  void require_closed(const Tie& tie, const formats::JointSpec& joint) const {
    const double gap = (tie.a.p - tie.b.p).norm(), turn = angle_between(tie.a.R, tie.b.R);
    if (gap <= loop_tolerance * model_.length && turn <= loop_tolerance) return;
    throw Error(fmt::format("the loop of fixed joints that joint '{}' closes stays open by a distance of {:.3g} and an "
                            "angle of {:.3g} rad",
                            joint.name, gap, turn),
                joint.where, "remove the joint, or correct the markers of the loop");
  }

  const formats::Scene& scene_;
  const Model& model_;
  const int first_;
  MarkerTable& markers_;
  std::vector<bool> placed_;
  std::vector<Edge> edges_;
  std::vector<std::vector<std::size_t>> edges_of_;
  std::vector<Tie> loops_;
  TiedBodies result_;
};

}  // namespace

TiedBodies tie_virtual_bodies(const formats::Scene& scene, const Model& model, int first, MarkerTable& markers) {
  return Grouping(scene, model, first, markers).run();
}

}  // namespace tisserand::mechanism
