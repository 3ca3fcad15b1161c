// SPDX-License-Identifier: GPL-3.0-or-later
// Superelement from imported matrices: axes, names, checks, canonical form and rigid-motion filter.
#include "reducer/exchange/to_superelement.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/program/version.hpp"
#include "formats/superelement/canonical.hpp"
#include "formats/superelement/rigid_strain.hpp"

namespace tisserand::reducer::exchange {
namespace {

constexpr double rigid_residual_kept = 1e-12;  ///< round-off in double precision

/// Rows of the matrices in the order of the superelement: boundary first.
struct Order {
  std::vector<Eigen::Index> row;
  Eigen::Index boundary = 0;
  std::vector<long> nodes;  ///< in order of appearance
};

Order order_rows(const ReducedMatrices& matrices) {
  Order order;
  for (const bool internal : {false, true}) {
    for (std::size_t i = 0; i < matrices.rows.size(); ++i) {
      const RowKey& key = matrices.rows[i];
      if (is_internal(matrices, key) != internal) continue;
      order.row.push_back(static_cast<Eigen::Index>(i));
      if (!internal && std::find(order.nodes.begin(), order.nodes.end(), key.node) == order.nodes.end())
        order.nodes.push_back(key.node);
    }
    if (!internal) order.boundary = static_cast<Eigen::Index>(order.row.size());
  }
  if (order.nodes.empty())
    throw Error("no row belongs to a node with a position", matrices.source,
                "a superelement needs boundary nodes; check the positions and the list of modal nodes");
  return order;
}

void require_places(const ReducedMatrices& matrices, const Order& order) {
  std::vector<Error> errors;
  std::size_t missing = 0;
  for (const long node : order.nodes)
    if (!matrices.places.contains(node) && ++missing <= 20)
      errors.emplace_back(fmt::format("node {} has no position", node), matrices.source,
                          "give its position with --positions FILE, or name it with --modal if it carries a mode");
  if (missing > 20)
    errors.emplace_back(fmt::format("{} more nodes have no position", missing - 20), matrices.source,
                        "give positions with --positions FILE");
  if (!errors.empty()) throw merge_errors(errors);
}

enum class Turned { values, bounds };

/// Turns components of nodes with axes of their own into the part frame: A <- T A Tᵀ; with |T| for bounds of entries.
void turn_axes(const ReducedMatrices& matrices, const Order& order, Turned turned, Eigen::MatrixXd& A) {
  std::map<std::pair<long, int>, std::array<Eigen::Index, 3>> triples;  // node and 0 (translations) or 1 (rotations)
  for (Eigen::Index i = 0; i < order.boundary; ++i) {
    const RowKey& key = matrices.rows[order.row[i]];
    auto [found, is_new] = triples.try_emplace({key.node, key.component / 3}, std::array<Eigen::Index, 3>{-1, -1, -1});
    found->second[key.component % 3] = i;
  }
  for (const auto& [key, triple] : triples) {
    Eigen::Matrix3d axes = matrices.places.at(key.first).axes;
    if (axes == Eigen::Matrix3d::Identity()) continue;
    if (std::find(triple.begin(), triple.end(), -1) != triple.end())
      throw Error(fmt::format("node {} has its own axes, but not all three {}", key.first,
                              key.second == 0 ? "translations" : "rotations"),
                  matrices.source, "keep x, y and z of the node");
    if (turned == Turned::bounds) axes = axes.cwiseAbs().eval();
    const Eigen::MatrixXd rows = axes * A(triple, Eigen::all);
    A(triple, Eigen::all) = rows;
    const Eigen::MatrixXd columns = A(Eigen::all, triple) * axes.transpose();
    A(Eigen::all, triple) = columns;
  }
}

std::string name_of(const ReducedMatrices& matrices, const ImportOptions& options, long node) {
  if (const auto wish = options.node_names.find(node); wish != options.node_names.end()) return wish->second;
  const std::string& name = matrices.places.at(node).name;
  return name.empty() ? fmt::format("n{}", node) : name;
}

void require_named_nodes(const ReducedMatrices& matrices, const ImportOptions& options, const Order& order) {
  for (const auto& [node, name] : options.node_names)
    if (std::find(order.nodes.begin(), order.nodes.end(), node) == order.nodes.end())
      throw Error(fmt::format("node {}, for which --names gives the name '{}', has no row in the matrix", node, name),
                  matrices.source, "correct the number in --names");
}

formats::Superelement describe(const ReducedMatrices& matrices, const ImportOptions& options, const Order& order) {
  formats::Superelement element;
  element.name = options.name;
  element.method = fmt::format("imported ({})", matrices.format);
  element.producer = producer("reducer");
  element.units = options.units;
  element.node_position.resize(static_cast<Eigen::Index>(order.nodes.size()), 3);
  std::map<long, int> node_row;
  for (int b = 0; b < std::ssize(order.nodes); ++b) {
    element.node_name.push_back(name_of(matrices, options, order.nodes[b]));
    element.node_position.row(b) = matrices.places.at(order.nodes[b]).position.transpose();
    node_row.emplace(order.nodes[b], b);
  }
  for (int i = 0; i < std::ssize(order.row); ++i) {
    const RowKey& key = matrices.rows[order.row[i]];
    const bool boundary = i < order.boundary;
    element.dof_node.push_back(boundary ? node_row.at(key.node) : -1);
    element.dof_component.push_back(boundary ? key.component : i - static_cast<int>(order.boundary));
  }
  element.stiffness = matrices.stiffness(order.row, order.row);
  element.mass = matrices.mass(order.row, order.row);
  for (Eigen::MatrixXd* A : {&element.stiffness, &element.mass}) {
    turn_axes(matrices, order, Turned::values, *A);
    *A = (0.5 * (*A + A->transpose())).eval();
  }
  return element;
}

/// Rounding errors of the entries of S in the file, in the order and axes of the superelement.
formats::EntryErrors rounding_errors(const ReducedMatrices& matrices, const Order& order) {
  formats::EntryErrors errors = formats::entry_errors(matrices.stiffness);
  if (errors.bound.size() == 0) return errors;
  errors.bound = errors.bound(order.row, order.row).eval();
  turn_axes(matrices, order, Turned::bounds, errors.bound);
  return errors;
}

bool is_canonical(const formats::Superelement& e, Eigen::Index nb) {
  const Eigen::Index m = e.size() - nb;
  const Eigen::MatrixXd S_II = e.stiffness.bottomRightCorner(m, m);
  const Eigen::VectorXd lambda = S_II.diagonal();
  return (e.stiffness.topRightCorner(nb, m).array() == 0.0).all() && S_II == Eigen::MatrixXd(lambda.asDiagonal()) &&
         std::is_sorted(lambda.begin(), lambda.end()) &&
         e.mass.bottomRightCorner(m, m) == Eigen::MatrixXd::Identity(m, m);
}

/// Largest entry of `part` relative to the largest of `whole`.
double share(const Eigen::MatrixXd& part, const Eigen::MatrixXd& whole) {
  return part.size() == 0 ? 0.0 : part.cwiseAbs().maxCoeff() / std::max(whole.cwiseAbs().maxCoeff(), 1e-300);
}

void make_canonical(formats::Superelement& e, Eigen::Index nb, const std::string& where, ImportCertificate& c) {
  const formats::CanonicalMatrices form = formats::canonical_form({e.stiffness, e.mass, nb}, where);
  const Eigen::Index m = form.S_II.size(), n = nb + m;
  if (m > 0 && !(form.S_II[0] > 0.0))
    throw Error("an internal coordinate has no stiffness", where,
                "a motion of internal coordinates must cause strain; write the file with fixed-boundary modes");
  c.massless_dropped = static_cast<int>(form.massless);
  e.dof_node.resize(static_cast<std::size_t>(n));
  e.dof_component.resize(static_cast<std::size_t>(n));
  e.stiffness.setZero(n, n);
  e.mass.setIdentity(n, n);
  e.stiffness.topLeftCorner(nb, nb) = form.S_BB;
  e.stiffness.diagonal().tail(m) = form.S_II;
  e.mass.topLeftCorner(nb, nb) = form.M_BB;
  e.mass.topRightCorner(nb, m) = form.M_BI;
  e.mass.bottomLeftCorner(m, nb) = form.M_BI.transpose();
}

/// Filters the boundary block only: in canonical form the internal coordinates are zero in rigid motions.
void filter(formats::Superelement& e, Eigen::Index nb) {
  const Eigen::Index m = e.size() - nb;
  const Eigen::VectorXd lambda = e.stiffness.diagonal().tail(m);
  formats::filter_rigid_motions(e);
  e.stiffness.topRightCorner(nb, m).setZero();
  e.stiffness.bottomLeftCorner(m, nb).setZero();
  e.stiffness.bottomRightCorner(m, m) = lambda.asDiagonal();
}

}  // namespace

Imported to_superelement(const ReducedMatrices& matrices, const ImportOptions& options) {
  const Order order = order_rows(matrices);
  require_places(matrices, order);
  require_named_nodes(matrices, options, order);
  Imported result;
  formats::Superelement& e = result.element;
  ImportCertificate& c = result.certificate;
  e = describe(matrices, options, order);
  c.format = matrices.format;
  c.source = matrices.source;
  c.stiffness_asymmetry = matrices.stiffness_asymmetry;
  c.mass_asymmetry = matrices.mass_asymmetry;
  const formats::SuperelementReport found = formats::check(e, matrices.source, rounding_errors(matrices, order));
  c.rigid_residual = found.rigid_residual;
  const Eigen::Index nb = order.boundary, m = e.size() - nb;
  c.stiffness_coupling = share(e.stiffness.topRightCorner(nb, m), e.stiffness);
  c.canonical = is_canonical(e, nb);
  // Also filtered before the canonical form, which hides how far the file had rounded its entries.
  c.filtered = found.rigid_residual > rigid_residual_kept;
  if (!c.canonical && c.filtered) formats::filter_rigid_motions(e);
  if (!c.canonical) make_canonical(e, nb, matrices.source, c);
  c.filtered = c.filtered || formats::check(e, matrices.source).rigid_residual > rigid_residual_kept;
  if (c.filtered) filter(e, nb);
  result.report = formats::check(e, matrices.source);
  if (formats::needs_filter(found)) result.report.warnings.push_back(formats::filter_note(found, matrices.source));
  e.content_id = formats::content_id(e);
  return result;
}

}  // namespace tisserand::reducer::exchange
