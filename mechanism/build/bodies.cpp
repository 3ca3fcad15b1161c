// SPDX-License-Identifier: GPL-3.0-or-later
// Construction of bodies, one function per type.
#include "mechanism/build/bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "common/text.hpp"
#include "formats/companion/operations.hpp"
#include "formats/yaml/line_check.hpp"
#include "mechanism/bodies/beam/mesh.hpp"
#include "mechanism/build/modal_bodies.hpp"
#include "mechanism/build/virtual_bodies.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Nodes further from the origin than this times the size of the scene get positions relative to a point of the scene.
/// Nearer ones lose less than three of their sixteen digits.
constexpr double far_away = 1e3;

NodeMotion motion_at(const formats::InitialMotion& start, const Vector3d& position, const Vector3d& origin) {
  NodeMotion motion;
  motion.R = start.pose.orientation.normalized().toRotationMatrix();
  const Vector3d arm = motion.R * position;
  motion.x = start.pose.position - origin + arm;
  const Vector3d omega = start.angular_velocity.value_or(Vector3d::Zero());
  motion.xd = start.velocity.value_or(Vector3d::Zero()) + omega.cross(arm);
  motion.Omega = motion.R.transpose() * omega;
  return motion;
}

/// Adds a node at `position` (part frame) of a body that starts with `start`. Returns its index.
int add_node(const std::string& name, const formats::InitialMotion& start, const Vector3d& position, int translations,
             int rotations, Construction& c) {
  Node node{name, -1, -1, -1};
  if (translations) node.translation = std::exchange(c.model.sizes.boundary, c.model.sizes.boundary + 3);
  if (rotations) node.rotation = std::exchange(c.model.sizes.boundary, c.model.sizes.boundary + 3);
  c.model.nodes.push_back(node);
  c.markers.start.push_back(motion_at(start, position, c.markers.origin));
  return count_of(c.model.nodes) - 1;
}

/// Stores the start velocities that the scene gives a body whose first node is `node`.
void note_start(const std::string& name, const formats::InitialMotion& start, int node, Construction& c) {
  const NodeMotion& motion = c.markers.start[node];
  const Vector3d arm = motion.R.transpose() * (start.pose.position - c.markers.origin - motion.x);
  c.starts.push_back({name, {node, arm}, false, start.velocity, start.angular_velocity});
}

int add_virtual_node(const formats::VirtualBodySpec& spec, Construction& c) {
  ++c.model.virtual_nodes;
  return add_node(spec.name, spec.start, Vector3d::Zero(), 1, 1, c);
}

/// Virtual bodies of a scene that eliminates them. They follow all nodes in the table until their carriers are known.
std::vector<const formats::VirtualBodySpec*> eliminated_bodies(const formats::Scene& scene) {
  std::vector<const formats::VirtualBodySpec*> list;
  if (scene.virtual_bodies == formats::VirtualBodies::keep) return list;
  for (const formats::BodySpec& body : scene.bodies)
    if (const auto* spec = std::get_if<formats::VirtualBodySpec>(&body)) list.push_back(spec);
  return list;
}

/// Text on what a companion file before version 1.2 lacks; empty if it is negligible.
std::string missing_turns_text(const formats::Companion& companion, const formats::Superelement& element) {
  constexpr double counts = 1e-4;  // relative to the inertia about an axis; shapes of beams give at most 1e-6
  if (companion.minor_version >= formats::companion_version) return "";
  const Vector3d share = formats::missing_turns(companion, element).share.cwiseAbs();
  Eigen::Index axis = 0;
  if (!(share.maxCoeff(&axis) > counts)) return "";
  return fmt::format(
      "its companion file has version 1.{}. This version lacks the second-order terms of rotary inertia ({:.2g} % of "
      "the inertia about {}). Frequencies and motion at speed may be wrong. Reduce the part again",
      companion.minor_version, 100.0 * std::min(1.0, share[axis]), "xyz"[axis]);
}

class BodyBuilder {
 public:
  BodyBuilder(const BodyFiles& files, Construction& c)
      : c_(c),
        superelements_(files.superelements),
        companions_(files.companions),
        modal_bodies_(files.modal_bodies),
        load_cases_(load_cases_by_file(c.scene)) {}

  void add_place(const std::string& name, const Marker& marker) {
    c_.model.places.push_back({name, marker});
    c_.markers.places[name] = marker;
  }

  void add_frame(const std::string& name, const Marker& marker) {
    add_place(name, marker);
    c_.markers.frames.insert(name);
  }

  void add_alias(const std::string& name, int place) {
    c_.model.place_aliases.push_back({name, place});
    c_.markers.places[name] = c_.model.places[place].marker;
  }

  void note_units(const std::string& name, const Units& from, const UnitConversion& units) {
    if (from.named() && (units.length != 1.0 || units.mass != 1.0 || units.time != 1.0))
      c_.note_body(name, fmt::format("converted from {}, {}, {} to {}, {}, {}", from.length.label, from.mass.label,
                                     from.time.label, c_.scene.units.length.label, c_.scene.units.mass.label,
                                     c_.scene.units.time.label));
  }

  void add_body(const formats::ModalBodySpec& spec) {
    const formats::LoadedModalBody& file = modal_bodies_.at(spec.file, spec.mirror);
    const UnitConversion units = convert_units(file.body.units, c_.scene.units, spec.file);
    note_units(spec.name, file.body.units, units);
    for (const std::string& warning : file.warnings) c_.note_body(spec.name, warning);
    BuiltModalBody built = build_modal_body(file.body, spec, units);
    if (built.body.modes < static_cast<int>(file.body.modes()))
      c_.note_body(spec.name, fmt::format("{} of {} modes are used", built.body.modes, file.body.modes()));
    formats::InitialMotion start = spec.start;
    const Matrix3d turn = start.pose.orientation.normalized().toRotationMatrix();
    const Vector3d arm = turn * built.frame_position;
    start.pose.position += arm;
    if (start.angular_velocity)
      start.velocity = start.velocity.value_or(Vector3d::Zero()) + start.angular_velocity->cross(arm);
    start.pose.orientation = Eigen::Quaterniond(turn * built.frame_rotation);
    built.body.node = add_node(spec.name, start, Vector3d::Zero(), 1, 1, c_);
    note_start(spec.name, spec.start, built.body.node, c_);
    built.body.gravity = spec.gravity.value_or(c_.scene.gravity);
    built.body.offset = std::exchange(c_.model.sizes.modal, c_.model.sizes.modal + built.body.modes);
    const Matrix3d part_axes = built.frame_rotation.transpose();
    built.body.axes = built.frame_rotation;
    add_frame(spec.name, {built.body.node, Vector3d::Zero(), part_axes});
    for (ModalNode& node : built.nodes) {
      const std::string name = spec.name + "/" + node.name;
      node.body = count_of(c_.model.modal_bodies);
      node.node = add_node(name, start, node.x, 0, 0, c_);
      c_.model.nodes.back().modal = count_of(c_.model.modal_nodes);
      c_.model.modal_nodes.push_back(std::move(node));
      add_place(name, {c_.model.modal_nodes.back().node, Vector3d::Zero(), part_axes});
    }
    if (!file.body.residual.node.empty())
      c_.reference_models.push_back(reference_model(file.body, built.body.modes, spec.name, built.body.node, units));
    c_.model.modal_bodies.push_back(std::move(built.body));
  }

  void add_body(const formats::SuperelementBodySpec& spec) {
    const formats::LoadedSuperelement& file = superelements_.at(spec.file, spec.mirror);
    const formats::Superelement& element = file.superelement;
    const UnitConversion units = convert_units(element.units, c_.scene.units, spec.file);
    note_units(spec.name, element.units, units);
    for (const std::string& warning : file.report.warnings) c_.note_body(spec.name, warning);
    if (spec.rigid) {
      add_rigid_superelement(spec, file, units);
      return;
    }
    SuperelementUse use;
    use.name = spec.name;
    const CompanionUse companion = companion_of(spec, element);
    use.body = find_or_build(spec, file, companion, units, built_superelements_, c_.model.superelement_bodies);
    use.gravity = spec.gravity.value_or(c_.scene.gravity);
    const SuperelementBody& body = c_.model.superelement_bodies[use.body];
    for (const std::string& note : body.notes) c_.note_body(spec.name, note);
    if (!body.load_cases.empty()) use.companion_id = companion.file->companion_id;
    if (const SecondOrderChoice choice = choose_second_order(spec, companion.terms); choice.any()) {
      use.companion_id = companion.file->companion_id;
      c_.note_body(spec.name, describe(choice) + ", from the companion file");
      if (const std::string text = missing_turns_text(*companion.terms, element); !text.empty())
        c_.note_body(spec.name, text);
    } else if (may_use_companion(spec) && (body.modes > 0 || body.node.size() > 1)) {
      c_.note_body(spec.name, companion.terms == nullptr
                                  ? "there is no companion file, so the body is linear: no stiffening, no exact "
                                    "inertia. If this is intended, set `second_order: off` at the body"
                                  : "its companion file has load cases only, so the body is linear: no stiffening, no "
                                    "exact inertia. If this is intended, set `second_order: off` at the body");
    }
    for (const SuperelementNode& node : body.node) {
      const std::string name = spec.name + "/" + node.name;
      const Vector3d position = body.reference_origin + node.X;
      use.nodes.push_back(add_node(name, spec.start, position, node.has_translation(), node.has_rotation(), c_));
      add_place(name, {use.nodes.back(), Vector3d::Zero(), Matrix3d::Identity()});
    }
    note_start(spec.name, spec.start, use.nodes.front(), c_);
    c_.model.internal_offset.push_back(c_.model.internal_offset.back() + body.modes);
    c_.model.superelement_content_ids.push_back(element.content_id);
    c_.model.superelements.push_back(std::move(use));
    c_.frames.push_back(spec.start.pose.orientation.normalized());
  }

  /// Companion data that the body uses. Throws Error for load cases that the companion does not have.
  CompanionUse companion_of(const formats::SuperelementBodySpec& spec, const formats::Superelement& image) {
    CompanionUse use;
    const bool loaded = bears_part_load(c_.scene, spec.name);
    if (loaded || may_use_companion(spec)) use.file = mirrored_companion(spec, image);
    if (may_use_companion(spec)) use.terms = use.file;
    require_load_cases(c_.scene, spec, use.file);
    if (loaded) use.load_cases = load_cases_.at(spec.file);
    return use;
  }

  /// Companion of the file, mirrored as the body is; null if there is none.
  const formats::Companion* mirrored_companion(const formats::SuperelementBodySpec& spec,
                                               const formats::Superelement& image) {
    const auto found = companions_.find(spec.file);
    if (found == companions_.end()) return nullptr;
    if ((spec.mirror.array() > 0.0).all()) return &found->second;
    const std::array<double, 3> axes{spec.mirror.x(), spec.mirror.y(), spec.mirror.z()};
    const auto [at, is_new] = mirrored_companions_.try_emplace({spec.file, axes}, found->second);
    if (is_new) formats::mirror(at->second, spec.mirror, image);
    return &at->second;
  }

  void add_rigid_superelement(const formats::SuperelementBodySpec& spec, const formats::LoadedSuperelement& file,
                              const UnitConversion& units) {
    formats::RigidBodySpec rigid;
    rigid.name = spec.name;
    rigid.gravity = spec.gravity;
    rigid.terms = spec.terms;
    rigid.start = spec.start;
    rigid.mass = file.report.rigid.mass * units.mass;
    rigid.center_of_mass = file.report.rigid.center_of_mass * units.length;
    rigid.inertia = file.report.rigid.inertia * (units.mass * units.length * units.length);
    rigid.where = spec.where;
    const formats::Superelement& element = file.superelement;
    for (std::size_t j = 0; j < element.node_name.size(); ++j) {
      formats::RigidNodeSpec node;
      node.name = element.node_name[j];
      node.pose.position = element.node_position.row(j).transpose() * units.length;
      rigid.nodes.push_back(node);
    }
    const CompanionUse companion = companion_of(spec, element);
    if (!companion.load_cases.empty())
      c_.part_resultants[spec.name] =
          part_resultants(*companion.file, element, file.report.rigid.center_of_mass, units);
    add_rigid_body(rigid);
  }

  void add_body(const formats::RigidBodySpec& spec) {
    const std::string doubt = formats::inertia_doubt(fmt::format("body '{}'", spec.name), spec.inertia);
    if (!doubt.empty()) c_.notes.push_back(doubt);
    add_rigid_body(spec);
  }

  void add_rigid_body(const formats::RigidBodySpec& spec) {
    const int node = add_node(spec.name, spec.start, spec.center_of_mass, 1, 1, c_);
    note_start(spec.name, spec.start, node, c_);
    c_.model.rigid_bodies.push_back(
        {spec.name, node, spec.mass, spec.inertia, spec.gravity.value_or(c_.scene.gravity), spec.terms.gyroscopic});
    add_frame(spec.name, {node, -spec.center_of_mass, Matrix3d::Identity()});
    for (const formats::RigidNodeSpec& place : spec.nodes)
      add_place(spec.name + "/" + place.name, {node, place.pose.position - spec.center_of_mass,
                                               place.pose.orientation.normalized().toRotationMatrix()});
  }

  void add_body(const formats::BeamBodySpec& spec) {
    const BeamMesh mesh = mesh_beam(spec, 0);
    std::vector<int> nodes;
    for (std::size_t i = 0; i < mesh.position.size(); ++i) {
      const std::string name = fmt::format("{}/{}", spec.name, i);
      nodes.push_back(add_node(name, spec.start, mesh.position[i], 1, 1, c_));
      add_place(name, {nodes.back(), Vector3d::Zero(), Matrix3d::Identity()});
    }
    note_start(spec.name, spec.start, nodes.front(), c_);
    const int last = count_of(c_.model.places) - 1;
    add_alias(spec.name + "/start", last + 1 - count_of(nodes));
    add_alias(spec.name + "/end", last);
    const Vector3d gravity = spec.gravity.value_or(c_.scene.gravity);
    const auto append = [&](const auto& elements, auto& pool) {
      for (auto element : elements) {
        element.gravity = gravity;
        element.rotary = spec.terms.rotary_inertia;
        if (!element.rotary) element.inertia.fill(Matrix3d::Zero());
        for (int& node : element.nodes) node = nodes[node];
        pool.push_back(element);
      }
    };
    append(mesh.elements2, c_.model.beams2);
    append(mesh.elements3, c_.model.beams3);
  }

  void add_body(const formats::VirtualBodySpec&) {}  // after all others, by add_virtual_body()

  /// Adds a virtual body; a kept one becomes a node.
  void add_virtual_body(const formats::VirtualBodySpec& spec) {
    int node = count_of(c_.markers.start);
    switch (c_.scene.virtual_bodies) {
      case formats::VirtualBodies::keep:
        node = add_virtual_node(spec, c_);
        note_start(spec.name, spec.start, node, c_);
        break;
      case formats::VirtualBodies::eliminate:
        c_.markers.start.push_back(motion_at(spec.start, Vector3d::Zero(), c_.markers.origin));
        break;
    }
    add_frame(spec.name, {node});
    for (const formats::RigidNodeSpec& place : spec.nodes)
      add_place(spec.name + "/" + place.name,
                {node, place.pose.position, place.pose.orientation.normalized().toRotationMatrix()});
  }

 private:
  Construction& c_;
  MirroredFiles<formats::LoadedSuperelement> superelements_;
  const std::map<std::string, formats::Companion>& companions_;
  std::map<std::pair<std::string, std::array<double, 3>>, formats::Companion> mirrored_companions_;
  MirroredFiles<formats::LoadedModalBody> modal_bodies_;
  BuiltSuperelements built_superelements_;
  std::map<std::string, std::vector<std::string>> load_cases_;
};

void add_bodies(const BodyFiles& files, Construction& c) {
  BodyBuilder builder(files, c);
  for (const formats::BodySpec& body : c.scene.bodies)
    c.collect([&] { std::visit([&](const auto& spec) { builder.add_body(spec); }, body); });
  for (const formats::BodySpec& body : c.scene.bodies)
    if (const auto* spec = std::get_if<formats::VirtualBodySpec>(&body))
      c.collect([&] { builder.add_virtual_body(*spec); });
}

Eigen::AlignedBox3d extent(const Construction& c) {
  Eigen::AlignedBox3d box;
  for (const NodeMotion& m : c.markers.start) box.extend(m.x);
  return box;
}

void measure_length(Construction& c) {
  if (c.markers.start.empty()) throw Error("the scene has no bodies", c.scene.file, "add a body under `bodies:`");
  Model& model = c.model;
  model.length = extent(c).diagonal().norm();
  for (const Place& place : model.places) model.length = std::max(model.length, place.marker.p.norm());
  if (!(model.length > 0.0)) model.length = 1.0;
}

/// Origin for the positions of a scene: zero, or a point near the middle of nodes that are far from the origin. The
/// point lies on a grid of the size of the scene, so that differences to it are exact.
Vector3d origin_for(const Construction& c) {
  const Vector3d center = extent(c).center();
  if (center.cwiseAbs().maxCoeff() <= far_away * c.model.length) return Vector3d::Zero();
  const double grid = std::exp2(std::ceil(std::log2(c.model.length)));
  return grid * (center / grid).array().round();
}

/// Builds the bodies of the scene, with positions relative to `origin`.
Construction with_bodies(const formats::Scene& scene, const BodyFiles& files, const Eigen::Vector3d& origin) {
  Construction c(scene);
  c.model.name = scene.name;
  c.model.units = scene.units;
  c.model.gravity = scene.gravity;
  c.model.internal_offset = {0};
  c.model.origin = c.markers.origin = origin;
  add_bodies(files, c);
  c.throw_errors();
  for (const BodyNote& note : c.body_notes)
    c.notes.push_back(
        fmt::format("{} {}: {}", note.bodies.size() > 1 ? "bodies" : "body", listed(note.bodies), note.text));
  measure_length(c);
  return c;
}

}  // namespace

Construction with_bodies(const formats::Scene& scene, const BodyFiles& files) {
  Construction c = with_bodies(scene, files, Eigen::Vector3d::Zero());
  const Eigen::Vector3d origin = origin_for(c);
  if (origin.isZero(0.0)) return c;
  Construction about = with_bodies(scene, files, origin);
  const double distance = origin.cwiseAbs().maxCoeff();
  about.notes.push_back(fmt::format(
      "the scene is {:.3g} times its size away from the origin. It is computed relative to [{:.9g}, {:.9g}, {:.9g}], "
      "where its potential energy is zero. Stored positions are relative to the origin and are rounded to {:.1e} {}",
      distance / about.model.length, origin.x(), origin.y(), origin.z(),
      distance * std::numeric_limits<double>::epsilon(), scene.units.length.label));
  return about;
}

void eliminate_virtual_bodies(Construction& c) {
  const std::vector<const formats::VirtualBodySpec*> virtual_bodies = eliminated_bodies(c.scene);
  if (virtual_bodies.empty()) return;

  const int first = count_of(c.model.nodes);
  TiedBodies tied = tie_virtual_bodies(c.scene, c.model, first, c.markers);
  c.markers.start.resize(static_cast<std::size_t>(first));
  std::map<int, int> node_of_root;
  for (const int root : tied.roots) node_of_root[first + root] = add_virtual_node(*virtual_bodies[root], c);
  const auto renumber = [&](Marker& marker) {
    if (marker.node >= first) marker.node = node_of_root.at(marker.node);
  };
  for (Marker& pose : tied.pose) renumber(pose);
  for (Tie& tie : tied.ties) {
    renumber(tie.a);
    renumber(tie.b);
  }
  const auto move = [&](Marker& place) {
    if (place.node >= first) place = composed(tied.pose[place.node - first], place);
  };
  for (Place& place : c.model.places) move(place.marker);
  for (auto& [name, place] : c.markers.places) move(place);
  for (const formats::VirtualBodySpec* body : virtual_bodies) {
    const Marker& place = c.markers.places.at(body->name);
    const bool stays = std::ranges::any_of(node_of_root, [&](const auto& root) {
      return root.second == place.node && c.model.nodes[place.node].name == body->name;
    });
    c.starts.push_back({body->name, place, !stays, body->start.velocity, body->start.angular_velocity});
  }
  c.model.ties = std::move(tied.ties);
  c.vanished = std::move(tied.vanished);
  c.arms = std::move(tied.arms);
}

}  // namespace tisserand::mechanism
