// Masses of elements on displacements and on their cross products, block by block.
#include "reducer/second_order/inertia.hpp"

#include <algorithm>

#include "common/math/rotation.hpp"
#include "common/parallel.hpp"
#include "formats/companion/companion.hpp"
#include "reducer/elements/each_element.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int block_elements = 128;

/// Displacements, their cross products, and masses times each, of the elements of a block one below the other.
struct InertiaBlock {
  std::array<MatrixXd, 4> motion;    ///< Φ, [e_k x] Φ
  std::array<MatrixXd, 4> momentum;  ///< M of the element times each
};

/// What one element adds, and its M D.
struct ElementInertia {
  ElementRows rows;
  MatrixXd M;
  MatrixXd MD;
  Index first_row = 0;
};

/// Elements first, then the masses of nodes.
void compute_mass(const Mesh& mesh, const Coordinates& coordinates, int item, ElementInertia& out) {
  if (item < mesh.elements()) {
    thread_local ElementMatrices matrices;
    with_element(mesh, item, [&](const auto& kind) { element_matrices(mesh, kind, matrices); });
    out.M = matrices.M;
    out.rows = element_rows(mesh, coordinates, item, out.M.rows());
    return;
  }
  const NodalMass& mass = mesh.masses[item - mesh.elements()];
  const int size = coordinates.rotates(mass.node) ? 6 : 3;
  out.M = nodal_mass_matrix(mass).topLeftCorner(size, size);
  out.rows = {{coordinates.of(mass.node, 0)}, 1, size};
}

void multiply_element(const MatrixXd& Phi, const MatrixXd& D, ElementInertia& element, InertiaBlock& block) {
  const Index n = element.M.rows();
  auto motion = block.motion[0].middleRows(element.first_row, n);
  gather(element.rows, Phi, motion);
  block.momentum[0].middleRows(element.first_row, n).noalias() = element.M * motion;
  for (int k = 0; k < 3; ++k) {
    block.motion[k + 1].middleRows(element.first_row, n) = crossed(k, motion);
    block.momentum[k + 1].middleRows(element.first_row, n).noalias() =
        element.M * block.motion[k + 1].middleRows(element.first_row, n);
  }
  MatrixXd D_e(n, 6);
  gather(element.rows, D, D_e);
  element.MD.noalias() = element.M * D_e;
}

void scatter_momentum(const ElementInertia& element, MatrixXd& MD) {
  for (int i = 0; i < element.rows.nodes; ++i)
    MD.middleRows(element.rows.first[i], element.rows.size) +=
        element.MD.middleRows(element.rows.size * i, element.rows.size);
}

/// Adds the block's rows to C (items 0-2) or E (3-8).
void add_product(const InertiaBlock& block, Index rows, int item, FrameInertia& sum) {
  if (item < 3) {
    sum.C[item].noalias() += block.momentum[0].topRows(rows).transpose() * block.motion[item + 1].topRows(rows);
    return;
  }
  const auto [j, k] = formats::axis_pairs[item - 3];
  sum.E[item - 3].noalias() += block.motion[j + 1].topRows(rows).transpose() * block.momentum[k + 1].topRows(rows);
}

}  // namespace

MatrixXd crossed(int k, const MatrixXd& rows) {
  MatrixXd result(rows.rows(), rows.cols());
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  for (Index first = 0; first + 2 < rows.rows(); first += 3) {
    result.row(first + k).setZero();
    result.row(first + i) = -rows.row(first + j);
    result.row(first + j) = rows.row(first + i);
  }
  return result;
}

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

FrameInertia frame_inertia(const Mesh& mesh, const Coordinates& coordinates, const MatrixXd& Phi, const MatrixXd& D,
                           int threads) {
  const Index n = Phi.cols();
  FrameInertia sum;
  for (MatrixXd& C : sum.C) C.setZero(n, n);
  for (MatrixXd& E : sum.E) E.setZero(n, n);
  sum.MD.setZero(Phi.rows(), 6);
  const int items = mesh.elements() + static_cast<int>(mesh.masses.size());
  InertiaBlock block;
  std::vector<ElementInertia> elements(block_elements);
  for (int first = 0; first < items; first += block_elements) {
    const int count = std::min(block_elements, items - first);
    on_threads(threads, [&](int t) {
      const Share share = share_of(count, t, threads);
      for (int e = share.first; e < share.end; ++e) compute_mass(mesh, coordinates, first + e, elements[e]);
    });
    Index rows = 0;
    for (int e = 0; e < count; ++e) {
      elements[e].first_row = rows;
      rows += elements[e].M.rows();
    }
    for (auto* products : {&block.motion, &block.momentum})
      for (MatrixXd& product : *products)
        if (product.rows() < rows) product.resize(rows, n);
    on_threads(threads, [&](int t) {
      const Share share = share_of(count, t, threads);
      for (int e = share.first; e < share.end; ++e) multiply_element(Phi, D, elements[e], block);
    });
    for (int e = 0; e < count; ++e) scatter_momentum(elements[e], sum.MD);
    on_threads(threads, [&](int t) {
      for (int item = t; item < 9; item += threads) add_product(block, rows, item, sum);
    });
  }
  for (MatrixXd& E : sum.E) E = (0.5 * (E + E.transpose())).eval();
  return sum;
}

}  // namespace tisserand::reducer
