// Lines and arcs of a part meshed through the gmsh API; the only file that knows gmsh.
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include <fmt/format.h>
#include <gmsh.h>
#include <Eigen/Geometry>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/mesher.hpp"

namespace tisserand::reducer {
namespace {

/// gmsh is one global state: this owns it from initialize to finalize, silent and without ~/.gmshrc.
class GmshSession {
 public:
  GmshSession() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("Mesh.Binary", 0);
  }
  ~GmshSession() { gmsh::finalize(); }
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

/// gmsh throws std::string; the rest of the project throws Error.
template <class Work>
auto with_gmsh(const std::string& where, Work work) {
  try {
    return work();
  } catch (const std::string& text) {
    throw Error("gmsh: " + text, where, "simplify the lines of the part until gmsh accepts them");
  }
}

/// X(s), s in [0, 1] at constant speed: a straight line, or a circular arc center + r (cos(s angle) e1 + sin(s angle)
/// e2).
struct Curve {
  Eigen::Vector3d from, to;
  double angle = 0.0;  ///< 0: straight
  double radius = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero(), e1 = Eigen::Vector3d::Zero(), e2 = Eigen::Vector3d::Zero();

  double length() const { return angle == 0.0 ? (to - from).norm() : radius * angle; }
  Eigen::Vector3d at(double s) const {
    if (angle == 0.0) return from + s * (to - from);
    return center + radius * (std::cos(s * angle) * e1 + std::sin(s * angle) * e2);
  }
};

/// The circle through three points; the arc runs from `from` over `through` to `to`.
Curve circle_arc(const Eigen::Vector3d& from, const Eigen::Vector3d& through, const Eigen::Vector3d& to,
                 const formats::BeamLine& line) {
  const Eigen::Vector3d a = through - from, b = to - from;
  const Eigen::Vector3d n = a.cross(b);
  if (!(n.norm() > 1e-9 * a.norm() * b.norm()))
    throw Error(fmt::format("beam '{}': the points of the arc are on a straight line or coincide", line.name),
                line.where, "move `through` off the line between `from` and `to`, or leave it out for a straight beam");
  Curve curve{from, to};
  curve.center = from + (b.squaredNorm() * n.cross(a) - a.squaredNorm() * n.cross(b)) / (2.0 * n.squaredNorm());
  curve.radius = (from - curve.center).norm();
  curve.e1 = (from - curve.center) / curve.radius;
  curve.e2 = n.normalized().cross(curve.e1);
  const Eigen::Vector3d end = to - curve.center;
  curve.angle = std::atan2(end.dot(curve.e2), end.dot(curve.e1));
  if (curve.angle <= 0.0) curve.angle += 2.0 * EIGEN_PI;
  return curve;
}

/// Points by name: parts with thousands of lines look them up often.
using PointTable = std::unordered_map<std::string, const formats::NamedPoint*>;

PointTable point_table(const formats::Part& part) {
  PointTable table;
  for (const formats::NamedPoint& point : part.points) table.emplace(point.name, &point);
  return table;
}

const formats::NamedPoint& find_point(const PointTable& points, const std::string& name, const std::string& used_by,
                                      const std::string& where) {
  if (const auto found = points.find(name); found != points.end()) return *found->second;
  std::vector<std::string> known;
  for (const auto& [other, point] : points) known.push_back(other);
  std::sort(known.begin(), known.end());
  const std::optional<std::string> guess = nearest(name, known);
  if (known.size() > 20) known.resize(20), known.push_back("...");
  throw Error(fmt::format("{}: point '{}' does not exist", used_by, name), where,
              guess ? fmt::format("did you mean '{}'?", *guess) : "points: " + join(known, ", "));
}

template <class Named>
const Named& find_named(const std::vector<Named>& all, const std::string& name, const char* kind,
                        const formats::BeamLine& line) {
  std::vector<std::string> known;
  for (const Named& item : all) {
    if (item.name == name) return item;
    known.push_back(item.name);
  }
  const std::optional<std::string> guess = nearest(name, known);
  throw Error(fmt::format("beam '{}': {} '{}' does not exist", line.name, kind, name), line.where,
              guess ? fmt::format("did you mean '{}'?", *guess) : fmt::format("{}s: {}", kind, join(known, ", ")));
}

Curve curve_of(const PointTable& points, const formats::BeamLine& line) {
  const std::string user = fmt::format("beam '{}'", line.name);
  const Eigen::Vector3d from = find_point(points, line.from.name, user, line.where).position;
  const Eigen::Vector3d to = find_point(points, line.to.name, user, line.where).position;
  if (!((to - from).norm() > 1e-12 * (1.0 + from.norm() + to.norm())))
    throw Error(
        fmt::format("beam '{}' has zero length: '{}' and '{}' are at the same place", line.name, line.from.name, line.to.name),
        line.where, "move one of the points (a full circle is drawn as two arcs)");
  return line.through ? circle_arc(from, *line.through, to, line) : Curve{from, to};
}

int element_count(const Curve& curve, const formats::BeamLine& line) {
  if (line.elements > 0) return line.elements;
  if (!(line.size > 0.0))
    throw Error(fmt::format("beam '{}' has neither a number of elements nor an element size", line.name), line.where,
                "give `elements: 10` or `size: 0.1`");
  const double count = std::ceil(curve.length() / line.size * (1.0 - 1e-12));
  if (!(count <= 1e6))
    throw Error(fmt::format("beam '{}': size {} gives {:.3g} elements", line.name, line.size, count), line.where,
                "use a larger size");
  return std::max(1, static_cast<int>(count));
}

/// One gmsh curve, or several for an arc, since gmsh wants each arc below half a circle.
struct MeshedLine {
  Curve curve;
  int elements = 0;
  std::vector<int> curve_tags;
};

struct GmshModel {
  std::vector<MeshedLine> lines;
  std::map<std::string, int> point_tag;  ///< only points that beams use
};

int gmsh_point(const Eigen::Vector3d& x) { return gmsh::model::geo::addPoint(x.x(), x.y(), x.z()); }

/// Adds one line with its transfinite division. Arcs are cut where element nodes will be.
MeshedLine add_line(const PointTable& points, const formats::BeamLine& line, GmshModel& model,
                    std::vector<std::pair<int, int>>& divisions) {
  MeshedLine result{curve_of(points, line), 0, {}};
  const Curve& curve = result.curve;
  result.elements = element_count(curve, line);
  for (const std::string& name : {line.from.name, line.to.name})
    if (!model.point_tag.contains(name)) model.point_tag[name] = gmsh_point(points.at(name)->position);
  const int first = model.point_tag[line.from.name], last = model.point_tag[line.to.name];
  if (curve.angle == 0.0) {
    result.curve_tags = {gmsh::model::geo::addLine(first, last)};
    divisions.emplace_back(result.curve_tags[0], result.elements);
    return result;
  }
  const int cuts = static_cast<int>(curve.angle / 2.0) + 1;
  if (result.elements < cuts)
    throw Error(fmt::format("beam '{}': {} elements for an arc of {:.0f} degrees", line.name, result.elements,
                            curve.angle * 180.0 / EIGEN_PI),
                line.where, fmt::format("use at least {} elements", cuts));
  const int center = gmsh_point(curve.center);
  int start = first, done = 0;
  for (int k = 1; k <= cuts; ++k) {
    const int until = result.elements * k / cuts;
    const int end = k == cuts ? last : gmsh_point(curve.at(static_cast<double>(until) / result.elements));
    result.curve_tags.push_back(gmsh::model::geo::addCircleArc(start, center, end));
    divisions.emplace_back(result.curve_tags.back(), until - done);
    start = end;
    done = until;
  }
  return result;
}

GmshModel build_and_mesh(const formats::Part& part) {
  GmshModel model;
  std::vector<std::pair<int, int>> divisions;
  const PointTable points = point_table(part);
  gmsh::model::add(part.name);
  for (const formats::BeamLine& line : part.beams) model.lines.push_back(add_line(points, line, model, divisions));
  gmsh::model::geo::synchronize();
  for (const auto& [curve, elements] : divisions) gmsh::model::mesh::setTransfiniteCurve(curve, elements + 1);
  gmsh::model::mesh::generate(1);
  return model;
}

/// gmsh node tags along the line, in order from `from` to `to`.
std::vector<std::size_t> nodes_along(const MeshedLine& line) {
  std::vector<std::size_t> result;
  for (const int tag : line.curve_tags) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, 1, tag);
    TISSERAND_ENSURE(types.size() == 1, "curve {} has {} element types", tag, types.size());
    for (std::size_t e = 0; e < elements[0].size(); ++e) {
      if (result.empty()) result.push_back(nodes[0][0]);
      TISSERAND_ENSURE(nodes[0][2 * e] == result.back(), "elements of curve {} are not in order", tag);
      result.push_back(nodes[0][2 * e + 1]);
    }
  }
  TISSERAND_ENSURE(static_cast<int>(result.size()) == line.elements + 1, "{} nodes for {} elements", result.size(),
                   line.elements);
  return result;
}

/// The given orientation, or by the rule of PART.md the global axis that is most nearly normal to the line everywhere
/// (ties: y before z before x).
Eigen::Vector3d section_orientation(const formats::BeamLine& line, const Curve& curve, int elements) {
  if (line.orientation) return *line.orientation;
  Eigen::Vector3d largest = Eigen::Vector3d::Zero();
  for (int e = 0; e < elements; ++e) {
    const Eigen::Vector3d chord = curve.at((e + 1.0) / elements) - curve.at(static_cast<double>(e) / elements);
    largest = largest.cwiseMax(chord.normalized().cwiseAbs());
  }
  int best = 1;
  for (const int axis : {2, 0})
    if (largest[axis] < largest[best] - 1e-9) best = axis;
  return Eigen::Vector3d::Unit(best);
}

BeamElementData element_data(const formats::Part& part, const formats::BeamLine& line, double length) {
  BeamElementData data;
  data.section = find_named(part.sections, line.section, "section", line);
  data.material = find_named(part.materials, line.material, "material", line);
  data.length = length;
  data.theory = line.theory;
  data.mass_matrix = line.mass_matrix;
  data.rotary_inertia = line.rotary_inertia ? RotaryInertia::with : RotaryInertia::without;
  return data;
}

/// Elements of one line between mesh nodes `nodes`, whose positions are already exact.
void append_beams(const formats::Part& part, const formats::BeamLine& line, const MeshedLine& meshed,
                  const std::vector<int>& nodes, Mesh& mesh) {
  const Eigen::Vector3d orientation = section_orientation(line, meshed.curve, meshed.elements);
  const int property = static_cast<int>(mesh.beam_properties.size());
  const double length = (mesh.position.col(nodes[1]) - mesh.position.col(nodes[0])).norm();
  mesh.beam_properties.push_back({element_data(part, line, length), line.name});
  for (int e = 0; e < meshed.elements; ++e) {
    const Eigen::Vector3d axis = mesh.position.col(nodes[e + 1]) - mesh.position.col(nodes[e]);
    const std::optional<Eigen::Matrix3d> R_PE = beam_axes(axis, orientation);
    if (!R_PE)
      throw Error(fmt::format("beam '{}': orientation ({:g}, {:g}, {:g}) is parallel to the beam at element {}",
                              line.name, orientation.x(), orientation.y(), orientation.z(), e + 1),
                  line.where, "give an orientation that is nowhere parallel to the beam");
    mesh.beams.push_back({nodes[e], nodes[e + 1], *R_PE, property});
  }
}

/// Mesh node of a point that a boundary node or a mass uses.
int node_of_point(const PointTable& points, const std::map<std::string, int>& node, const std::string& point,
                  const std::string& user, const std::string& where) {
  find_point(points, point, user, where);
  const auto found = node.find(point);
  if (found == node.end())
    throw Error(fmt::format("{}: no beam ends at point '{}'", user, point), where,
                "end a beam there, or use a point where one ends");
  return found->second;
}

void append_masses_and_boundary(const formats::Part& part, const std::map<std::string, int>& node, Mesh& mesh) {
  const PointTable points = point_table(part);
  for (const formats::PointMass& mass : part.point_masses)
    mesh.masses.push_back({node_of_point(points, node, mass.at.name, fmt::format("point mass '{}'", mass.name), mass.where),
                           mass.mass, mass.inertia});
  if (part.boundary.empty())
    throw Error("the part has no boundary node", part.file, "name at least one point under `boundary`");
  std::map<int, std::string> used;
  for (const formats::BoundaryNode& b : part.boundary) {
    const std::string user = fmt::format("boundary node '{}'", b.name);
    if (!b.translations && !b.rotations)
      throw Error(user + " retains neither translations nor rotations", b.where,
                  "retain one of them or remove the node");
    const int n = node_of_point(points, node, b.at.name, user, b.where);
    if (const auto [other, fresh] = used.emplace(n, b.name); !fresh)
      throw Error(fmt::format("{} is at the same point as boundary node '{}'", user, other->second), b.where,
                  "keep one of the two");
    mesh.boundary.push_back({b.name, n, b.translations, b.rotations});
  }
}

/// Numbers the nodes (named points in the order of the part, then inner nodes line by line). gmsh places nodes to about
/// 1e-8 of the length; here they go to where the curve is exactly.
Mesh collect(const formats::Part& part, const GmshModel& model) {
  Mesh mesh;
  std::vector<Eigen::Vector3d> position;
  std::map<std::string, int> node;
  for (const formats::NamedPoint& point : part.points)
    if (model.point_tag.contains(point.name)) {
      node[point.name] = static_cast<int>(position.size());
      position.push_back(point.position);
      mesh.node_label.push_back(point.name);
    }
  std::vector<std::vector<int>> line_nodes;
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const std::vector<std::size_t> tags = nodes_along(model.lines[i]);
    std::vector<int> nodes{node.at(part.beams[i].from.name)};
    for (std::size_t k = 1; k + 1 < tags.size(); ++k) {
      nodes.push_back(static_cast<int>(position.size()));
      position.push_back(model.lines[i].curve.at(static_cast<double>(k) / model.lines[i].elements));
      mesh.node_label.push_back(fmt::format("{}[{}]", part.beams[i].name, k));
    }
    nodes.push_back(node.at(part.beams[i].to.name));
    line_nodes.push_back(nodes);
  }
  mesh.position.resize(3, static_cast<Eigen::Index>(position.size()));
  for (std::size_t i = 0; i < position.size(); ++i) mesh.position.col(static_cast<Eigen::Index>(i)) = position[i];
  for (std::size_t i = 0; i < model.lines.size(); ++i)
    append_beams(part, part.beams[i], model.lines[i], line_nodes[i], mesh);
  append_masses_and_boundary(part, node, mesh);
  return mesh;
}

void add_physical_groups(const formats::Part& part, const GmshModel& model) {
  for (std::size_t i = 0; i < model.lines.size(); ++i)
    gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, model.lines[i].curve_tags), part.beams[i].name);
  const auto mark = [&model](const std::string& point, const std::string& name) {
    gmsh::model::setPhysicalName(0, gmsh::model::addPhysicalGroup(0, {model.point_tag.at(point)}), name);
  };
  for (const formats::BoundaryNode& b : part.boundary) mark(b.at.name, b.name);
  for (const formats::PointMass& m : part.point_masses) mark(m.at.name, m.name);
}

void check_has_beams(const formats::Part& part) {
  if (part.beams.empty()) throw Error("the part has no beams", part.file, "give at least one entry under `beams`");
}

}  // namespace

Mesh mesh_part(const formats::Part& part) {
  check_has_beams(part);
  return with_gmsh(part.file, [&part] {
    const GmshSession session;
    return collect(part, build_and_mesh(part));
  });
}

Mesh write_gmsh_file(const formats::Part& part, const std::string& path) {
  check_has_beams(part);
  return with_gmsh(part.file, [&] {
    const GmshSession session;
    const GmshModel model = build_and_mesh(part);
    Mesh mesh = collect(part, model);
    add_physical_groups(part, model);
    const std::string temporary = temporary_beside(path) + ".msh";
    gmsh::write(temporary);
    publish_file(temporary, path);
    return mesh;
  });
}

}  // namespace tisserand::reducer
