// SPDX-License-Identifier: GPL-3.0-or-later
// Checks that each item stays in the plane, then new numbers of the coordinates.
#include "mechanism/build/planar.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error.hpp"
#include "mechanism/bodies/planar/planar_body.hpp"
#include "mechanism/bodies/planar/planar_modal_body.hpp"
#include "mechanism/joints/relation.hpp"
#include "mechanism/model/bodies.hpp"
#include "mechanism/model/element_map.hpp"
#include "mechanism/model/forces.hpp"
#include "mechanism/tyres/contact.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

std::string text_of(const Vector3d& v) {
  const auto clean = [](double x) { return std::abs(x) < 1e-9 ? 0.0 : x; };
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", clean(v.x()), clean(v.y()), clean(v.z()));
}

/// Checks the scene in the axes of its plane, and throws Error that names what leaves it.
class PlanarCheck {
 public:
  explicit PlanarCheck(Construction& c) : c_(c), model_(c.model) {}

  void bodies() const {
    for_each_body(model_, [&](const auto& body) {
      require_in_plane(body.gravity, body.gravity.norm(), fmt::format("gravity of body '{}'", name_of(model_, body)),
                       "rotate it into the plane");
    });
    for (const RigidBody& body : model_.rigid_bodies)
      require_normal(body.inertia.col(2) - body.inertia(2, 2) * Vector3d::UnitZ(), body.inertia.trace(),
                     fmt::format("the inertia of body '{}' about the normal", body.name),
                     "give it a principal axis along the normal (products of inertia 0)");
    beams();
  }

  void velocities() const {
    double fastest = 0.0;
    for (const NodeMotion& node : c_.markers.start)
      fastest = std::max({fastest, node.xd.norm(), model_.length * node.Omega.norm()});
    for (const BodyStart& body : c_.starts) {
      const Vector3d v = body.velocity.value_or(Vector3d::Zero()),
                     omega = body.angular_velocity.value_or(Vector3d::Zero());
      require_in_plane(v, std::max(fastest, v.norm()), fmt::format("the velocity of body '{}'", body.name),
                       "give it a velocity in the plane");
      require_normal(omega, std::max(fastest / model_.length, omega.norm()),
                     fmt::format("the angular velocity of body '{}'", body.name), "let it rotate about the normal");
    }
  }

  /// Checks the joint coordinates of `initial`.
  void starts(const std::vector<CoordinateStart>& initial) const {
    for (const CoordinateStart& one : initial) coordinate(one.coordinate, fmt::format("initial '{}'", one.name));
  }

  /// Checks steady rotations of statics and modes.
  void rotations() const {
    const auto require = [this](const std::optional<Vector3d>& omega, const char* name) {
      if (omega)
        require_normal(model_.axes.transpose() * *omega, omega->norm(), name, "let the scene rotate about the normal");
    };
    const std::optional<formats::RotationSpec>& steady = c_.scene.statics.rotation;
    if (c_.scene.analysis == formats::AnalysisKind::statics)
      require(steady ? std::optional(steady->angular_velocity) : std::nullopt, "statics: the angular velocity");
    if (c_.scene.analysis == formats::AnalysisKind::modes) require(c_.scene.modes.rotation, "modes: rotation");
  }

  void forces() const {
    coordinates();
    tyres();
    for (const Bushing& one : model_.bushings) bushing(one);
    for (const Load& one : model_.loads) load(one);
    for (const PartLoad& one : model_.part_loads) {
      if (one.node < 0) continue;
      const std::string name = fmt::format("part load '{}'", one.name), remedy = "remove it";
      require_in_plane(one.force, one.force.norm(), name, remedy);
      require_normal(one.moment, std::max(one.moment.norm(), model_.length * one.force.norm()), "the moment of " + name,
                     remedy);
    }
  }

  void tyres() const {
    for (const Tyre& tyre : model_.tyres) {
      const NodeMotion& wheel = c_.markers.start[tyre.wheel.node];
      const std::string name = fmt::format("tyre '{}'", tyre.name);
      require_normal(marker_rotation(tyre.wheel, wheel).col(1), 1.0, "the axle of " + name,
                     "make it parallel to the normal");
      if (std::abs(tyre.wheel.p.z()) > planar_share * model_.length)
        leave(fmt::format("{} rolls {:.6g} away from the plane of its node", name, tyre.wheel.p.z()),
              "move it into the plane");
      road(model_.roads[tyre.road], tyre, marker_position(tyre.wheel, wheel));
      if (const double sideways = sideways_share(tyre); !(sideways <= planar_share))
        leave(fmt::format("{} has a side force of {:.3g} of its load while it rolls straight", name, sideways),
              "set the scale factors of its shifts to 0 (LHY, LVY, LVYKA, LVMX, LRES, LS)");
    }
  }

  /// Checks the elements that act on modal bodies.
  void attachments() const {
    const auto pairs = [this](const auto& pool, const char* kind) {
      for (const auto& one : pool)
        for (const Marker* marker : {&one.a, &one.b}) attachment(*marker, fmt::format("{} '{}'", kind, one.name));
    };
    pairs(model_.joints, "joint");
    pairs(model_.coordinates, "coordinate");
    pairs(model_.channels, "channel");
    for_each_force(model_, [this](auto traits, const auto& force) {
      for (const auto marker : traits.markers)
        attachment(force.*marker, fmt::format("{} '{}'", traits.kind, force.name));
    });
  }

  /// Whether all quantities of the coordinate lie in the plane.
  bool stays(const Coordinate& one) const {
    return has_planar_axes(one.relation, one.a, one.b) &&
           parts_of(evaluate(one.relation, markers(one.a, one.b)).G, one.a, one.b).stays();
  }

  /// Keeps the equations of a joint in the plane.
  void reduce(Joint& joint) const {
    const std::string name = fmt::format("joint '{}'", joint.name);
    if (joint.coincident) {
      const MarkerPair pair = markers(joint.a, joint.b);
      JointTerms terms;
      joint_constraints(joint, pair.node_a, pair.node_b, terms);
      for (int row = 0; row < 3; ++row) {
        const Parts parts = parts_of(Row12(terms.B.row(row)), joint.a, joint.b);
        if (row < 2 && !parts.stays())
          leave(fmt::format("{} is {:.6g} and {:.6g} away from the planes of the nodes that it connects", name,
                            joint.a.node < 0 ? 0.0 : joint.a.p.z(), joint.b.node < 0 ? 0.0 : joint.b.p.z()),
                "move it into their planes");
      }
      if (!(std::abs(terms.phi[2]) <= planar_share * model_.length))
        leave(fmt::format("{} is open by {:.6g} along the normal", name, terms.phi[2]), "close it at the start");
    }
    int kept = 0;
    for (int k = 0; k < joint.relation_count; ++k)
      if (relation_stays(name, joint.relations[k], joint.constant, joint.a, joint.b)) {
        joint.relations[kept] = joint.relations[k];
        joint.relations[kept++].planar = true;
      }
    joint.relation_count = kept;
    joint.planar = true;
    TISSERAND_ENSURE(joint.size() <= CarrierVector<2>::SizeAtCompileTime, "{} equations in the plane of {}",
                     joint.size(), name);
  }

 private:
  /// Magnitudes of a row of derivatives by [x_A Θ_A x_B Θ_B] in and out of the plane, rotations over the length.
  struct Parts {
    double in = 0.0, out = 0.0;
    bool stays() const { return out <= planar_share * in; }
    bool leaves() const { return in <= planar_share * out; }
  };
  Parts parts_of(const Row12& row, const Marker& a, const Marker& b) const {
    Parts parts;
    for (int k = 0; k < 12; ++k) {
      if ((k < 6 ? a : b).node < 0) continue;
      const bool turns = k % 6 >= 3;
      const double value = row[k] / (turns ? model_.length : 1.0);
      double& part = turns == (k % 3 == 2) ? parts.in : parts.out;
      part = std::hypot(part, value);
    }
    return parts;
  }

  [[noreturn]] void leave(const std::string& what, const std::string& remedy) const {
    throw Error(
        fmt::format("effects: the scene is not planar: {} (normal of the plane {})", what, text_of(model_.axes.col(2))),
        c_.scene.planar_at, remedy + ", or set planar: off");
  }

  /// Throws Error if the component of `v` out of the plane is not negligible relative to `size`.
  void require_in_plane(const Vector3d& v, double size, const std::string& what, const std::string& remedy) const {
    if (!(std::abs(v.z()) <= planar_share * size))
      leave(fmt::format("{} has a component of {:.6g} normal to the plane", what, v.z()), remedy);
  }

  void require_normal(const Vector3d& v, double size, const std::string& what, const std::string& remedy) const {
    const double across = v.head<2>().norm();
    if (!(across <= planar_share * size))
      leave(fmt::format("{} has a component of {:.6g} parallel to the plane", what, across), remedy);
  }

  void require_apart(const MatrixXd& A, const std::vector<bool>& in_plane, const std::string& what) const {
    const double round_off = 1e-12 * A.cwiseAbs().maxCoeff();  // of matrices that were rotated to the axes of the plane
    for (Eigen::Index i = 0; i < A.rows(); ++i)
      for (Eigen::Index j = 0; j < A.cols(); ++j) {
        const double size = std::sqrt(std::abs(A(i, i) * A(j, j)));
        if (in_plane[i] != in_plane[j] && !(std::abs(A(i, j)) <= std::max(planar_share * size, round_off)))
          leave(fmt::format("{} couples motion in the plane with motion out of the plane: entry {:.3g}, diagonal "
                            "entries {:.3g} and {:.3g}",
                            what, A(i, j), A(i, i), A(j, j)),
                "make it symmetric about the plane");
      }
  }

  void coordinate(int index, const std::string& user) const {
    const Coordinate& one = model_.coordinates[index];
    const Parts parts = parts_of(evaluate(one.relation, markers(one.a, one.b)).G, one.a, one.b);
    if (!parts.stays())
      leave(
          fmt::format(
              "{} acts along coordinate '{}', which is not in the plane ({:.3g} out of the plane, {:.3g} in the plane)",
              user, one.name, parts.out, parts.in),
          "use a coordinate in the plane");
  }

  void coordinates() const {
    for (const Coupling& coupling : model_.couplings)
      for (const CouplingTerm& term : coupling.terms) coordinate(term.coordinate, coupling.name);
    for (const Spring& spring : model_.springs) coordinate(spring.coordinate, fmt::format("spring '{}'", spring.name));
    for (const Channel& channel : model_.channels)
      if (channel.coordinate >= 0) coordinate(channel.coordinate, fmt::format("channel '{}'", channel.name));
  }

  void attachment(const Marker& marker, const std::string& user) const {
    const int modal = modal_node(model_, marker.node);
    if (modal < 0) return;
    if (const ModalNode& node = model_.modal_nodes[modal]; node.x.z() != 0.0)
      leave(fmt::format("{} is on node '{}' of modal body '{}', {:.6g} away from the plane through its centre of mass",
                        user, node.name, model_.modal_bodies[node.body].name, node.x.z()),
            "use a node in this plane");
  }

  void bushing(const Bushing& one) const {
    const MarkerPair pair = markers(one.a, one.b);
    Bushing bushing = one;
    BushingTerms terms;
    evaluate(bushing, pair, 0.0, terms);
    if (bushing.free_at_start) bushing.free = terms.deflection;
    evaluate(bushing, pair, 0.0, terms);
    const std::string name = fmt::format("bushing '{}'", one.name);
    const Parts parts = parts_of(terms.force.transpose(), one.a, one.b);
    if (!parts.stays() && parts.out > 0.0)
      leave(fmt::format("{} has a force of {:.3g} out of the plane ({:.3g} in the plane)", name, parts.out, parts.in),
            "choose its `preload` and `free` in the plane");
    std::vector<bool> in_plane;
    for (int k = 0; k < 12; ++k) in_plane.push_back(k % 6 < 3 ? k % 3 < 2 : k % 3 == 2);
    Square12 A;
    for (const TangentCoefficients& c : {TangentCoefficients{0.0, 1.0, 0.0}, TangentCoefficients{0.0, 0.0, 1.0}}) {
      tangent(bushing, pair, terms, c, A);
      for (const auto& [node, first] : {std::pair(one.a.node, 0), std::pair(one.b.node, 6)})
        if (node < 0) {  // loads on ground move nothing
          A.middleRows<6>(first).setZero();
          A.middleCols<6>(first).setZero();
        }
      require_apart(A, in_plane, name);
    }
  }

  /// Checks a road: it may slope along the plane only, and be level across it where the wheel rolls.
  void road(const Road& one, const Tyre& tyre, const Vector3d& center) const {
    const std::string name = fmt::format("the normal of road '{}'", one.name);
    require_in_plane(one.R.col(2), 1.0, name, "incline the road along the plane only");
    if (one.surface)
      leave(fmt::format("road '{}' has heights over a surface", one.name),
            "give its heights along the plane as a curve");
    if (one.left.empty() && one.right.empty()) return;
    require_normal(one.R.col(1), 1.0, fmt::format("the y axis of road '{}'", one.name),
                   "let its x axis lie in the plane");
    const double beside = std::abs(one.R.col(1).dot(center - one.p));
    if (one.transition > 0.0 && beside < 0.5 * one.transition + base_of_plane * tyre.radius)
      leave(fmt::format("tyre '{}' rolls {:.6g} away from the middle of road '{}', where one track changes "
                        "into the other",
                        tyre.name, beside, one.name),
            "put the wheel on one of its tracks");
  }

  /// Checks a load: components that vary must act in the plane, the constant ones in sum.
  void load(const Load& one) const {
    const bool force = one.kind == formats::LoadKind::force;
    const std::string name = fmt::format("{} '{}'", force ? "force" : "moment", one.name);
    const Eigen::Matrix3d axes = one.axes == formats::LoadAxes::world ? *one.turn : one.at.R;
    Vector3d sum = Vector3d::Zero();
    double size = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double* constant = std::get_if<double>(&one.components[k]);
      const Vector3d direction = axes.col(k);
      const Vector3d out = force ? Vector3d(0, 0, direction.z()) : Vector3d(direction.x(), direction.y(), 0);
      if (constant == nullptr && out.norm() > planar_share)
        leave(fmt::format("component {} of {} varies, and {:.3g} of it acts out of the plane", "xyz"[k], name,
                          out.norm()),
              "set components out of the plane to the number 0");
      sum += constant == nullptr ? Vector3d(Vector3d::Zero()) : Vector3d(*constant * out);
      size = std::max(size, constant == nullptr ? 0.0 : std::abs(*constant));
    }
    if (sum.norm() > planar_share * size)
      leave(fmt::format("{} has a component of {:.6g} out of the plane", name, sum.norm()), "remove this component");
    if (force && one.at.node >= 0 && std::abs(one.at.p.z()) > planar_share * model_.length)
      leave(fmt::format("{} acts {:.6g} away from the plane of its node", name, one.at.p.z()),
            "move it into the plane");
  }

  /// Checks mass and stiffness of beams at the start.
  void beams() const {
    const std::vector<bool> node{true, true, false, false, false, true};
    const auto check = [&]<int N>(const Pool<BeamElement<N>>& pool) {
      std::vector<bool> in_plane;
      for (int k = 0; k < 6 * N; ++k) in_plane.push_back(node[k % 6]);
      Eigen::Matrix<double, 6 * N, 1> r;
      Eigen::Matrix<double, 6 * N, 6 * N> A;
      for (const BeamElement<N>& beam : pool)
        for (const TangentCoefficients& c : {TangentCoefficients{1.0, 0.0, 0.0}, TangentCoefficients{0.0, 0.0, 1.0}}) {
          residual_and_tangent(beam, c_.markers.start, Vector3d::Zero(), c, r, A);
          require_apart(
              A, in_plane,
              fmt::format("{} of beam '{}'", c.mass > 0.0 ? "the mass" : "the stiffness", name_of(model_, beam)));
        }
    };
    check(model_.beams2);
    check(model_.beams3);
  }

  MarkerPair markers(const Marker& a, const Marker& b) const {
    const auto motion = [this](int node) -> const NodeMotion& { return node < 0 ? ground_ : c_.markers.start[node]; };
    return {a, b, motion(a.node), motion(b.node)};
  }
  bool relation_stays(const std::string& name, const Relation& relation, double constant, const Marker& a,
                      const Marker& b) const {
    const RelationTerms terms = evaluate(relation, markers(a, b));
    const Parts parts = parts_of(terms.G, a, b);
    const double size = is_length(relation) ? model_.length : 1.0;
    if (parts.stays()) return true;
    if (parts.leaves() && relation.kind != RelationKind::distance &&
        std::abs(terms.value - constant) <= planar_share * size)
      return false;
    leave(parts.leaves() ? fmt::format("{} is open by {:.6g} out of the plane", name, terms.value - constant)
                         : fmt::format("{} couples motion in the plane with motion out of the plane ({:.3g} out of the "
                                       "plane, {:.3g} in the plane)",
                                       name, parts.out, parts.in),
          "move its markers into the plane of their bodies, and set their axes along the normal or in the plane "
          "(x_axis)");
  }

  Construction& c_;
  const Model& model_;
  NodeMotion ground_;
};

/// Numbers two translations and one rotation per node, and clears components out of the plane at the start.
void number_coordinates(Construction& c) {
  int next = 0;
  for (Node& node : c.model.nodes) {
    if (node.translation >= 0) node.translation = std::exchange(next, next + 2);
    if (node.rotation >= 0) node.rotation = std::exchange(next, next + 1);
  }
  c.model.sizes.boundary = std::exchange(next, 0);
  for (ModalBody& body : c.model.modal_bodies) body.offset = std::exchange(next, next + body.modes);
  for (Tyre& tyre : c.model.tyres)
    if (tyre.relaxes()) tyre.lag = std::exchange(next, next + 2);
  c.model.sizes.modal = next;
  for (RigidBody& body : c.model.rigid_bodies) {
    body.gravity.z() = 0.0;
    body.inertia.col(2).head<2>().setZero();
    body.inertia.row(2).head<2>().setZero();
  }
}

/// Largest difference of axes that count as equal.
constexpr double same_axes = 1e-12;

struct Reduced {
  int from = 0;
  Eigen::Matrix3d axes;
};

/// Returns the result of `reduce`; adds the name of the body if it leaves the plane.
template <class Reduce>
auto named(const std::string& kind, const std::string& name, const Construction& c, const std::string& remedy,
           Reduce reduce) {
  try {
    return reduce();
  } catch (const LeavesPlane& fault) {
    throw Error(fmt::format("effects: the scene is not planar: {} '{}': {}", kind, name, fault.what), c.scene.planar_at,
                remedy + ", or set planar: off");
  }
}

/// Replaces the superelement bodies by planar ones, in the given axes per node. Uses with the same body and axes share
/// one. Throws Error that names the superelement and what in it leaves the plane.
void make_superelements_planar(const std::vector<Eigen::Matrix3d>& axes, Construction& c) {
  Model& model = c.model;
  std::vector<SuperelementBody> bodies;
  std::vector<Reduced> made;
  model.internal_offset.assign(1, 0);
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    SuperelementUse& use = model.superelements[i];
    const Eigen::Matrix3d& own = axes[use.nodes.front()];
    std::size_t at = 0;
    while (at < made.size() && (made[at].from != use.body || (made[at].axes - own).cwiseAbs().maxCoeff() > same_axes))
      ++at;
    if (at == made.size()) {
      bodies.push_back(named("superelement", use.name, c, "make the part symmetric about the plane",
                             [&] { return planar_body(model.superelement_bodies[use.body], own); }));
      made.push_back({use.body, own});
    }
    use.body = static_cast<int>(at);
    use.gravity.z() = 0.0;
    model.internal_offset.push_back(model.internal_offset.back() + bodies[at].modes);
  }
  model.superelement_bodies = std::move(bodies);
}

/// Replaces the modal bodies by planar ones; each use has its own.
void make_modal_bodies_planar(const std::vector<Eigen::Matrix3d>& axes, Construction& c) {
  Model& model = c.model;
  for (int i = 0; i < std::ssize(model.modal_bodies); ++i) {
    ModalBody& body = model.modal_bodies[i];
    std::vector<ModalNode*> nodes;
    for (ModalNode& node : model.modal_nodes)
      if (node.body == i) nodes.push_back(&node);
    named("modal body", body.name, c,
          "make the part symmetric about the plane, use both modes of each pair with equal frequencies, and give both "
          "the same damping",
          [&] { make_planar(axes[body.node], model.length, body, nodes); });
  }
}

}  // namespace

void make_planar(const std::vector<CoordinateStart>& initial, Construction& c) {
  const std::vector<Eigen::Matrix3d> axes = turn_into_plane(find_normal(c), c);
  const PlanarCheck check(c);
  check.bodies();
  make_superelements_planar(axes, c);
  make_modal_bodies_planar(axes, c);
  check.velocities();
  check.starts(initial);
  check.rotations();
  check.attachments();
  for (Joint& joint : c.model.joints) check.reduce(joint);
  check.forces();
  for (Tyre& tyre : c.model.tyres) tyre.planar = true;
  for (Coordinate& coordinate : c.model.coordinates) coordinate.relation.planar = check.stays(coordinate);
  c.model.planar = true;
  number_coordinates(c);
  c.notes.push_back(fmt::format("planar: motion in the plane normal to {}, two translations and one rotation per node",
                                text_of(c.model.axes.col(2))));
}

}  // namespace tisserand::mechanism
