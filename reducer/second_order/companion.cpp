// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays of the companion file from the modes.
#include "reducer/second_order/companion.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "common/error.hpp"
#include "common/parallel.hpp"
#include "common/text.hpp"
#include "formats/companion/rigid_stress.hpp"
#include "formats/superelement/weights.hpp"
#include "reducer/elements/each_element.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "reducer/loads/load_vectors.hpp"
#include "reducer/second_order/displacement.hpp"
#include "reducer/second_order/double_curvature.hpp"
#include "reducer/second_order/geometric_stiffness.hpp"
#include "reducer/second_order/inertia.hpp"
#include "reducer/second_order/inertia_loads.hpp"
#include "reducer/second_order/quadratic_forms.hpp"
#include "reducer/second_order/tie_strain.hpp"
#include "reducer/ties/spring_turns.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int batch_rows = 1024;  ///< approximate number of stresses in a batch; a multiple of eight elements
constexpr int largest_batch = 64;

constexpr double reported_omissions = 0.01;  ///< share of the second-order displacement above which a note reports it
constexpr double large_file = 20e6;          ///< bytes above which a companion is written on request only

/// Size of the arrays in bytes before compression, for n coordinates.
double companion_bytes(Index coordinates) {
  const auto n = static_cast<double>(coordinates);
  return 8.0 * (0.5 * n * n * (n + 1.0) + 3.0 * n * n + 9.0 * n * (n + 1.0));
}

/// Values of all q for the reduced coordinates; boundary coordinates are reduced coordinates themselves.
MatrixXd reduced_displacements(const ReducedPart& part) {
  const Partition& p = part.partition;
  const Index m = part.internal.lambda.size();
  MatrixXd Phi = MatrixXd::Zero(part.system.size(), p.n_B() + m);
  for (Index b = 0; b < p.n_B(); ++b) Phi(p.boundary[b], b) = 1.0;
  for (Index i = 0; i < p.n_I(); ++i) {
    Phi.row(p.internal[i]).head(p.n_B()) = part.boundary.Psi.row(i);
    Phi.row(p.internal[i]).tail(m) = part.internal.Phi.row(i);
  }
  return Phi;
}

/// Stresses and gradients of the elements, computed by blocks of elements, in batches of one layout each.
class ElementBatches {
 public:
  ElementBatches(const Mesh& mesh, const Coordinates& coordinates, const MatrixXd& displacements, Index n, int threads)
      : mesh_(mesh),
        coordinates_(coordinates),
        displacements_(displacements),
        n_(n),
        threads_(threads),
        scratch_(static_cast<std::size_t>(threads)) {}

  /// Calls use(batches) for all elements in their order; `done` receives the share of them that is finished.
  template <class Use>
  void for_each(const Use& use, const std::function<void(double)>& done) {
    for (int first = 0; first < mesh_.elements(); first += block) {
      done(static_cast<double>(first) / mesh_.elements());
      const int count = std::min(block, mesh_.elements() - first);
      share_out(count, threads_, [&](int /*thread*/, int e) {
        with_element(mesh_, first + e, [&](const auto& kind) { second_order(mesh_, kind, rows_[e]); });
      });
      const int batches = start_batches(count);
      share_out(count, threads_, [&](int t, int e) { fill(first + e, e, scratch_[t]); });
      use(std::span(batches_.data(), static_cast<std::size_t>(batches)));
    }
  }

 private:
  static constexpr int block = 256;

  /// Place of an element of the block.
  struct Place {
    std::size_t batch = 0;
    int at = 0;
  };
  /// Work matrices of one thread.
  struct Scratch {
    MatrixXd d;
    MatrixXd product;
  };

  /// Divides the block into batches and sets their sizes; returns their number.
  int start_batches(int count) {
    int batches = 0;
    for (int begin = 0; begin < count; ++batches) {
      const SecondOrderRows& like = rows_[begin];
      const int most = std::clamp(batch_rows / static_cast<int>(like.stress.rows()) / 8 * 8, 8, largest_batch);
      int end = begin;
      for (; end < count && end - begin < most && rows_[end].sections == like.sections; ++end)
        place_[end] = {static_cast<std::size_t>(batches), end - begin};
      if (batches == count_of(batches_)) batches_.emplace_back();
      StrainBatch& batch = batches_[batches];
      batch.sections = like.sections;
      batch.count = end - begin;
      batch.stress.resize(like.stress.rows() * batch.count, displacements_.cols());
      batch.gradient.resize(like.gradient.rows() * batch.count, n_);
      begin = end;
    }
    return batches;
  }

  void fill(int element, int e, Scratch& scratch) {
    const SecondOrderRows& rows = rows_[e];
    StrainBatch& batch = batches_[place_[e].batch];
    scratch.d.resize(rows.stress.cols(), displacements_.cols());
    gather(element_rows(mesh_, coordinates_, element, scratch.d.rows()), displacements_, scratch.d);
    scratch.product.noalias() = rows.stress * scratch.d;
    put(scratch.product, place_[e].at, batch.count, batch.stress);
    scratch.product.noalias() = rows.gradient * scratch.d.leftCols(n_);
    put(scratch.product, place_[e].at, batch.count, batch.gradient);
  }

  /// Copies row r of element number `at` of a batch to row r · count + at.
  static void put(const MatrixXd& product, int at, int count, MatrixXd& all) {
    for (Index c = 0; c < product.cols(); ++c)
      for (Index r = 0; r < product.rows(); ++r) all(r * count + at, c) = product(r, c);
  }

  const Mesh& mesh_;
  const Coordinates& coordinates_;
  const MatrixXd& displacements_;
  Index n_;
  int threads_;
  std::vector<SecondOrderRows> rows_ = std::vector<SecondOrderRows>(block);
  std::vector<Place> place_ = std::vector<Place>(block);
  std::vector<StrainBatch> batches_;
  std::vector<Scratch> scratch_;
};

/// Loads on x: inertial loads, load cases (weight as translation), and those of shapes of second order (none: without
/// columns).
MatrixXd all_loads(const Mesh& mesh, const LoadVectors& cases, const MatrixXd& inertial, const MatrixXd& of_shapes) {
  const Index shapes = of_shapes.cols();
  MatrixXd g = MatrixXd::Zero(std::max(inertial.rows(), of_shapes.rows()), inertial_loads + cases.x.cols() + shapes);
  g.topLeftCorner(inertial.rows(), inertial_loads) = inertial;
  for (Index c = 0; c < cases.x.cols(); ++c)
    g.col(inertial_loads + c).head(inertial.rows()) = inertial.leftCols<3>() * mesh.load_cases[c].gravity;
  g.middleCols(inertial_loads, cases.x.cols()).topRows(cases.x.rows()) += cases.x;
  if (shapes > 0) g.rightCols(shapes).topRows(of_shapes.rows()) = of_shapes;
  return g;
}

/// Φᵀ f of the load cases, by name.
std::vector<formats::LoadCase> reduced_cases(const ReducedPart& part, const LoadVectors& cases) {
  const MatrixXd f_B = rows(cases.q, part.partition.boundary), f_I = rows(cases.q, part.partition.internal);
  MatrixXd force(f_B.rows() + part.internal.lambda.size(), f_B.cols());
  force << f_B + part.boundary.Psi.transpose() * f_I, part.internal.Phi.transpose() * f_I;
  std::vector<formats::LoadCase> reduced;
  for (Index c = 0; c < force.cols(); ++c) reduced.push_back({part.mesh.load_cases[c].name, force.col(c), {}});
  return reduced;
}

void sort_by_name(std::vector<formats::LoadCase>& cases) { std::ranges::sort(cases, {}, &formats::LoadCase::name); }

/// Second order of the weights of masses with an offset from their nodes, on ½ θ × (θ × c).
MatrixXd weight_on_arms(const Mesh& mesh, const Coordinates& coordinates, const Eigen::Vector3d& gravity,
                        const MatrixXd& Phi) {
  MatrixXd sum = MatrixXd::Zero(Phi.cols(), Phi.cols());
  for (const NodalMass& mass : mesh.masses) {
    if (mass.offset.isZero(0.0) || gravity.isZero(0.0) || !coordinates.rotates(mass.node)) continue;
    const auto theta = Phi.middleRows<3>(coordinates.of(mass.node, 3));
    sum += theta.transpose() * (arm_form(mass.mass * gravity, mass.offset) * theta);
  }
  return sum;
}

/// Sets mass, S0 and S1 of M̄.
void set_integrals(const formats::Superelement& element, formats::Companion& c) {
  const formats::RigidProperties rigid = formats::rigid_properties(element);
  c.mass = rigid.mass;
  c.S0 = rigid.mass * (rigid.center_of_mass - c.reference_point);
  c.S1 = formats::rigid_motions(element, c.reference_point).leftCols<3>().transpose() * element.mass;
}

/// Whether the part can deform. One node without internal coordinates moves rigidly, so its arrays are only round-off.
bool deforms(const formats::Superelement& element) {
  return element.node_position.rows() > 1 || std::ranges::any_of(element.dof_node, [](int node) { return node < 0; });
}

formats::Companion companion_head(const formats::Superelement& element, const Eigen::VectorXd& weights) {
  formats::Companion c;
  c.content_id = formats::content_id(element);
  c.producer = element.producer;
  c.units = element.units;
  c.weights = weights;
  c.reference_point = element.node_position.transpose() * weights;
  return c;
}

/// Number of rows, and the omitted shapes; nothing is omitted if all shapes of deformation are included.
std::string trapped_text(const formats::Companion& companion, int shapes) {
  const Index all = companion.S1.cols() - 6;
  return fmt::format(
      "The companion file holds {} rows of membrane stress that is trapped by bending{}.", companion.Lambda.size(),
      shapes < all
          ? fmt::format(
                ", from the {} lowest of {} shapes. Stress that is trapped by bending in other shapes is omitted",
                shapes, all)
          : "");
}

}  // namespace

bool wants_second_order(const formats::Part& part, const formats::Superelement& element) {
  if (!deforms(element)) return false;
  const bool fits = element.size() <= formats::max_companion_size;
  switch (part.second_order) {
    case formats::SecondOrder::no:
      return false;
    case formats::SecondOrder::yes:
      if (fits) return true;
      throw Error(
          fmt::format("second_order: the superelement has {} coordinates, but a companion file holds at most {}",
                      element.size(), formats::max_companion_size),
          part.file, "keep fewer nodes or modes, or write second_order: no");
    case formats::SecondOrder::unless_large:
      break;
  }
  return fits && (part.double_curvature > 0 || companion_bytes(element.size()) < large_file);
}

void describe_companion(const Mesh& mesh, const formats::Part& part, const formats::Superelement& element,
                        ModelCertificate& model) {
  if (!wants_second_order(part, element)) {
    if (!deforms(element) && part.second_order == formats::SecondOrder::yes)
      model.notes.push_back(
          "No companion file was written: with one boundary node and no modes the part cannot deform.");
    if (deforms(element) && part.second_order == formats::SecondOrder::unless_large)
      model.notes.push_back(
          fmt::format("No companion file (stiffening, exact inertia) was written, because it would hold {:.0f} MB. To "
                      "write it, set second_order: yes in the part file.",
                      1e-6 * companion_bytes(element.size())));
    return;
  }
  if (const std::vector<std::string> names = without_second_order(mesh); !names.empty())
    model.warnings.push_back(fmt::format(
        "The companion file omits the second order of {}, because their meaning for finite rotations is not known.",
        listed(names)));
  if (const std::vector<std::string> names = springs_that_do_not_turn(mesh); !names.empty())
    model.warnings.push_back(fmt::format(
        "The axes of {} do not turn with the part, because nothing defines a rotation of their nodes. At large motion "
        "the companion file is wrong there. Tie these nodes to a node with rotations by a rigid spider.",
        listed(names)));
  if (const std::string text = monosymmetry_note(mesh); !text.empty()) model.notes.push_back(text);
  if (mesh.shells.empty() || part.double_curvature > 0) return;
  double thickness = std::numeric_limits<double>::infinity();
  for (const ShellElement& shell : mesh.shells)
    thickness = std::min(thickness, mesh.shell_properties[shell.property].section.thickness);
  const std::string unit = unit_label(part.units, 1, 0, 0);
  model.notes.push_back(
      fmt::format("The second order of shells omits membrane stress that is trapped by bending into double curvature. "
                  "If a plate bends by its thickness ({:.3g}{}{}), its forces are 7 % (edges held in their plane) to "
                  "25 % too small. If it bends by twice its thickness, they are 11 to 58 % too small. To include this "
                  "stress, set `double_curvature: 20` in the part file, or cut such a plate into several parts.",
                  thickness, unit.empty() ? "" : " ", unit));
}

Eigen::VectorXd default_weights(const formats::Superelement& element) {
  std::vector<int> members;  // nodes with translations
  for (Index row = 0; row < element.size(); ++row)
    if (element.dof_node[row] >= 0 && element.dof_component[row] == 0) members.push_back(element.dof_node[row]);
  const Eigen::Matrix3Xd points = element.node_position(members, Eigen::all).transpose();
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(element.node_position.rows());
  weights(members) = formats::frame_weights(points, formats::rigid_properties(element).center_of_mass).alpha;
  return weights;
}

formats::Companion make_load_companion(const ReducedPart& part, const Eigen::VectorXd& weights) {
  formats::Companion c = companion_head(part.element, weights);
  c.load_cases = reduced_cases(part, load_vectors(part.mesh, part.system));
  sort_by_name(c.load_cases);
  return c;
}

formats::Companion make_companion(const ReducedPart& part, const Eigen::VectorXd& weights, int shapes,
                                  std::optional<SecondOrderDisplacement>* displacement) {
  const Mesh& mesh = part.mesh;
  const System& system = part.system;
  const int threads = core_count(), n = count_of(part.element);
  formats::Companion c = companion_head(part.element, weights);
  set_integrals(part.element, c);

  const MatrixXd Phi = expand(system.T, reduced_displacements(part));
  const FrameInertia inertia = frame_inertia(mesh, system.coordinates, Phi, c.reference_point, threads);
  c.C = inertia.forms.C;
  c.E = inertia.forms.E;
  if (inertia.turns) c.W = inertia.forms.W;

  const LoadVectors cases = load_vectors(mesh, system);
  c.load_cases = reduced_cases(part, cases);
  const TieForces ties = find_tie_forces(mesh, system, part.where);
  SecondOrderShapes inside;
  if (displacement != nullptr) inside = second_order_shapes(part, ties, Phi);
  const MatrixXd g = all_loads(mesh, cases, inertia.load, inside.load);
  const int all = n + static_cast<int>(g.cols());
  MatrixXd displacements(Phi.rows(), all);
  displacements << Phi, expand(system.T, residual_displacements(part, gather(system.T, g)));
  QuadraticForms forms(n, all, threads);
  ElementBatches(mesh, system.coordinates, displacements, n, threads)
      .for_each([&](std::span<const StrainBatch> batches) { forms.add(batches); }, part.share);
  if (!ties.empty()) {
    const MatrixXd residual = tie_residual(mesh, system.coordinates, ties, displacements, g);
    forms.add(tie_batches(mesh, system, ties, multipliers(ties, residual), Phi));
  }
  for (int j = 0; j < n; ++j) c.H.push_back(forms.matrix(j));
  formats::remove_rigid_stress(c, part.element, part.where);
  if (displacement != nullptr) {
    std::vector<MatrixXd> work;
    for (Index r = 0; r < inside.x.cols(); ++r)
      work.push_back(forms.matrix(n + inertial_loads + static_cast<int>(cases.x.cols() + r)));
    *displacement = second_order_displacement(std::move(inside), work, c.H, part.internal);
  }
  if (shapes > 0) c.Lambda = trapped_stress(part, ties, Phi, shapes);
  for (int a = 0; a < 6; ++a) {
    c.N[a] = inertia.forms.N[a] - forms.matrix(n + a);
    c.T[a] = inertia.forms.T[a] - forms.matrix(n + 6 + a);
  }
  for (int k = 0; k < std::ssize(c.load_cases); ++k)
    c.load_cases[k].stiffness = -forms.matrix(n + inertial_loads + k) +
                                weight_on_arms(mesh, system.coordinates, mesh.load_cases[k].gravity, Phi);
  sort_by_name(c.load_cases);
  return c;
}

std::optional<formats::Companion> companion_if_asked(const formats::Part& part, const ReducedPart& reduced,
                                                     ModelCertificate& model,
                                                     std::optional<SecondOrderDisplacement>* displacement) {
  const formats::Superelement& element = reduced.element;
  const bool wanted = wants_second_order(part, element), has_own_mass = reduced.internal.boundary_mass.size() > 0;
  const bool loose = reduced.internal.loose() > 0;  // no stress follows from the turns of a mechanism
  if (!loose && wanted && has_own_mass)
    model.notes.push_back(
        "No second order (stiffening, exact inertia) was written to a companion file, because method: macneal omits "
        "the mass that its coordinates move. Use method: craig_bampton or method: rubin.");
  else if (!loose)
    describe_companion(reduced.mesh, part, element, model);
  const bool second_order = wanted && !has_own_mass && !loose;
  if (!second_order && reduced.mesh.load_cases.empty()) return std::nullopt;
  const Eigen::VectorXd weights = default_weights(element);
  if (!second_order) return make_load_companion(reduced, weights);
  formats::Companion companion = make_companion(reduced, weights, part.double_curvature, displacement);
  if (displacement != nullptr && *displacement && (*displacement)->left_out > reported_omissions)
    model.notes.push_back(
        fmt::format("The {} shapes of second-order displacement in the recovery file omit {:.2g} % of it (root mean "
                    "square over mixed deformations).",
                    (*displacement)->forms.shapes(), 100.0 * (*displacement)->left_out));
  if (part.double_curvature > 0)
    model.notes.push_back(
        companion.Lambda.empty()
            ? std::string("No membrane stress is trapped by bending, so the companion file has no Lambda.")
            : trapped_text(companion, part.double_curvature));
  return companion;
}

}  // namespace tisserand::reducer
