// Forms of elements on the displacements of the reduced coordinates, block by block.
#include "reducer/second_order/inertia.hpp"

#include <algorithm>
#include <type_traits>
#include <vector>

#include "common/parallel.hpp"
#include "reducer/elements/each_element.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int block_elements = 64;
constexpr int linear_items = 9, items = 24;  ///< C and E; then N, T and W, of elements with six coordinates per node

/// What one element adds.
struct ElementInertia {
  ElementRows rows;
  TurningMass mass;
  bool turns = false;  ///< six coordinates per node: N, T and W are there
  Index first_row = 0;

  const MatrixXd& form(int item) const {
    if (item < 3) return mass.C[item];
    if (item < 9) return mass.E[item - 3];
    if (item < 15) return mass.N[item - 9];
    return item < 21 ? mass.T[item - 15] : mass.W[item - 21];
  }
};

MatrixXd& form_of(FrameInertia& sum, int item) {
  if (item < 3) return sum.C[item];
  if (item < 9) return sum.E[item - 3];
  if (item < 15) return sum.N[item - 9];
  return item < 21 ? sum.T[item - 15] : sum.W[item - 21];
}

/// Of elements whose mass moves alike in all directions.
void compute_alike(const MatrixXd& M, const MatrixXd& D, ElementInertia& out) {
  MatrixXd D_e(M.rows(), 6);
  gather(out.rows, D, D_e);
  turning_mass(M, D_e, out.mass);
  out.turns = false;
}

/// Elements first, then the masses of nodes. D: rigid motions about `reference`.
void compute_inertia(const Mesh& mesh, const Coordinates& coordinates, const MatrixXd& D,
                     const Eigen::Vector3d& reference, int item, ElementInertia& out) {
  if (item >= mesh.elements()) {
    const NodalMass& mass = mesh.masses[item - mesh.elements()];
    out.rows = {{coordinates.of(mass.node, 0)}, 1, coordinates.rotates(mass.node) ? 6 : 3};
    if (out.rows.size == 3) return compute_alike(nodal_mass_matrix(mass).topLeftCorner<3, 3>(), D, out);
    turning_mass(moving_mass(mesh, mass), reference, out.mass);
    out.turns = true;
    return;
  }
  with_element(mesh, item, [&](const auto& kind) {
    using Kind = std::decay_t<decltype(kind)>;
    if constexpr (std::is_same_v<Kind, BeamElement> || std::is_same_v<Kind, ShellElement>) {
      const MovingMass moving = moving_mass(mesh, kind);
      out.rows = element_rows(mesh, coordinates, item, moving.coordinates);
      turning_mass(moving, reference, out.mass);
      out.turns = true;
    } else {
      thread_local ElementMatrices matrices;
      element_matrices(mesh, kind, matrices);
      out.rows = element_rows(mesh, coordinates, item, matrices.M.rows());
      compute_alike(matrices.M, D, out);
    }
  });
}

/// Displacements of the elements of a block, one below the other.
struct InertiaBlock {
  std::vector<ElementInertia> elements = std::vector<ElementInertia>(block_elements);
  int count = 0;
  Index rows = 0;
  MatrixXd motion;
  std::vector<MatrixXd> product;  ///< of each thread
};

/// Adds the block to C, E, N, T or W; nothing where all elements have none of it.
void add_product(InertiaBlock& block, int item, MatrixXd& product, FrameInertia& sum) {
  bool any = false;
  for (int e = 0; e < block.count; ++e) {
    const ElementInertia& element = block.elements[e];
    auto rows = product.middleRows(element.first_row, static_cast<Index>(element.rows.nodes) * element.rows.size);
    if ((item >= linear_items && !element.turns) || element.form(item).isZero(0.0)) {
      rows.setZero();
      continue;
    }
    rows.noalias() = element.form(item) * block.motion.middleRows(element.first_row, rows.rows());
    any = true;
  }
  if (any) form_of(sum, item).noalias() += block.motion.topRows(block.rows).transpose() * product.topRows(block.rows);
}

void scatter_loads(const ElementInertia& element, MatrixXd& load) {
  for (int i = 0; i < element.rows.nodes; ++i)
    load.middleRows(element.rows.first[i], element.rows.size) +=
        element.mass.load.middleRows(static_cast<Index>(element.rows.size) * i, element.rows.size);
}

/// Rows of the block's elements, and their displacements.
void start_block(const MatrixXd& Phi, InertiaBlock& block) {
  block.rows = 0;
  for (int e = 0; e < block.count; ++e) {
    ElementInertia& element = block.elements[e];
    element.first_row = block.rows;
    block.rows += static_cast<Index>(element.rows.nodes) * element.rows.size;
  }
  if (block.motion.rows() < block.rows) {
    block.motion.resize(block.rows, Phi.cols());
    for (MatrixXd& product : block.product) product.resize(block.rows, Phi.cols());
  }
}

void finish(FrameInertia& sum) {
  for (auto* forms : {&sum.E, &sum.N, &sum.T})
    for (MatrixXd& form : *forms) form = (0.5 * (form + form.transpose())).eval();
  for (MatrixXd& W : sum.W) {
    W = (0.5 * (W - W.transpose())).eval();
    sum.turns = sum.turns || !W.isZero(0.0);
  }
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

FrameInertia frame_inertia(const Mesh& mesh, const Coordinates& coordinates, const MatrixXd& Phi,
                           const Eigen::Vector3d& reference, int threads) {
  const Index n = Phi.cols();
  FrameInertia sum;
  for (int item = 0; item < items; ++item) form_of(sum, item).setZero(n, n);
  sum.load.setZero(Phi.rows(), inertial_loads);
  const MatrixXd D = rigid_motions(mesh, coordinates, reference);
  const int all = mesh.elements() + static_cast<int>(mesh.masses.size());
  InertiaBlock block;
  block.product.resize(static_cast<std::size_t>(threads));
  for (int first = 0; first < all; first += block_elements) {
    block.count = std::min(block_elements, all - first);
    on_threads(threads, [&](int t) {
      const Share share = share_of(block.count, t, threads);
      for (int e = share.first; e < share.end; ++e)
        compute_inertia(mesh, coordinates, D, reference, first + e, block.elements[e]);
    });
    start_block(Phi, block);
    on_threads(threads, [&](int t) {
      const Share share = share_of(block.count, t, threads);
      for (int e = share.first; e < share.end; ++e) {
        const ElementInertia& element = block.elements[e];
        gather(element.rows, Phi,
               block.motion.middleRows(element.first_row, static_cast<Index>(element.rows.nodes) * element.rows.size));
      }
    });
    for (int e = 0; e < block.count; ++e) scatter_loads(block.elements[e], sum.load);
    on_threads(threads, [&](int t) {
      for (int item = t; item < items; item += threads) add_product(block, item, block.product[t], sum);
    });
  }
  finish(sum);
  return sum;
}

MatrixXd translation_loads(const Mesh& mesh, const Coordinates& coordinates) {
  const MatrixXd D = rigid_motions(mesh, coordinates, Eigen::Vector3d::Zero()).leftCols<3>();
  MatrixXd load = MatrixXd::Zero(D.rows(), 3);
  ElementMatrices matrices;
  const auto add = [&](const MatrixXd& M, const ElementRows& rows) {
    MatrixXd D_e(M.rows(), 3);
    gather(rows, D, D_e);
    const MatrixXd of_element = M * D_e;
    for (int i = 0; i < rows.nodes; ++i)
      load.middleRows(rows.first[i], rows.size) += of_element.middleRows(static_cast<Index>(rows.size) * i, rows.size);
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
