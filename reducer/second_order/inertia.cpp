// SPDX-License-Identifier: GPL-3.0-or-later
// Forms of elements for the displacements of the reduced coordinates, block by block.
#include "reducer/second_order/inertia.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/parallel.hpp"
#include "reducer/elements/each_element.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int block_elements = 128;

/// Contribution of one element, and the first rows of its translations, turns and pivots in the block.
struct ElementInertia {
  ElementRows rows;
  TurningMass mass;
  Index masses = 0, turn = 0, pivot = 0;
  MatrixXd motion;

  Index coordinates() const { return static_cast<Index>(rows.nodes) * rows.size; }
};

/// A part in rotation about a point.
struct TurningPart {
  const Mesh& mesh;
  const Coordinates& coordinates;
  const Eigen::Vector3d& point;
  MatrixXd D = rigid_motions(mesh, coordinates, point);
};

/// Inertia of an element with equal mass in all directions.
void compute_alike(const MatrixXd& M, const TurningPart& part, ElementInertia& out) {
  MatrixXd D_e(M.rows(), 6);
  gather(out.rows, part.D, D_e);
  turning_mass(M, D_e, out.mass);
}

/// Inertia of an item; elements come first, then the masses of nodes.
void compute_inertia(const TurningPart& part, int item, ElementInertia& out) {
  const Mesh& mesh = part.mesh;
  const Coordinates& coordinates = part.coordinates;
  if (item >= mesh.elements()) {
    const NodalMass& mass = mesh.masses[item - mesh.elements()];
    out.rows = {{coordinates.of(mass.node, 0)}, 1, coordinates.rotates(mass.node) ? 6 : 3};
    if (out.rows.size == 3) return compute_alike(nodal_mass_matrix(mass).topLeftCorner<3, 3>(), part, out);
    return turning_mass(moving_mass(mesh, mass), part.point, out.mass);
  }
  with_element(mesh, item, [&](const auto& kind) {
    using Kind = std::decay_t<decltype(kind)>;
    if constexpr (std::is_same_v<Kind, BeamElement> || std::is_same_v<Kind, ShellElement>) {
      const MovingMass moving = moving_mass(mesh, kind);
      out.rows = element_rows(mesh, coordinates, item, moving.coordinates);
      turning_mass(moving, part.point, out.mass);
    } else {
      thread_local ElementMatrices matrices;
      element_matrices(mesh, kind, matrices);
      out.rows = element_rows(mesh, coordinates, item, matrices.M.rows());
      compute_alike(matrices.M, part, out);
    }
  });
}

/// Rows of all elements of a block, multiplied by Φ.
struct InertiaBlock {
  std::vector<ElementInertia> elements = std::vector<ElementInertia>(block_elements);
  int count = 0;
  Index masses = 0, turns = 0, pivots = 0;
  std::array<MatrixXd, 3> translation, momentum;
  MatrixXd turn, rotation;
  std::array<MatrixXd, inertial_loads> turned;
  std::vector<MatrixXd> product;  ///< one per thread: forms of pivots times their rotations
};

void grow(Index rows, Index columns, MatrixXd& matrix) {
  if (matrix.rows() < rows) matrix.resize(rows, columns);
}

/// Assigns places to the elements' rows and allocates them.
void start_block(Index n, InertiaBlock& block) {
  block.masses = block.turns = block.pivots = 0;
  for (int e = 0; e < block.count; ++e) {
    ElementInertia& element = block.elements[e];
    element.masses = block.masses;
    element.turn = block.turns;
    element.pivot = block.pivots;
    block.masses += element.mass.translation.rows() / 3;
    block.turns += element.mass.turn.cols() > 0 ? 3 : 0;
    block.pivots += 3 * static_cast<Index>(element.mass.pivots.size());
  }
  for (auto* sets : {&block.translation, &block.momentum})
    for (MatrixXd& matrix : *sets) grow(block.masses, n, matrix);
  grow(block.turns, n, block.turn);
  for (MatrixXd& matrix : block.turned) grow(block.turns, n, matrix);
  grow(block.pivots, n, block.rotation);
  for (MatrixXd& matrix : block.product) grow(block.pivots, n, matrix);
}

/// Computes the rows of one element.
void fill(const MatrixXd& Phi, ElementInertia& element, InertiaBlock& block) {
  const TurningMass& mass = element.mass;
  element.motion.resize(element.coordinates(), Phi.cols());
  gather(element.rows, Phi, element.motion);
  const Index masses = mass.translation.rows() / 3;
  for (int a = 0; a < 3; ++a) {
    block.translation[a].middleRows(element.masses, masses).noalias() =
        mass.translation.middleRows(a * masses, masses) * element.motion;
    block.momentum[a].middleRows(element.masses, masses).noalias() =
        mass.momentum.middleRows(a * masses, masses) * element.motion;
  }
  if (mass.turn.cols() > 0) {
    block.turn.middleRows<3>(element.turn).noalias() = mass.turn * element.motion;
    for (int l = 0; l < inertial_loads; ++l)
      block.turned[l].middleRows<3>(element.turn).noalias() = mass.turned.middleRows<3>(3 * l) * element.motion;
  }
  for (std::size_t p = 0; p < mass.pivots.size(); ++p)
    block.rotation.middleRows<3>(element.pivot + 3 * static_cast<Index>(p)).noalias() =
        mass.pivots[p].rotation * element.motion;
}

/// Sums over all blocks: products of translations, of turns with each load, forms of pivots.
struct Sums {
  explicit Sums(Index n) : pivots(n) {
    for (MatrixXd& matrix : translations) matrix.setZero(n, n);
    for (MatrixXd& matrix : turned) matrix.setZero(n, n);
  }
  static constexpr int items = 6 + inertial_loads + TurningPivot::items;
  std::array<MatrixXd, 6> translations;
  std::array<MatrixXd, inertial_loads> turned;
  TurningForms pivots;
};

/// Adds form `item` of the pivots of the block, if any pivot has it.
void add_pivots(const InertiaBlock& block, int item, MatrixXd& product, Sums& sums) {
  bool any = false;
  for (int e = 0; e < block.count; ++e) {
    const ElementInertia& element = block.elements[e];
    for (std::size_t p = 0; p < element.mass.pivots.size(); ++p) {
      const TurningPivot& pivot = element.mass.pivots[p];
      const Index row = element.pivot + 3 * static_cast<Index>(p);
      const bool present = (pivot.present >> static_cast<unsigned>(item) & 1U) != 0;
      any = any || present;
      if (present)
        product.middleRows<3>(row).noalias() = pivot.form[item] * block.rotation.middleRows<3>(row);
      else
        product.middleRows<3>(row).setZero();
    }
  }
  if (any)
    sums.pivots.of(item).noalias() += block.rotation.topRows(block.pivots).transpose() * product.topRows(block.pivots);
}

void add_item(const InertiaBlock& block, int item, MatrixXd& product, Sums& sums) {
  constexpr std::array<std::pair<int, int>, 6> pairs{{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
  if (item < 6) {
    const auto [a, b] = pairs[item];
    sums.translations[item].noalias() +=
        block.translation[a].topRows(block.masses).transpose() * block.momentum[b].topRows(block.masses);
  } else if (item < 6 + inertial_loads) {
    if (block.turns > 0)
      sums.turned[item - 6].noalias() +=
          block.turn.topRows(block.turns).transpose() * block.turned[item - 6].topRows(block.turns);
  } else if (block.pivots > 0) {
    add_pivots(block, item - 6 - inertial_loads, product, sums);
  }
}

FrameInertia finish(Sums& sums) {
  TurningForms& forms = sums.pivots;
  add_translations(sums.translations, forms);
  for (int l = 0; l < inertial_loads; ++l)
    forms.of(TurningPivot::work + l) += sums.turned[l] + sums.turned[l].transpose();
  for (auto* symmetric : {&forms.E, &forms.N, &forms.T})
    for (MatrixXd& form : *symmetric) form = (0.5 * (form + form.transpose())).eval();
  FrameInertia out{std::move(forms), false, {}};
  for (MatrixXd& W : out.forms.W) {
    W = (0.5 * (W - W.transpose())).eval();
    out.turns = out.turns || !W.isZero(0.0);
  }
  return out;
}

}  // namespace

ElementRows element_rows(const Mesh& mesh, const Coordinates& coordinates, int element, Index size) {
  const ElementNodes nodes = element_nodes(mesh, element);
  ElementRows rows;
  rows.nodes = nodes.count;
  rows.size = static_cast<int>(size) / nodes.count;
  for (int i = 0; i < nodes.count; ++i) rows.first[i] = coordinates.of(nodes.node[i], 0);
  return rows;
}

void gather(const ElementRows& rows, const MatrixXd& all, Eigen::Ref<MatrixXd> out) {
  for (int i = 0; i < rows.nodes; ++i)
    out.middleRows(rows.size * i, rows.size) = all.middleRows(rows.first[i], rows.size);
}

void scatter(const ElementRows& rows, const MatrixXd& of_element, MatrixXd& all) {
  for (int i = 0; i < rows.nodes; ++i)
    all.middleRows(rows.first[i], rows.size) += of_element.middleRows(rows.size * i, rows.size);
}

FrameInertia frame_inertia(const Mesh& mesh, const Coordinates& coordinates, const MatrixXd& Phi,
                           const Eigen::Vector3d& reference, int threads) {
  const Index n = Phi.cols();
  Sums sums(n);
  MatrixXd load = MatrixXd::Zero(Phi.rows(), inertial_loads);
  const TurningPart part{mesh, coordinates, reference};
  const int all = mesh.elements() + count_of(mesh.masses);
  InertiaBlock block;
  block.product.resize(static_cast<std::size_t>(threads));
  for (int first = 0; first < all; first += block_elements) {
    block.count = std::min(block_elements, all - first);
    share_out(block.count, threads,
              [&](int /*thread*/, int e) { compute_inertia(part, first + e, block.elements[e]); });
    start_block(n, block);
    share_out(block.count, threads, [&](int /*thread*/, int e) { fill(Phi, block.elements[e], block); });
    for (int e = 0; e < block.count; ++e) scatter(block.elements[e].rows, block.elements[e].mass.load, load);
    on_threads(threads, [&](int t) {
      for (int item = t; item < Sums::items; item += threads) add_item(block, item, block.product[t], sums);
    });
  }
  FrameInertia inertia = finish(sums);
  inertia.load = std::move(load);
  return inertia;
}

MatrixXd translation_loads(const Mesh& mesh, const Coordinates& coordinates) {
  const MatrixXd D = rigid_motions(mesh, coordinates, Eigen::Vector3d::Zero()).leftCols<3>();
  MatrixXd load = MatrixXd::Zero(D.rows(), 3);
  ElementMatrices matrices;
  const auto add = [&](const MatrixXd& M, const ElementRows& rows) {
    MatrixXd D_e(M.rows(), 3);
    gather(rows, D, D_e);
    scatter(rows, M * D_e, load);
  };
  for (int e = 0; e < mesh.elements(); ++e) {
    with_element(mesh, e, [&](const auto& kind) { element_matrices(mesh, kind, matrices); });
    add(matrices.M, element_rows(mesh, coordinates, e, matrices.M.rows()));
  }
  for (const NodalMass& mass : mesh.masses) {
    const int size = coordinates.rotates(mass.node) ? 6 : 3;
    add(nodal_mass_matrix(mass).topLeftCorner(size, size), {{coordinates.of(mass.node, 0)}, 1, size});
  }
  return load;
}

}  // namespace tisserand::reducer
