// SPDX-License-Identifier: GPL-3.0-or-later
// Held coordinates, matrices of the free ones, lowest vibration.
#include "mechanism/doubts/held_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace tisserand::mechanism {
namespace {

constexpr int most_coordinates = 80;

/// Number of rigid motions that the held coordinates leave free: rank Φ − rank Φ_held.
Eigen::Index rigid_motions(const SuperelementBody& body, const std::vector<bool>& held) {
  constexpr double independent = 1e-6;  // files give positions with six digits
  const auto rank = [&](const Eigen::MatrixXd& A) -> Eigen::Index {
    if (A.rows() == 0) return 0;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
    qr.setThreshold(independent);
    return qr.compute(A).rank();
  };
  const Eigen::MatrixXd Phi = coordinate_units(body).cwiseInverse().asDiagonal() * rigid_columns(body);
  std::vector<int> rows;
  for (int k = 0; k < std::ssize(held); ++k)
    if (held[k]) rows.push_back(k);
  return rank(Phi) - rank(Phi(rows, Eigen::all));
}

}  // namespace

std::vector<std::vector<bool>> held_coordinates(const Model& model) {
  std::vector<int> users(model.nodes.size(), 0);
  const auto attach = [&users](const Marker& marker) {
    if (marker.node >= 0) users[marker.node] = 2;
  };
  for (const Joint& joint : model.joints) {
    attach(joint.a);
    attach(joint.b);
  }
  for (const SuperelementUse& use : model.superelements)
    for (const int node : use.nodes) ++users[node];
  std::vector<std::vector<bool>> held;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    std::vector<bool> one(body.boundary_size + body.modes, false);
    const auto& nodes = model.superelements[i].nodes;
    const auto attached = std::ranges::count_if(nodes, [&](int node) { return users[node] > 1; });
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (users[nodes[j]] < 2) continue;
      const SuperelementNode& node = body.node[j];
      for (int k = 0; k < body.translations() && node.has_translation(); ++k) one[node.translation_row + k] = true;
      for (int k = 0; k < body.rotations() && node.has_rotation() && attached == 1; ++k)
        one[node.rotation_row + k] = true;
    }
    held.push_back(std::move(one));
  }
  return held;
}

std::vector<int> welded_beams(const Model& model) {
  std::vector<int> owner(model.nodes.size(), -1), beam(model.superelements.size());
  const auto weld = [&](int a, int b) {
    if (a < 0 || b < 0) return;
    const int from = beam[a], to = beam[b];
    std::ranges::replace(beam, from, to);
  };
  for (int i = 0; i < std::ssize(beam); ++i) {
    beam[i] = i;
    for (const int node : model.superelements[i].nodes) {
      weld(owner[node], i);
      owner[node] = i;
    }
  }
  for (const Joint& joint : model.joints)
    if (joint.kind == JointKind::fixed && joint.a.node >= 0 && joint.b.node >= 0)
      weld(owner[joint.a.node], owner[joint.b.node]);
  return beam;
}

FreePart free_part(const SuperelementBody& body, const std::vector<bool>& held) {
  const int nb = body.boundary_size;
  FreePart part;
  for (int k = 0; k < nb + body.modes; ++k)
    if (!held[k]) part.free.push_back(k);
  if (part.free.size() > most_coordinates) return {};
  const int n = count_of(part.free);
  part.unit = coordinate_units(body)(part.free);
  part.S.resize(n, n);
  part.M.resize(n, n);
  for (int b = 0; b < n; ++b)
    for (int a = 0; a < n; ++a) {
      const int i = part.free[a], j = part.free[b];
      const double scale = part.unit[a] * part.unit[b];
      const bool inner = i >= nb && j >= nb, outer = i < nb && j < nb;
      part.S(a, b) = scale * (outer ? body.S_BB(i, j) : i == j ? body.S_II[i - nb] : 0.0);
      part.M(a, b) = scale * (outer    ? body.M_BB(i, j)
                              : inner  ? (i == j ? 1.0 : 0.0)
                              : i < nb ? body.M_BI(i, j - nb)
                                       : body.M_IB(i - nb, j));
    }
  return part;
}

const char* letter(formats::InertiaOption option) {
  static constexpr const char* letters[] = {"A", "B", "M", "F"};
  return letters[static_cast<int>(option)];
}

HeldMode first_mode(const SuperelementBody& body, const std::vector<bool>& held, double from) {
  FreePart part = free_part(body, held);
  Eigen::MatrixXd& M = part.M;
  const Eigen::Index n = M.rows();
  if (n == 0) return {};
  // M x = μ (S + from² M) x, ω² = 1/μ − from². Remaining rigid motions have the largest μ. They are counted, because
  // round-off gives them a frequency that no limit separates from that of a soft body.
  const double shift = from * from;
  const Eigen::LLT<Eigen::MatrixXd> factor(part.S + shift * M);
  if (factor.info() != Eigen::Success) return {};
  factor.matrixL().solveInPlace(M);
  M = factor.matrixL().solve(M.transpose()).eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(M);
  for (Eigen::Index k = n - 1 - rigid_motions(body, held); k >= 0; --k) {
    const double mu = eigen.eigenvalues()[k];
    if (!(mu > 0.0)) return {};
    const double square = 1.0 / mu - shift;
    if (!(square > 1e-6 * shift)) continue;
    const Eigen::VectorXd z = eigen.eigenvectors().col(k) / std::sqrt(mu);
    const Eigen::VectorXd shape = factor.matrixU().solve(z);
    HeldMode mode{std::sqrt(square), Eigen::VectorXd::Zero(body.boundary_size + body.modes)};
    for (Eigen::Index a = 0; a < n; ++a) mode.shape[part.free[a]] = part.unit[a] * shape[a];
    return mode;
  }
  return {};
}

}  // namespace tisserand::mechanism
