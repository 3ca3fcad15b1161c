// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces from meshes and shapes of recovery files.
#include "mechanism/view/recovered_shape.hpp"

#include <algorithm>
#include <filesystem>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/page/skin.hpp"
#include "formats/recovery/load_factors.hpp"

namespace tisserand::mechanism {
namespace {

using formats::Thinned;
using formats::thinned;
namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using formats::Recovery;

std::string content_id_of(const ViewedRun& run, const ViewedBody& body) {
  if (!body.file.content_id.empty()) return body.file.content_id;
  const auto& ids = run.layout().superelement_content_ids;
  return body.superelement >= 0 && body.superelement < count_of(ids) ? ids[body.superelement] : "";
}

/// A recovery file, and the mirror axes of the body relative to it.
struct Found {
  std::unique_ptr<formats::RecoveryReader> reader;
  Vector3d axes = Vector3d::Ones();
};

/// Recovery file of this superelement; absent with a `fault` if it belongs to another one.
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

/// Converts columns to coordinates in units of the scene and of the mirror image. Translations of nodes are lengths of
/// the scene. All others give displacements in lengths of the file, which become those of the scene.
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

/// Converts stresses [xx yy zz xy yz zx] per vertex to units of the scene and axes of the mirror image.
void convert_tensors(const UnitConversion& to_scene, const Vector3d& axes, MatrixXd& stresses) {
  stresses *= to_scene.force() / (to_scene.length * to_scene.length);
  const double sign[] = {1.0, 1.0, 1.0, axes.x() * axes.y(), axes.y() * axes.z(), axes.z() * axes.x()};
  for (Index row = 0; row < stresses.rows(); ++row) stresses.row(row) *= sign[row % 6];
}

/// Converts stresses per coordinate, for coordinates as in convert_columns().
void convert_stresses(const Recovery& recovery, const UnitConversion& to_scene, const Vector3d& axes,
                      MatrixXd& stresses) {
  convert_tensors(to_scene, axes, stresses);
  for (Index k = 0; k < stresses.cols(); ++k) {
    if (recovery.dof_node[k] < 0) continue;
    const int component = recovery.dof_component[k];
    stresses.col(k) *= axes[component % 3] * (component < 3 ? 1.0 / to_scene.length : axes.prod());
  }
}

MatrixXd beside(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd both(A.rows(), A.cols() + B.cols());
  both << A, B;
  return both;
}

/// Sources of the shape of a deformable body: its run and body, the recovery file, the carriers of the vertices.
struct Sources {
  ViewedRun& run;
  const ViewedBody& body;
  const Found& found;
  const UnitConversion& to_scene;
  std::vector<formats::SkinCarrier> carriers;
};

/// Appends columns after those of the coordinates, each with its displacement, stress and amplitudes.
void add_columns(const MatrixXd& modes, const MatrixXd& stress, const MatrixXd& amplitudes, BodyShape& shape) {
  formats::Deformation& d = shape.deformation;
  d.modes = beside(d.modes, modes);
  if (shape.stress.size() > 0) shape.stress = beside(shape.stress, stress);
  d.amplitudes = beside(d.amplitudes, amplitudes);
  shape.coordinate_node.resize(static_cast<std::size_t>(d.modes.cols()), BodyShape::beyond);
  shape.coordinate_component.resize(static_cast<std::size_t>(d.modes.cols()), 0);
}

/// Appends columns that move vertices by lengths of the file, and stress them. They are scaled so that amplitudes are
/// up to 1, since a page keeps what is large relative to the largest column (formats/page/deformation.hpp). `stress`:
/// without columns if there is none.
void add_answers(const Sources& from, MatrixXd modes, MatrixXd stress, MatrixXd factor, BodyShape& shape) {
  modes *= from.to_scene.length;
  for (Index v = 0; v < modes.rows(); v += 3)
    modes.middleRows(v, 3) = (from.found.axes.asDiagonal() * modes.middleRows(v, 3)).eval();
  if (stress.size() > 0)
    convert_tensors(from.to_scene, from.found.axes, stress);
  else if (shape.stress.size() > 0)
    stress = MatrixXd::Zero(shape.stress.rows(), modes.cols());
  for (Index a = 0; a < factor.cols(); ++a) {
    const double reach = factor.col(a).cwiseAbs().maxCoeff();
    if (!(reach > 0.0)) continue;
    factor.col(a) /= reach;
    modes.col(a) *= reach;
    if (stress.size() > 0) stress.col(a) *= reach;
  }
  add_columns(modes, stress, factor, shape);
}

/// Adds the displacement of second order, which moves interior vertices beyond y if the body is bent and stiffened.
void add_second_order(const Sources& from, const Eigen::RowVectorXd& stiffened, const std::vector<Index>& dropped,
                      BodyShape& shape) {
  if (!(stiffened.maxCoeff() > 0.0)) return;
  const Recovery& recovery = from.found.reader->recovery();
  if (!recovery.second_order) {
    from.run.notes.push_back(fmt::format("body '{}': {}", from.body.name, formats::no_second_order_note));
    return;
  }
  const int count = recovery.coordinates();
  MatrixXd y = shape.deformation.amplitudes.leftCols(count).transpose();
  formats::to_part(recovery, from.found.axes, from.to_scene.length, y);
  const MatrixXd amplitudes = formats::add_second_order(*recovery.second_order, stiffened, dropped, y);
  for (const Index k : dropped) shape.deformation.amplitudes.col(k) = y.row(k).transpose();  // internal: as in the file
  if (amplitudes.rows() > 0)
    add_answers(from, formats::second_order_shapes_at(*from.found.reader, from.carriers), MatrixXd(),
                amplitudes.transpose(), shape);
}

/// Adds what y does not contain: the second-order strain of stress, its displacement, and the static answers to inertia
/// loads, which move vertices and stress them.
void add_strain_and_loads(const Sources& from, BodyShape& shape) {
  const auto& [run, body, found, to_scene, carriers] = from;
  const Recovery& recovery = found.reader->recovery();
  const int first = run.layout().modes_offset[body.superelement], count = recovery.coordinates();
  formats::Deformation& d = shape.deformation;
  const MatrixXd all_strain = run.reader->read_dataset("superelements/y_strain", run.rows);
  const bool has_strain = all_strain.cols() >= first + count;
  const formats::LoadFactors loads =
      formats::load_factors(recovery, *run.reader, run.rows,
                            {static_cast<std::size_t>(body.superelement), found.axes, body.origin, to_scene});
  const MatrixXd y = d.amplitudes, strain = has_strain ? MatrixXd(all_strain.middleCols(first, count)) : y;
  const Eigen::RowVectorXd stiffened = formats::stiffened_instants(
      run.layout().is_stiffened(static_cast<std::size_t>(body.superelement)), y.transpose(), strain.transpose());
  const std::vector<Index> dropped = formats::dropped_modes(recovery, y.transpose());
  if (loads.known())
    for (const Index k : dropped)
      d.amplitudes.col(k) = (recovery.loads->share.row(k) * loads.factor / recovery.loads->stiffness[k]).transpose();
  const MatrixXd linear = d.amplitudes, of_coordinates = shape.stress;
  add_second_order(from, stiffened, dropped, shape);
  if (shape.stress.size() > 0 && has_strain)
    add_columns(MatrixXd::Zero(d.modes.rows(), count), of_coordinates,
                strain - y + linear - d.amplitudes.leftCols(count), shape);
  if (!loads.known()) return;
  add_answers(from, formats::load_shapes_at(*found.reader, carriers),
              shape.stress.size() > 0 ? formats::load_stresses_at(*found.reader, carriers) : MatrixXd(),
              loads.factor.transpose(), shape);
}

}  // namespace

std::optional<BodyShape> recovered_shape(ViewedRun& run, const ViewedBody& body, const ShapeOptions& options) {
  if (body.superelement < 0 && body.kind != "rigid") return {};
  const std::optional<Found> found = find_recovery(run, body, options);
  if (!found) return {};
  const Recovery& recovery = found->reader->recovery();
  const Units& units = run.layout().units;
  const UnitConversion to_scene = convert_units(recovery.units, units, found->reader->path());
  const double length = to_scene.length;
  const formats::Skin skin = formats::skin_of(recovery);
  BodyShape shape;
  shape.source = "recovery";
  shape.all_vertices = skin.surface.size();
  Thinned few = thinned(skin.surface, most_vertices);
  Sources from{run, body, *found, to_scene, {}};
  for (const int v : few.kept) {
    from.carriers.push_back(skin.carriers[v]);
    shape.surface.vertices.push_back(length * found->axes.cwiseProduct(skin.surface.vertices[v]) - body.origin);
  }
  if (few.triangles.size() == skin.triangle_element.size()) shape.elements = skin.triangle_element;
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
        y.cols() == 0 ? "superelements/y is not stored" : "its recovery file has a different number of coordinates"));
    return shape;
  }
  shape.deformation.modes = formats::shapes_at(*found->reader, from.carriers);
  convert_columns(recovery, length, found->axes, shape.deformation.modes);
  if (options.stress) {
    shape.stress = formats::stresses_at(*found->reader, from.carriers);
    convert_stresses(recovery, to_scene, found->axes, shape.stress);
  }
  shape.deformation.amplitudes = y.middleCols(first, count);
  const std::vector<std::string>& nodes = run.layout().nodes;
  for (int k = 0; k < count; ++k) {
    const int boundary = recovery.dof_node[k];
    const auto node =
        boundary < 0 ? nodes.end() : std::ranges::find(nodes, body.name + "/" + recovery.boundary_name[boundary]);
    shape.coordinate_node.push_back(node == nodes.end() ? -1 : static_cast<int>(node - nodes.begin()));
    shape.coordinate_component.push_back(recovery.dof_component[k]);
  }
  add_strain_and_loads(from, shape);
  return shape;
}

void require_used_recovery(const ViewedRun& run, const ShapeOptions& options) {
  for (const std::string& path : options.recovery) {
    const formats::RecoveryReader reader(path);
    std::string fault = "does not belong to a superelement of this run";
    const bool used = std::ranges::any_of(run.bodies, [&](const ViewedBody& body) {
      const std::string id = content_id_of(run, body);
      return !id.empty() && matching(path, id, body.name, fault).has_value();
    });
    if (!used) throw Error(fault, path, "give the recovery file that was written with the superelement of this run");
  }
}

}  // namespace tisserand::mechanism
