// SPDX-License-Identifier: GPL-3.0-or-later
// Rules of placement, key by key. Vectors along the assembly transform by G, axial ones (angular velocities, moments)
// by det(G) G. Data in part axes are only mirrored, by S.
#include "formats/scene/expand/placement.hpp"

#include <array>

#include <Eigen/Geometry>

#include "formats/joints/joint_kinds.hpp"
#include "formats/scene/expand/load_placement.hpp"
#include "formats/scene/expand/parameters.hpp"
#include "formats/yaml/geometry.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

YamlNode word_node(const std::string& word, const YamlPlace& place) {
  YamlNode node;
  node.kind = YamlKind::scalar;
  node.text = word;
  node.place = place;
  return node;
}

YamlNode number_node(double value, const YamlPlace& place) { return word_node(number_text(value), place); }

template <class Vector>
YamlNode list_node(const Vector& values, const YamlPlace& place) {
  YamlNode node;
  node.kind = YamlKind::sequence;
  node.place = place;
  for (Eigen::Index i = 0; i < values.size(); ++i) node.children.push_back(number_node(values[i], place));
  return node;
}

YamlNode rows_node(const Matrix3d& matrix, const YamlPlace& place) {
  YamlNode node;
  node.kind = YamlKind::sequence;
  node.place = place;
  for (int i = 0; i < 3; ++i) node.children.push_back(list_node(Vector3d(matrix.row(i)), place));
  return node;
}

/// Replaces or adds the value of the key.
void set(YamlNode& map, const char* key, YamlNode value) {
  value.key = key;
  if (YamlNode* old = find_child(map, key)) {
    value.key_place = old->key_place;
    *old = std::move(value);
    return;
  }
  value.key_place = value.place;
  map.children.push_back(std::move(value));
}

YamlNode quaternion_node(const Matrix3d& R, const YamlPlace& place) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(R).normalized();
  return list_node(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()), place);
}

std::string word(const YamlNode& map, const char* key) {
  const YamlNode* node = find_child(map, key);
  return node != nullptr && node->kind == YamlKind::scalar ? node->text : "";
}

bool is_list(const YamlNode* node) { return node != nullptr && node->kind == YamlKind::sequence; }

/// Transformation of the marker axes of a joint, spring or bushing by a mirror (JointKindRow::mirrored_axes).
Matrix3d axes_of_mirrored_markers(const std::string& type) {
  const JointKindRow* joint = find_joint_kind(type);
  const std::array<double, 3> axes = joint ? joint->mirrored_axes : JointKindRow{}.mirrored_axes;
  return Vector3d(axes[0], axes[1], axes[2]).asDiagonal();
}

/// Whether a joint, spring or bushing uses the directions of its markers.
bool uses_axes(const std::string& type) {
  const JointKindRow* joint = find_joint_kind(type);
  return joint ? joint->axes != JointAxes::unused : !type.empty() && type != "line";
}

/// x axis that the model builder chooses for markers with a given z only.
Vector3d default_x_axis(const Vector3d& z) {
  Eigen::Index smallest = 0;
  z.cwiseAbs().minCoeff(&smallest);
  return Vector3d::Unit(smallest);
}

}  // namespace

AssemblyFrame compose(const AssemblyFrame& outer, const AssemblyFrame& inner) {
  AssemblyFrame both;
  both.p = outer.p + outer.G * inner.p;
  both.G = outer.G * inner.G;
  if (outer.mirrored() != inner.mirrored()) both.S = outer.mirrored() ? outer.S : inner.S;
  return both;
}

Context Placement::context(const YamlNode& entry) const {
  return {reader_, fmt::format("'{}'", entry.key), reader_.where(entry.key_place)};
}

void Placement::transform(YamlNode& map, const char* key, const Matrix3d& by, const Vector3d& shift) {
  const YamlNode* node = find_child(map, key);
  if (!is_list(node)) return;
  const Vector3d v = read_vector(context(map), *node, key);
  if (v.allFinite()) set(map, key, list_node(Vector3d(shift + by * v), node->place));
}

/// Replaces the orientation R by before R after.
void Placement::turn_orientation(YamlNode& map, const Matrix3d& before, const Matrix3d& after) {
  const YamlNode* node = find_child(map, "orientation");
  if (node == nullptr) return;
  const Matrix3d R = read_orientation(context(map), *node, "orientation").toRotationMatrix();
  set(map, "orientation", quaternion_node(before * R * after, node->place));
}

void Placement::place(const std::string& collection, YamlNode& entry) {
  if (entry.kind != YamlKind::map) return;
  if (collection == "bodies") {
    body(entry);
  } else if (collection == "joints" || collection == "springs") {
    pair(entry, word(entry, "type"));
  } else if (collection == "bushings") {
    pair(entry, "bushing");
    if (frame_.mirrored()) mirror_field(entry);
  } else if (collection == "channels") {
    channel(entry);
  } else if (collection == "initial") {
    transform(entry, "velocity", frame_.G, Vector3d::Zero());
    transform(entry, "angular_velocity", frame_.G * frame_.S.diagonal().prod(), Vector3d::Zero());
  } else if (collection == "tyres") {
    tyre(entry);
  } else if (collection == "loads") {
    load(entry);
  }
}

void Placement::body(YamlNode& body) {
  mirror_file(body);
  if (!frame_.moved()) return;
  if (find_child(body, "pose") == nullptr) {
    YamlNode pose;
    pose.kind = YamlKind::map;
    pose.place = body.place;
    set(body, "pose", std::move(pose));
  }
  YamlNode& pose = *find_child(body, "pose");
  if (pose.kind != YamlKind::map) return;
  if (find_child(pose, "position") == nullptr) set(pose, "position", list_node(Vector3d::Zero().eval(), pose.place));
  transform(pose, "position", frame_.G, frame_.p);
  if (frame_.turned()) {
    if (find_child(pose, "orientation") == nullptr)
      set(pose, "orientation", quaternion_node(Matrix3d::Identity(), pose.place));
    turn_orientation(pose, frame_.G, frame_.S);
  }
  for (const char* key : {"velocity", "gravity"}) transform(body, key, frame_.G, Vector3d::Zero());
  transform(body, "angular_velocity", frame_.G * frame_.S.diagonal().prod(), Vector3d::Zero());
  if (frame_.mirrored()) mirror_part(body);
}

void Placement::mirror_part(YamlNode& body) {
  for (const char* key : {"center_of_mass", "from", "to", "through", "orientation"})
    transform(body, key, frame_.S, Vector3d::Zero());
  if (const YamlNode* inertia = find_child(body, "inertia"); is_list(inertia)) {
    const Matrix3d J = read_inertia(context(body), *inertia, "inertia");
    if (J.allFinite()) set(body, "inertia", rows_node(frame_.S * J * frame_.S, inertia->place));
  }
  if (YamlNode* shape = find_child(body, "shape")) {
    if (shape->kind == YamlKind::map) mirror_shape(*shape);
    for (YamlNode& one : shape->children)
      if (one.kind == YamlKind::map && shape->kind == YamlKind::sequence) mirror_shape(one);
  }
  YamlNode* nodes = find_child(body, "nodes");
  if (nodes == nullptr || nodes->kind != YamlKind::map) return;
  for (YamlNode& node : nodes->children) {
    transform(node, "position", frame_.S, Vector3d::Zero());
    turn_orientation(node, frame_.S, frame_.S);
  }
}

/// Mirrors a shape: x = p + R s v of a file becomes S p + (S R S) (S s) v.
void Placement::mirror_shape(YamlNode& shape) {
  for (const char* key : {"position", "from", "to"}) transform(shape, key, frame_.S, Vector3d::Zero());
  turn_orientation(shape, frame_.S, frame_.S);
  if (YamlNode* points = find_child(shape, "points"); is_list(points))
    for (YamlNode& point : points->children)
      if (const Vector3d v = read_vector(context(shape), point, "a point"); v.allFinite())
        point = list_node(Vector3d(frame_.S * v), point.place);
  if (word(shape, "type") != "mesh") return;
  const YamlNode* scale = find_child(shape, "scale");
  const Vector3d factors = is_list(scale) ? read_vector(context(shape), *scale, "scale")
                           : scale != nullptr
                               ? Vector3d(Vector3d::Constant(read_number(context(shape), *scale, "scale")))
                               : Vector3d(Vector3d::Ones());
  if (factors.allFinite()) set(shape, "scale", list_node(Vector3d(frame_.S * factors), shape.place));
}

/// Mirrors the file of a body when the body is built, by a plane added to the body's own mirror planes.
void Placement::mirror_file(YamlNode& body) {
  const YamlNode* file = find_child(body, word(body, "type") == "rigid" ? "from" : "file");
  if (!frame_.mirrored() || file == nullptr || file->kind != YamlKind::scalar) return;
  constexpr std::array<const char*, 3> across{"yz", "xz", "xy"};
  Eigen::Index axis = 0;
  frame_.S.diagonal().minCoeff(&axis);
  YamlNode planes, plane;
  planes.kind = YamlKind::sequence;
  planes.place = plane.place = file->place;
  plane.kind = YamlKind::scalar;
  plane.text = across[axis];
  if (const YamlNode* own = find_child(body, "mirror"))
    planes.children = own->kind == YamlKind::sequence ? own->children : std::vector<YamlNode>{*own};
  planes.children.push_back(std::move(plane));
  set(body, "mirror", std::move(planes));
}

/// Places joints, springs and bushings: data in world axes, and the markers.
void Placement::pair(YamlNode& entry, const std::string& type) {
  if (!frame_.moved()) return;
  const Matrix3d flip = frame_.mirrored() ? axes_of_mirrored_markers(type) : Matrix3d(Matrix3d::Identity());
  for (const char* key : {"a", "b"}) marker(entry, key, flip);
  transform(entry, "position", frame_.G, frame_.p);
  const auto oriented = [&entry](const char* key) {
    const YamlNode* marker = find_child(entry, key);
    return marker != nullptr && find_child(*marker, "orientation") != nullptr;
  };
  const bool has_axis = is_list(find_child(entry, "axis"));
  const bool has_markers = find_child(entry, "a") != nullptr && find_child(entry, "b") != nullptr;
  const bool directed = has_markers && uses_axes(type);
  if (!frame_.turned() || (!has_axis && (!directed || oriented("a") || oriented("b")))) return;
  const Vector3d z = has_axis ? read_vector(context(entry), *find_child(entry, "axis"), "axis") : Vector3d::UnitZ();
  if (!z.allFinite() || z.isZero(0.0)) return;
  if (!has_axis) set(entry, "axis", list_node(z, entry.place));
  if (find_child(entry, "x_axis") == nullptr)
    set(entry, "x_axis", list_node(has_axis ? default_x_axis(z) : Vector3d(Vector3d::UnitX()), entry.place));
  transform(entry, "axis", frame_.G * flip(2, 2), Vector3d::Zero());
  transform(entry, "x_axis", frame_.G * flip(0, 0), Vector3d::Zero());
  if (!frame_.mirrored()) return;
  if (const YamlNode* pitch = find_child(entry, "pitch"); pitch != nullptr && looks_like_number(*pitch))
    set(entry, "pitch", number_node(-read_number(context(entry), *pitch, "pitch"), pitch->place));
}

/// Mirrors the matrices of a bushing with its marker axes (z reversed). Displacements along x, y and rotations about z
/// keep their signs, the others change. Diagonals are unchanged.
void Placement::mirror_field(YamlNode& bushing) {
  constexpr std::array<double, 6> sign{1.0, 1.0, -1.0, -1.0, -1.0, 1.0};
  const auto turn = [&](YamlNode& row, double factor) {
    if (row.kind != YamlKind::sequence || row.children.size() != sign.size()) return;
    for (std::size_t i = 0; i < sign.size(); ++i)
      if (YamlNode& number = row.children[i]; looks_like_number(number))
        number.text = number_text(factor * sign[i] * read_number(context(bushing), number, row.key));
  };
  for (const char* key : {"free", "preload"})
    if (YamlNode* six = find_child(bushing, key)) turn(*six, 1.0);
  for (const char* key : {"stiffness", "damping"}) {
    YamlNode* matrix = find_child(bushing, key);
    if (matrix == nullptr || matrix->kind != YamlKind::sequence || matrix->children.size() != sign.size()) continue;
    for (std::size_t i = 0; i < sign.size(); ++i) turn(matrix->children[i], sign[i]);
  }
}

/// Places a marker. On ground it is in the world frame. On a body it is in node axes, which only a mirror changes.
void Placement::marker(YamlNode& entry, const char* key, const Matrix3d& flip) {
  YamlNode* marker = find_child(entry, key);
  if (marker == nullptr || marker->kind != YamlKind::map) return;
  if (word(*marker, "node") == "ground") {
    transform(*marker, "position", frame_.G, frame_.p);
    turn_orientation(*marker, frame_.G, flip);
  } else if (frame_.mirrored()) {
    transform(*marker, "position", frame_.S, Vector3d::Zero());
    turn_orientation(*marker, frame_.S, flip);
  }
}

/// Places a channel, whose axes and origin are those of the assembly.
void Placement::channel(YamlNode& channel) {
  if (!frame_.moved() || word(channel, "type") == "tyre") return;
  for (const char* key : {"of", "a", "b"}) marker(channel, key, frame_.S);
  YamlNode* axis = find_child(channel, "axis");
  if (axis == nullptr) return;
  constexpr std::array<const char*, 3> words{"x", "y", "z"};
  for (Eigen::Index i = 0; i < 3; ++i)
    if (axis->kind == YamlKind::scalar && axis->text == words[i])
      set(channel, "axis", list_node(Vector3d(Vector3d::Unit(i)), axis->place));
  transform(channel, "axis", frame_.G, Vector3d::Zero());
  if (word(channel, "type") != "position") return;
  if (find_child(channel, "origin") == nullptr)
    set(channel, "origin", list_node(Vector3d(Vector3d::Zero()), channel.place));
  transform(channel, "origin", frame_.G, frame_.p);
}

/// Places a tyre. Its axle is an axial vector, so that mirrored wheels roll forward with the same sign.
void Placement::tyre(YamlNode& tyre) {
  if (!frame_.turned()) return;
  marker(tyre, "wheel", frame_.S);
  transform(tyre, "axis", frame_.G * frame_.S.diagonal().prod(), Vector3d::Zero());
  if (!frame_.mirrored() || word(tyre, "type") != "magic_formula") return;
  const YamlNode* mirrored = find_child(tyre, "mirrored");
  const bool already = mirrored != nullptr && (mirrored->text == "yes" || mirrored->text == "true");
  set(tyre, "mirrored", word_node(already ? "no" : "yes", tyre.place));
}

void Placement::load(YamlNode& load) {
  if (!frame_.turned() || word(load, "type") == "part_load") return;  // load cases rotate with their body
  marker(load, "at", frame_.S);
  const double handed = word(load, "type") == "moment" ? frame_.S.diagonal().prod() : 1.0;
  const Matrix3d by = handed * (word(load, "axes") == "body" ? frame_.S : frame_.G);
  if (YamlNode* value = find_child(load, "value")) turn_components(context(load), by, *value);
}

std::set<std::string> Placement::reversed_coordinates(const YamlNode& joint) {
  const JointKindRow* kind = find_joint_kind(word(joint, "type"));
  std::set<std::string> names;
  if (kind == nullptr) return names;
  constexpr std::array<std::string_view, 3> displacements{"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    if (kind->mirrored_axes[i] > 0.0 ||
        std::ranges::find(kind->coordinates, displacements[i]) == kind->coordinates.end())
      continue;
    names.insert(fmt::format("{}/{}", joint.key, displacements[i]));
    // The only coordinate of a joint has the joint's name. `hold` may leave only one coordinate.
    if (kind->coordinates.count == 1 || kind->key == JointKey::hold) names.insert(joint.key);
  }
  return names;
}

}  // namespace tisserand::formats
