// From meshes and shapes of recovery files to surfaces.
#include "mechanism/view/recovered_shape.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/recovery/recovery.hpp"

namespace tisserand::mechanism {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using formats::Recovery;
using formats::RecoveryField;

std::string content_id_of(const ViewedRun& run, const ViewedBody& body) {
  if (!body.file.content_id.empty()) return body.file.content_id;
  const auto& ids = run.layout().superelement_content_ids;
  return body.superelement >= 0 && body.superelement < static_cast<int>(ids.size()) ? ids[body.superelement] : "";
}

/// A recovery file and the mirror image of it that a body is.
struct Found {
  std::unique_ptr<formats::RecoveryReader> reader;
  Vector3d axes = Vector3d::Ones();
};

/// Nothing, and what is wrong, if the file is of another superelement.
std::optional<Found> matching(const std::string& path, const std::string& content_id, const std::string& body,
                              std::string& fault) {
  Found found{std::make_unique<formats::RecoveryReader>(path), Vector3d::Ones()};
  try {
    found.axes = formats::require_same_superelement(found.reader->recovery(), content_id, path, body);
    return found;
  } catch (const Error& error) {
    fault = error.what();
    return {};
  }
}

std::optional<Found> find_recovery(ViewedRun& run, const ViewedBody& body, const ShapeOptions& options) {
  const std::string content_id = content_id_of(run, body);
  if (content_id.empty()) return {};
  std::string fault;
  for (const std::string& path : options.recovery)
    if (auto found = matching(path, content_id, body.name, fault)) return found;
  if (body.file.file.empty()) return {};
  const fs::path beside = formats::recovery_path(body.file.file);
  std::error_code ignored;
  for (const fs::path& path : {beside, fs::path(run.reader->path()).parent_path() / beside.filename()}) {
    if (!fs::is_regular_file(path, ignored)) continue;
    if (auto found = matching(path.string(), content_id, body.name, fault)) return found;
    run.notes.push_back(fmt::format("{}: it is shown without its surface", fault));
  }
  return {};
}

/// Where a vertex is on the mesh: at a node, or carried by it at a distance.
struct Carrier {
  int node = 0;
  Vector3d arm = Vector3d::Zero();  ///< part axes, units of the file
};

struct Skin {
  Surface surface;  ///< part frame of the file, its units
  std::vector<Carrier> carriers;
};

/// Triangles of shells and solids.
void add_faces(const Recovery& recovery, Skin& skin) {
  std::vector<int> vertex(recovery.nodes(), -1);
  for (Index t = 0; t < recovery.triangle.cols(); ++t) {
    std::array<int, 3> triangle{};
    for (int k = 0; k < 3; ++k) {
      const int node = recovery.triangle(k, t);
      if (vertex[node] < 0) {
        vertex[node] = skin.surface.size();
        skin.surface.vertices.push_back(recovery.position.col(node));
        skin.carriers.push_back({node, Vector3d::Zero()});
      }
      triangle[k] = vertex[node];
    }
    skin.surface.triangles.push_back(triangle);
  }
}

/// Each beam as its sections at both ends.
void add_beams(const Recovery& recovery, Skin& skin) {
  for (int e = 0; e < recovery.beams(); ++e) {
    const int* nodes = recovery.elements.node.data() + recovery.elements.first[e];
    const std::vector<Eigen::Vector2d>*outlines[2], *first = nullptr;
    for (int end = 0; end < 2; ++end) outlines[end] = &recovery.sections[recovery.beam_section[2 * e + end]].outline;
    first = outlines[0];
    if (outlines[1]->size() != first->size()) outlines[1] = first;
    if (first->size() < 3) {  // a line
      const int at = skin.surface.size();
      skin.surface.lines.push_back({at, at + 1});
    } else {
      Surface faces = swept_faces(2, static_cast<int>(first->size()));
      const int at = skin.surface.size();
      for (const auto& [a, b, c] : faces.triangles) skin.surface.triangles.push_back({a + at, b + at, c + at});
    }
    for (int end = 0; end < 2; ++end) {
      const Vector3d offset = recovery.beam_offset.col(2 * e + end);
      const auto add = [&](const Vector3d& arm) {
        skin.surface.vertices.push_back(recovery.position.col(nodes[end]) + arm);
        skin.carriers.push_back({nodes[end], arm});
      };
      if (first->size() < 3)
        add(offset);
      else
        for (const Eigen::Vector2d& corner : *outlines[end])
          add(offset + recovery.beam_axes[e] * Vector3d(0.0, corner.x(), corner.y()));
    }
  }
}

/// Displacement of each kept vertex per unit of each coordinate: u + θ x arm, part axes and units of the file.
MatrixXd shapes_at(const formats::RecoveryReader& reader, const std::vector<Carrier>& carriers) {
  const Recovery& recovery = reader.recovery();
  MatrixXd shapes = MatrixXd::Zero(3 * carriers.size(), recovery.coordinates());
  std::multimap<int, Index> at;  // by node
  bool turns = false;
  for (std::size_t v = 0; v < carriers.size(); ++v) {
    at.emplace(carriers[v].node, static_cast<Index>(v));
    turns = turns || !carriers[v].arm.isZero(0.0);
  }
  for (const RecoveryField field : {RecoveryField::translation, RecoveryField::rotation}) {
    if (field == RecoveryField::rotation && !turns) break;
    const int chunk = formats::chunk_items(recovery, field);
    for (int first = 0; first < recovery.nodes(); first += chunk) {
      const int count = std::min(chunk, recovery.nodes() - first);
      const auto begin = at.lower_bound(first), end = at.lower_bound(first + count);
      if (begin == end) continue;
      const formats::FieldRows rows = reader.read(field, first, count);
      for (auto one = begin; one != end; ++one) {
        const auto values = rows.middleRows(3 * (one->first - first), 3).cast<double>();
        auto shape = shapes.middleRows(3 * one->second, 3);
        if (field == RecoveryField::translation)
          shape += values;
        else
          for (Index k = 0; k < shape.cols(); ++k)
            shape.col(k) += Vector3d(values.col(k)).cross(carriers[one->second].arm);
      }
    }
  }
  return shapes;
}

/// Columns for coordinates in units of the scene and of the image: translations of nodes are lengths of the scene, all
/// others take displacements in lengths of the file to those of the scene.
void convert_columns(const Recovery& recovery, double length, const Vector3d& axes, MatrixXd& shapes) {
  for (Index k = 0; k < shapes.cols(); ++k) {
    const int component = recovery.dof_component[k];
    const bool of_node = recovery.dof_node[k] >= 0;
    if (!of_node || component >= 3) shapes.col(k) *= length;
    if (of_node) shapes.col(k) *= axes[component % 3] * (component < 3 ? 1.0 : axes.prod());
  }
  for (Index v = 0; v < shapes.rows(); v += 3)
    shapes.middleRows(v, 3) = (axes.asDiagonal() * shapes.middleRows(v, 3)).eval();
}

}  // namespace

std::optional<BodyShape> recovered_shape(ViewedRun& run, const ViewedBody& body, const ShapeOptions& options) {
  if (body.superelement < 0 && body.kind != "rigid") return {};
  const std::optional<Found> found = find_recovery(run, body, options);
  if (!found) return {};
  const Recovery& recovery = found->reader->recovery();
  const Units& units = run.layout().units;
  const double length = convert_units(recovery.units, units, found->reader->path()).length;
  Skin skin;
  add_faces(recovery, skin);
  add_beams(recovery, skin);
  BodyShape shape;
  shape.source = "recovery";
  shape.all_vertices = skin.surface.size();
  Thinned few = thinned(skin.surface, options.vertices);
  std::vector<Carrier> carriers;
  for (const int v : few.kept) {
    carriers.push_back(skin.carriers[v]);
    shape.surface.vertices.push_back(length * found->axes.cwiseProduct(skin.surface.vertices[v]) - body.origin);
  }
  shape.surface.triangles = std::move(few.triangles);
  shape.surface.lines = std::move(few.lines);
  if (found->axes.prod() < 0.0)
    for (std::array<int, 3>& triangle : shape.surface.triangles) std::swap(triangle[1], triangle[2]);
  if (body.superelement < 0) return shape;
  const std::vector<int>& offset = run.layout().modes_offset;
  const int first = offset[body.superelement], count = offset[body.superelement + 1] - first;
  const MatrixXd y = run.reader->read_dataset("superelements/y", run.rows);
  if (y.cols() == 0 || count != recovery.coordinates()) {
    run.notes.push_back(fmt::format(
        "body '{}' is shown undeformed: {}", body.name,
        y.cols() == 0 ? "superelements/y is not stored" : "its recovery file has another number of coordinates"));
    return shape;
  }
  shape.deformation.modes = shapes_at(*found->reader, carriers);
  convert_columns(recovery, length, found->axes, shape.deformation.modes);
  shape.deformation.amplitudes = y.middleCols(first, count);
  const std::vector<std::string>& nodes = run.layout().nodes;
  for (int k = 0; k < count; ++k) {
    const int boundary = recovery.dof_node[k];
    const auto node =
        boundary < 0 ? nodes.end() : std::ranges::find(nodes, body.name + "/" + recovery.boundary_name[boundary]);
    shape.coordinate_node.push_back(node == nodes.end() ? -1 : static_cast<int>(node - nodes.begin()));
    shape.coordinate_component.push_back(recovery.dof_component[k]);
  }
  return shape;
}

void require_used_recovery(const ViewedRun& run, const ShapeOptions& options) {
  for (const std::string& path : options.recovery) {
    const formats::RecoveryReader reader(path);
    std::string fault = "belongs to no superelement of this run";
    const bool used = std::ranges::any_of(run.bodies, [&](const ViewedBody& body) {
      const std::string id = content_id_of(run, body);
      return !id.empty() && matching(path, id, body.name, fault).has_value();
    });
    if (!used) throw Error(fault, path, "give the recovery file that was written with the superelement of this run");
  }
}

}  // namespace tisserand::mechanism
