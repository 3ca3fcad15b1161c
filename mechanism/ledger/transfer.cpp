// Bodies by their names, places of one model on the nodes of the other.
#include "mechanism/ledger/transfer.hpp"

#include <algorithm>
#include <map>
#include <string>

#include <Eigen/Cholesky>

#include "common/error.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Motion of a node that has translations and rotations.
struct Motion6 {
  Vector3d x;
  Matrix3d R;
  Vector3d xd;
  Vector3d Omega;  ///< material
};

/// Of a marker on the node, from that of the marker: rigid.
Motion6 carrier_of(const Marker& marker, const Motion6& place) {
  Motion6 node;
  node.R = place.R * marker.R.transpose();
  node.x = place.x - node.R * marker.p;
  node.Omega = marker.R * place.Omega;
  node.xd = place.xd - node.R * node.Omega.cross(marker.p);
  return node;
}

Motion6 motion_of_marker(const Marker& marker, const NodeMotion& node) {
  return {marker_position(marker, node), marker_rotation(marker, node), marker_velocity(marker, node),
          marker.R.transpose() * node.Omega};
}

/// The centre of mass of the floating frame with the momenta of the body: (Φᵀ M̄ Φ) V = Φᵀ M̄ ẏ in axes of the frame,
/// V = [ẋ₀; Ω₀].
Motion6 rigid_motion(const SuperelementBody& body, const SuperelementScratch& scratch) {
  const LocalMotion<double>& motion = scratch.motion;
  const Eigen::MatrixXd rigid = rigid_columns(body);
  const Eigen::Index nb = body.boundary_size, m = body.modes;
  Eigen::MatrixXd M(nb + m, nb + m);
  M << body.M_BB, body.M_BI, body.M_IB, Eigen::MatrixXd::Identity(m, m);
  Eigen::VectorXd rate(nb + m);
  rate << motion.rate_B, motion.rate_I;
  const Eigen::Matrix<double, 6, 1> V = (rigid.transpose() * M * rigid).ldlt().solve(rigid.transpose() * (M * rate));
  const Vector3d center = deformed_center_of_mass<double>(body, motion);
  Motion6 result;
  result.R = motion.R0;
  result.x = motion.x0 + motion.R0 * center;
  result.Omega = V.tail<3>();
  result.xd = motion.R0 * (V.head<3>() + result.Omega.cross(body.center_of_mass));
  return result;
}

class Transfer {
 public:
  Transfer(const Model& from, const State& state, const Model& to) : from_(from), to_(to), state_(state), now_(from) {
    evaluate(from, state, now_);
    update_modal_nodes(from, now_);
    for (std::size_t i = 0; i < from.places.size(); ++i) places_[from.places[i].name] = static_cast<int>(i);
  }

  State result() const {
    State state(to_.sizes);
    state.time() = state_.time();
    state.load_time() = state_.load_time();
    state.step() = state_.step();
    state.active().setOnes();
    for (std::size_t i = 0; i < to_.nodes.size(); ++i) set_node(static_cast<int>(i), state);
    set_superelements(state);
    set_modal_bodies(state);
    set_treads(state);
    set_hinges(state);
    return state;
  }

 private:
  /// A place of the node that both models have, or what becomes rigid; bodies without either stand as they were built.
  Motion6 motion_of_node(int node) const {
    for (const RigidBody& body : to_.rigid_bodies)
      for (std::size_t i = 0; i < from_.superelements.size(); ++i)
        if (body.node == node && from_.superelements[i].name == body.name)
          return rigid_motion(body_of(from_, i), now_.superelements[i]);
    for (const Place& place : to_.places) {
      if (place.marker.node != node) continue;
      const auto found = places_.find(place.name);
      if (found == places_.end()) continue;
      const Marker& marker = from_.places[found->second].marker;
      return carrier_of(place.marker, motion_of_marker(marker, mechanism::motion_of(now_, marker.node)));
    }
    throw Error(fmt::format("node '{}' has no counterpart", to_.nodes[node].name), "",
                "leave this effect out with --effect");
  }

  void set_node(int index, State& state) const {
    const Node& node = to_.nodes[index];
    const Motion6 motion = motion_of_node(index);
    state.x().col(index) = motion.x;
    state.Q().col(index) = wxyz(Eigen::Quaterniond(motion.R).normalized());
    if (node.translation >= 0) set_translation(to_, motion.xd, node.translation, state.v());
    if (node.rotation >= 0) set_rotation(to_, motion.Omega, node.rotation, state.v());
  }

  void set_superelements(State& state) const {
    for (std::size_t i = 0; i < to_.superelements.size(); ++i) {
      const SuperelementUse& use = to_.superelements[i];
      const auto own = std::ranges::find(from_.superelements, use.name, &SuperelementUse::name);
      if (own == from_.superelements.end()) {  // was rigid: its frame has the axes of the body
        const auto rigid = std::ranges::find(from_.rigid_bodies, use.name, &RigidBody::name);
        if (rigid != from_.rigid_bodies.end()) state.frames().col(i) = state_.Q().col(rigid->node);
        continue;
      }
      const auto k = static_cast<std::size_t>(own - from_.superelements.begin());
      state.frames().col(i) = state_.frames().col(k);
      const int modes = std::min(body_of(to_, i).modes, body_of(from_, k).modes);
      const int at = to_.internal_offset[i], there = from_.internal_offset[k];
      state.y().segment(at, modes) = state_.y().segment(there, modes);
      state.v().segment(to_.sizes.boundary + at, modes) = state_.v().segment(from_.sizes.boundary + there, modes);
    }
  }

  void set_modal_bodies(State& state) const {
    for (const ModalBody& body : to_.modal_bodies) {
      const auto own = std::ranges::find(from_.modal_bodies, body.name, &ModalBody::name);
      if (own == from_.modal_bodies.end()) continue;
      const int modes = std::min(body.modes, own->modes);
      state.w().segment(body.offset, modes) = state_.w().segment(own->offset, modes);
      state.v().segment(to_.sizes.first_modal() + body.offset, modes) =
          state_.v().segment(from_.sizes.first_modal() + own->offset, modes);
    }
  }

  void set_treads(State& state) const {
    for (std::size_t i = 0; i < to_.tyres.size(); ++i) {
      const int at = to_.tyres[i].lag, there = from_.tyres[i].lag;
      if (!to_.tyres[i].relaxes()) continue;
      state.w().segment<2>(at) = state_.w().segment<2>(there);
      state.v().segment<2>(to_.sizes.first_modal() + at) = state_.v().segment<2>(from_.sizes.first_modal() + there);
    }
  }

  void set_hinges(State& state) const {
    for (const Coordinate& coordinate : to_.coordinates) {
      if (coordinate.turn < 0) continue;
      const auto own = std::ranges::find(from_.coordinates, coordinate.name, &Coordinate::name);
      if (own != from_.coordinates.end() && own->turn >= 0)
        state.hinges()[coordinate.turn] = state_.hinges()[own->turn];
    }
  }

  const Model& from_;
  const Model& to_;
  const State& state_;
  Evaluation now_;
  std::map<std::string, int> places_;
};

}  // namespace

bool share_states(const Model& a, const Model& b) {
  const auto same_nodes = [&] { return std::ranges::equal(a.nodes, b.nodes, {}, &Node::name, &Node::name); };
  const auto same_sizes = [](const Sizes& s, const Sizes& t) {
    return s.nodes == t.nodes && s.boundary == t.boundary && s.modal == t.modal && s.internal == t.internal &&
           s.constraints == t.constraints && s.superelements == t.superelements && s.hinges == t.hinges;
  };
  return same_sizes(a.sizes, b.sizes) && same_nodes();
}

State transfer(const Model& from, const State& state, const Model& to) { return Transfer(from, state, to).result(); }

}  // namespace tisserand::mechanism
