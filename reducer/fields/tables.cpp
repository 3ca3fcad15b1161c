// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of a recovery file from mesh and properties.
#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <utility>

#include "formats/superelement/mirror.hpp"
#include "reducer/algebra/petsc.hpp"
#include "reducer/elements/shell/geometry.hpp"
#include "reducer/elements/turning_mass.hpp"
#include "reducer/fields/fields.hpp"
#include "reducer/fields/surface.hpp"
#include "reducer/loads/load_vectors.hpp"
#include "reducer/second_order/inertia_loads.hpp"

namespace tisserand::reducer {
namespace {

using formats::ElementShape;
using formats::Recovery;

ElementShape shape_of(SolidShape shape) {
  constexpr std::array shapes{ElementShape::tetrahedron4, ElementShape::tetrahedron10, ElementShape::hexahedron8,
                              ElementShape::hexahedron20, ElementShape::prism6,        ElementShape::prism15};
  return shapes[static_cast<int>(shape)];
}

/// Head of the tables for `part`, a Superelement or ModalBody.
template <class Part, class Image>
Recovery head_of(const Part& part, const Image& image) {
  Recovery r;
  r.name = part.name;
  r.producer = part.producer;
  r.units = part.units;
  r.content_id = formats::content_id(part);
  for (int k = 0; k < 7; ++k) r.mirror_content_id[k] = formats::content_id(image(formats::mirror_axes(k)));
  return r;
}

/// Rows of Recovery::elements. Groups are the properties of beams, then of shells, then of solids.
class ElementTable {
 public:
  explicit ElementTable(formats::RecoveryElements& elements) : elements_(elements) { elements_.first.push_back(0); }

  void add(ElementShape shape, const int* nodes, int group, int id) {
    elements_.shape.push_back(shape);
    elements_.group.push_back(group);
    elements_.id.push_back(id);
    elements_.node.insert(elements_.node.end(), nodes, nodes + formats::node_count(shape));
    elements_.first.push_back(count_of(elements_.node));
  }

 private:
  formats::RecoveryElements& elements_;
};

void add_beams(const Mesh& mesh, ElementTable& table, Recovery& r) {
  for (const BeamProperty& property : mesh.beam_properties) {
    const auto& stations = property.data.stations;
    r.sections.push_back(recovery_section(stations.empty() ? property.data.section : stations.front()));
    r.sections.push_back(recovery_section(stations.empty() ? property.data.section : stations.back()));
  }
  r.beam_offset.resize(3, 2 * static_cast<Eigen::Index>(mesh.beams.size()));
  for (const BeamElement& beam : mesh.beams) {
    const int nodes[] = {beam.first, beam.second};
    table.add(ElementShape::beam, nodes, beam.property, beam.id);
    const Eigen::Index column = 2 * static_cast<Eigen::Index>(r.beam_axes.size());
    r.beam_offset.col(column) = beam.first_offset;
    r.beam_offset.col(column + 1) = beam.second_offset;
    r.beam_section.insert(r.beam_section.end(), {2 * beam.property, 2 * beam.property + 1});
    r.beam_axes.push_back(beam.R_PE);
  }
}

/// Axes of the element: z along the normal of the middle plane, x as for stresses.
Eigen::Matrix3d axes_of(const Mesh& mesh, const ShellElement& shell) {
  return shell.corners() == 3 ? shell_geometry<3>(mesh, shell).R_PE : shell_geometry<4>(mesh, shell).R_PE;
}

void add_shells(const Mesh& mesh, int first_group, ElementTable& table) {
  for (const ShellElement& shell : mesh.shells) {
    const bool triangle = shell.corners() == 3;
    table.add(triangle ? ElementShape::triangle : ElementShape::quadrilateral, shell.nodes.data(),
              first_group + shell.property, shell.id);
  }
}

void add_shell_data(const Mesh& mesh, Recovery& r) {
  for (const ShellElement& shell : mesh.shells) {
    r.shell_axes.push_back(axes_of(mesh, shell));
    r.shell_thickness.push_back(mesh.shell_properties[shell.property].section.thickness);
    r.shell_offset.push_back(shell.offset);
  }
}

void add_solids(const Mesh& mesh, int first_group, ElementTable& table, Recovery& r) {
  std::vector<std::pair<int, int>> points;
  for (const SolidElement& solid : mesh.solids) {
    table.add(shape_of(solid.shape), solid.nodes.data(), first_group + solid.property, solid.id);
    for (const int node : nodes_of(solid)) points.emplace_back(node, first_group + solid.property);
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (const auto& [node, group] : points) {
    r.stress_node.push_back(node);
    r.stress_group.push_back(group);
  }
}

/// Motions of nodes from displacements of all coordinates of the mesh.
MotionSource motions_of(std::shared_ptr<const Eigen::MatrixXd> x, const Coordinates& numbers) {
  const Eigen::Index columns = x->cols();
  const auto motions = [x = std::move(x), &numbers](const std::vector<int>& nodes) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(nodes.size()), x->cols());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (int k = numbers.first[nodes[i]]; k < numbers.first[nodes[i] + 1]; ++k)
        out.row(6 * static_cast<Eigen::Index>(i) + numbers.component[k]) = x->row(k);
    return out;
  };
  return {motions, columns};
}

Eigen::MatrixXd beside(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  Eigen::MatrixXd both(A.rows(), A.cols() + B.cols());
  both << A, B;
  return both;
}

/// Forces on some coordinates q.
struct CoordinateForces {
  Eigen::MatrixXd rows;
  std::vector<int> row_of;  ///< row of each q; −1 if it bears no force
};

/// Forces on the nodes that do the same work, on coordinates that ties leave independent. Empty if an auxiliary
/// coordinate, which belongs to no node, bears a force.
MotionSource nodal_forces_of(const System& system, CoordinateForces forces) {
  constexpr double round_off = 1e-12;
  const Coordinates& numbers = system.coordinates;
  const double largest = forces.rows.size() > 0 ? forces.rows.cwiseAbs().maxCoeff() : 0.0;
  for (int q = 0; q < system.size(); ++q)
    if (const int row = forces.row_of[q]; row >= 0 && system.T.source[q] >= numbers.count() &&
                                          forces.rows.row(row).cwiseAbs().sum() > round_off * largest)
      return {};
  const Eigen::Index columns = forces.rows.cols();
  const auto shared = std::make_shared<const CoordinateForces>(std::move(forces));
  const auto motions = [shared, &system, &numbers](const std::vector<int>& nodes) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(nodes.size()), shared->rows.cols());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (int x = numbers.first[nodes[i]]; x < numbers.first[nodes[i] + 1]; ++x) {
        const int q = system.T.row[x], row = q < 0 ? -1 : shared->row_of[q];
        if (row >= 0) out.row(6 * static_cast<Eigen::Index>(i) + numbers.component[x]) = shared->rows.row(row);
      }
    return out;
  };
  return {motions, columns};
}

/// S_II φ of each internal coordinate; for modes by their eigenvalue, which avoids the round-off of S.
CoordinateForces mode_forces(const ReducedPart& part) {
  const InternalModes& internal = part.internal;
  const Eigen::Index m = internal.Phi.cols(), vectors = internal.free_modes ? m : internal.moments;
  CoordinateForces forces{Eigen::MatrixXd(internal.Phi.rows(), m),
                          std::vector<int>(static_cast<std::size_t>(part.system.size()), -1)};
  if (vectors < m)
    forces.rows.leftCols(m - vectors) =
        multiply(part.blocks.M_II, internal.Phi.leftCols(m - vectors)) * internal.lambda.head(m - vectors).asDiagonal();
  if (vectors > 0) forces.rows.rightCols(vectors) = multiply(part.blocks.S_II, internal.Phi.rightCols(vectors));
  for (int i = 0; i < std::ssize(part.partition.internal); ++i) forces.row_of[part.partition.internal[i]] = i;
  return forces;
}

void add_forces(const ReducedPart& part, Eigen::MatrixXd load_force, RecoverySource& source) {
  std::vector<int> all(static_cast<std::size_t>(part.system.size()));
  std::iota(all.begin(), all.end(), 0);
  source.load_forces = nodal_forces_of(part.system, {std::move(load_force), std::move(all)});
  source.mode_forces = nodal_forces_of(part.system, mode_forces(part));
  const Eigen::Index n_B = part.partition.n_B();
  if (source.load_forces.motions && source.mode_forces.motions)
    source.head.loads->boundary_stiffness = part.element.stiffness.topLeftCorner(n_B, n_B);
}

/// Adds the load cases of the part after the twelve inertia loads.
void add_load_cases(const ReducedPart& part, InertiaAnswers& answers, formats::RecoveryLoads& loads) {
  if (part.mesh.load_cases.empty()) return;
  const System& system = part.system;
  const InternalModes& internal = part.internal;
  const Eigen::MatrixXd f = load_vectors(part.mesh, system).q;
  answers.x = beside(answers.x, expand(system.T, residual_displacements(part, f)));
  Eigen::MatrixXd share = Eigen::MatrixXd::Zero(internal.lambda.size(), f.cols());
  if (part.partition.n_I() > 0) share = internal.Phi.transpose() * rows(f, part.partition.internal);
  share.topRows(internal.loose()).setZero();
  answers.share = beside(answers.share, share);
  answers.force = beside(answers.force, f);
  for (const MeshLoadCase& load : part.mesh.load_cases) loads.applied.push_back({load.name, "", 0});
}

void add_loads(const ReducedPart& part, RecoverySource& source) {
  const InternalModes& internal = part.internal;
  InertiaAnswers answers = inertia_answers(part, formats::rigid_properties(part.element).center_of_mass);
  formats::RecoveryLoads loads;
  loads.reference_point = answers.reference_point;
  add_load_cases(part, answers, loads);
  const Eigen::Index n = part.element.size(), m = internal.lambda.size();
  loads.share = Eigen::MatrixXd::Zero(n, loads.columns());
  loads.share.bottomRows(m) = answers.share;
  loads.stiffness = Eigen::VectorXd::Zero(n);
  loads.stiffness.tail(m) = internal.lambda;
  loads.stiffness.segment(n - m, internal.loose())
      .setConstant(m > internal.loose() ? internal.lambda[internal.loose()] : 1.0);
  loads.left_out = internal.first_dropped.value_or(m > 0 && m < internal.available ? internal.lambda.maxCoeff() : 0.0);
  source.head.loads = std::move(loads);
  add_forces(part, std::move(answers.force), source);
  source.loads = motions_of(std::make_shared<const Eigen::MatrixXd>(std::move(answers.x)), part.system.coordinates);
}

}  // namespace

Recovery mesh_tables(const Mesh& mesh) {
  Recovery r;
  for (const MeshBoundary& boundary : mesh.boundary) {
    r.boundary_name.push_back(boundary.name);
    r.boundary_node.push_back(boundary.node);
  }
  r.position = mesh.position;
  r.node_label = mesh.node_label;
  r.node_number = mesh.node_number;
  r.node_number.resize(r.node_label.size(), 0);
  for (const BeamProperty& property : mesh.beam_properties) r.group_name.push_back(property.name);
  for (const ShellProperty& property : mesh.shell_properties) r.group_name.push_back(property.name);
  for (const SolidProperty& property : mesh.solid_properties) r.group_name.push_back(property.name);
  const int shell_groups = count_of(mesh.beam_properties);
  const int solid_groups = shell_groups + count_of(mesh.shell_properties);
  ElementTable table(r.elements);
  add_beams(mesh, table, r);
  add_shells(mesh, shell_groups, table);
  add_solids(mesh, solid_groups, table, r);
  const Surface seen = surface(mesh);
  r.triangle.resize(3, static_cast<Eigen::Index>(seen.triangle.size()));
  for (std::size_t k = 0; k < seen.triangle.size(); ++k)
    r.triangle.col(static_cast<Eigen::Index>(k)) = seen.triangle[k];
  r.triangle_element = seen.element;
  return r;
}

Recovery solved_tables(const Mesh& mesh, const Coordinates& coordinates) {
  Recovery r = mesh_tables(mesh);
  for (int n = 0; n < mesh.nodes(); ++n) r.rotates.push_back(coordinates.rotates(n) ? 1 : 0);
  add_shell_data(mesh, r);
  return r;
}

RecoverySource recovery_source(const ReducedPart& part, std::optional<SecondOrderDisplacement> second_order) {
  const System& system = part.system;
  const formats::Superelement& superelement = part.element;
  const auto shapes = std::make_shared<const FullShapes>(part);
  Recovery head = head_of(superelement, [&](const Eigen::Vector3d& axes) {
    return formats::mirrored(formats::LoadedSuperelement{superelement, {}}, axes).superelement;
  });
  head.dof_node = superelement.dof_node;
  head.dof_component = superelement.dof_component;
  RecoverySource source{
      .mesh = part.mesh,
      .coordinates = system.coordinates,
      .motion = {[shapes](const auto& nodes) { return shapes->motions(nodes); }, shapes->coordinates()},
      .head = std::move(head)};
  if (part.internal.boundary_mass.size() == 0) add_loads(part, source);
  if (second_order) {
    source.head.second_order = std::move(second_order->forms);
    source.second_order =
        motions_of(std::make_shared<const Eigen::MatrixXd>(std::move(second_order->x)), system.coordinates);
  }
  return source;
}

RecoverySource recovery_source(const Mesh& mesh, const System& system, const Eigen::MatrixXd& q,
                               const formats::ModalBody& body, Eigen::MatrixXd answers) {
  Recovery head = head_of(body, [&](const Eigen::Vector3d& axes) {
    return formats::mirrored(formats::LoadedModalBody{body, {}}, axes).body;
  });
  for (int k = 0; k < q.cols(); ++k) {
    head.dof_node.push_back(-1);
    head.dof_component.push_back(k);
  }
  return {.mesh = mesh,
          .coordinates = system.coordinates,
          .motion = motions_of(std::make_shared<const Eigen::MatrixXd>(expand(system.T, q)), system.coordinates),
          .loads = motions_of(std::make_shared<const Eigen::MatrixXd>(std::move(answers)), system.coordinates),
          .head = std::move(head),
          .is_modal = true};
}

Recovery recovery_tables(const RecoverySource& source) {
  Recovery r = solved_tables(source.mesh, source.coordinates);
  const Recovery& head = source.head;
  r.name = head.name;
  r.producer = head.producer;
  r.units = head.units;
  r.content_id = head.content_id;
  r.mirror_content_id = head.mirror_content_id;
  r.dof_node = head.dof_node;
  r.dof_component = head.dof_component;
  r.loads = head.loads;
  r.second_order = head.second_order;
  return r;
}

}  // namespace tisserand::reducer
