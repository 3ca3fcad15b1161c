// SPDX-License-Identifier: GPL-3.0-or-later
// check(): all rules of MODAL_BODY.md for the contents of a modal body, in the order of that page.
#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "common/math/count.hpp"
#include "common/math/rotation.hpp"
#include "common/text.hpp"
#include "formats/hdf5/head.hpp"
#include "formats/modal_body/arrays.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double integral_tolerance = 1e-10;  // sums over the nodes, relative to the largest term of their kind
constexpr double reference_tolerance = 1e-8;  // reference conditions: accuracy of an eigenvalue solver
constexpr double normal_tolerance = 1e-9;     // XᵀM X = 1
constexpr double singular_tolerance = 1e-8;   // matrix of the reference conditions
constexpr double largest_value = 1e100;

struct FilePlace {
  const std::string& file;
  [[noreturn]] void fail(const std::string& dataset, const std::string& what, const std::string& remedy) const {
    throw Error(what, file.empty() ? dataset : file + ": " + dataset, remedy);
  }
};

Eigen::Map<const Matrix3d> block(const double* blocks, Index j) { return Eigen::Map<const Matrix3d>(blocks + 9 * j); }

Vector3d vee(const Matrix3d& P) { return {P(1, 2) - P(2, 1), P(2, 0) - P(0, 2), P(0, 1) - P(1, 0)}; }

/// Largest distance of a node from the origin of the frame, or 1 if it is 0.
double length_of(const ModalBody& body) {
  const double length = body.node_position.rows() > 0 ? body.node_position.rowwise().norm().maxCoeff() : 0.0;
  return length > 0.0 ? length : 1.0;
}

void check_sizes(const ModalBody& b, const FilePlace& place) {
  const std::size_t n = b.node_name.size();
  const Index m = b.modes();
  if (n < 1) place.fail("/nodes/name", "there is no node", "name at least one node at which the body can be joined");
  const auto rows = static_cast<Index>(n);
  const bool whole = b.node_position.rows() == rows && b.node_mass.size() == rows && b.node_inertia.size() == n &&
                     b.X.size() == n &&
                     std::all_of(b.X.begin(), b.X.end(), [m](const auto& X) { return X.cols() == m; });
  if (!whole) place.fail("/nodes", "its datasets differ in length", "write one row per name in /nodes/name");
  if (b.zeta.size() != m)
    place.fail("/modes/zeta", fmt::format("has {} damping ratios for {} modes", b.zeta.size(), m),
               "write one ratio per mode");
  const ModalIntegrals& s = b.integrals;
  if (s.C1.cols() != m || s.P1.size() != 9 * m || s.P2.rows() != 9 * m || s.P2.cols() != m || s.N_mu.cols() != m)
    place.fail("/integrals", "its datasets have other sizes than the modes",
               "write the sums that formats/MODAL_BODY.md defines");
}

void check_names(const ModalBody& b, const FilePlace& place) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < b.node_name.size(); ++i) {
    const std::string& name = b.node_name[i];
    if (!is_name(name) || name.size() > 255)
      place.fail("/nodes/name", fmt::format("entry {} is not a valid name of a node", i),
                 "use letters, digits, _ and -, beginning with a letter or _");
    if (!seen.insert(name).second)
      place.fail("/nodes/name", fmt::format("entry {} is '{}', the name of an earlier node", i, name),
                 "give each node its own name");
  }
  for (const auto& [attribute, text] : {std::pair{"name", &b.name}, std::pair{"producer", &b.producer}}) {
    const bool clean =
        std::all_of(text->begin(), text->end(), [](char c) { return static_cast<unsigned char>(c) >= 32 && c != 127; });
    if (!clean || text->size() > 255)
      place.fail(fmt::format("attribute '{}'", attribute), "is not one line of at most 255 bytes", "shorten it");
  }
}

template <class Matrix>
void check_finite(const Matrix& values, const std::string& dataset, const FilePlace& place) {
  for (Index j = 0; j < values.cols(); ++j)
    for (Index i = 0; i < values.rows(); ++i)
      if (!(std::abs(values(i, j)) < largest_value))
        place.fail(dataset, fmt::format("[{}, {}] = {} is not a usable number", i, j, values(i, j)),
                   "write finite numbers below 1e100");
}

void check_finite(double value, const std::string& dataset, const FilePlace& place) {
  check_finite(Eigen::Matrix<double, 1, 1>(value), dataset, place);
}
template <class Matrix>
void check_finite(const std::vector<Matrix>& all, const std::string& dataset, const FilePlace& place) {
  for (std::size_t k = 0; k < all.size(); ++k) check_finite(all[k], fmt::format("{}[{}]", dataset, k), place);
}
template <class Array>
void check_finite(const Blocks<Array>& blocks, const std::string& dataset, const FilePlace& place) {
  check_finite(blocks.array, dataset, place);
}

void check_all_finite(const ModalBody& b, const FilePlace& place) {
  for_each_array(b, {0, 0, b.residual.node.size()},
                 [&](const char* dataset, const hdf5::Shape&, const char*, const auto& array) {
                   check_finite(array, dataset, place);
                 });
  if (std::abs(b.frame_orientation.norm() - 1.0) > 1e-6)
    place.fail("/frame/orientation",
               fmt::format("has length {}, expected a unit quaternion w x y z", b.frame_orientation.norm()),
               "divide it by its length");
}

/// Whether the matrix is symmetric and positive semidefinite, up to round-off.
bool is_inertia(const Matrix3d& inertia) {
  const double size = inertia.cwiseAbs().maxCoeff();
  if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() > 1e-12 * size) return false;
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues()[0] >= -1e-10 * size;
}

void check_masses(const ModalBody& b, const FilePlace& place) {
  for (std::size_t k = 0; k < b.node_name.size(); ++k) {
    const double mass = b.node_mass[k];
    if (mass < 0.0)
      place.fail("/nodes/mass", fmt::format("entry {} is {}, but a mass must not be negative", k, mass), "correct it");
    if (!is_inertia(b.node_inertia[k]))
      place.fail("/nodes/inertia",
                 fmt::format("entry {} (node '{}') is not symmetric and positive semidefinite", k, b.node_name[k]),
                 "correct it");
  }
}

void check_modes(const ModalBody& b, const FilePlace& place) {
  for (Index j = 0; j < b.modes(); ++j) {
    if (!(b.omega2[j] > 0.0))
      place.fail("/modes/omega2", fmt::format("entry {} is {}, expected a positive number", j, b.omega2[j]),
                 "remove rigid-body modes: the body frame already has these motions");
    if (j > 0 && b.omega2[j] < b.omega2[j - 1])
      place.fail("/modes/omega2", fmt::format("entry {} is smaller than the entry before it", j),
                 "sort the modes by frequency");
    if (b.zeta[j] < 0.0)
      place.fail("/modes/zeta", fmt::format("entry {} is {}, but a damping ratio must not be negative", j, b.zeta[j]),
                 "correct it");
  }
}

/// Smallest by largest singular value of the 6 x 6 rigid motions at the reference conditions, lengths over `length`.
double reference_condition(const ModalBody& b, double length) {
  Eigen::MatrixXd rows(6, 6);
  for (Index i = 0; i < 6; ++i) {
    Eigen::Matrix<double, 6, 6> motion = Eigen::Matrix<double, 6, 6>::Identity();
    const Vector3d x = b.node_position.row(b.reference_node[i]).transpose() / length;
    motion.topRightCorner<3, 3>() = -skew<double>(x);
    rows.row(i) = motion.row(b.reference_component[i]);
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows);
  return svd.singularValues()[5] / svd.singularValues()[0];
}

void check_node_reference(const ModalBody& b, const FilePlace& place) {
  if (b.reference_node.size() != 6 || b.reference_component.size() != 6)
    place.fail("/reference/node", "there are not six reference conditions", "fix exactly six components of nodes");
  for (std::size_t i = 0; i < 6; ++i) {
    if (b.reference_node[i] < 0 || b.reference_node[i] >= count_of(b.node_name))
      place.fail("/reference/node", fmt::format("entry {} is not a row of /nodes/name", i), "correct the number");
    if (b.reference_component[i] < 0 || b.reference_component[i] > 5)
      place.fail("/reference/component", fmt::format("entry {} is not 0 to 2 (translation) or 3 to 5 (rotation)", i),
                 "correct the number");
  }
  const double length = length_of(b);
  const double regularity = reference_condition(b, length);
  if (!(regularity > singular_tolerance))
    place.fail(
        "/reference",
        fmt::format(
            "the six conditions do not fix the frame to the body (smallest singular value {:.1e} of the largest)",
            regularity),
        "fix six components that prevent every rigid-body motion, such as 3 + 2 + 1 translations at three nodes");
  for (std::size_t i = 0; i < 6 && b.modes() > 0; ++i) {
    const auto node = static_cast<std::size_t>(b.reference_node[i]);
    const int component = b.reference_component[i];
    double largest = 0.0;
    for (const auto& X : b.X)
      largest = std::max({largest, X.topRows<3>().cwiseAbs().maxCoeff() / (component < 3 ? 1.0 : length),
                          X.bottomRows<3>().cwiseAbs().maxCoeff() * (component < 3 ? length : 1.0)});
    const double moved = b.X[node].row(component).cwiseAbs().maxCoeff();
    if (moved > reference_tolerance * largest)
      place.fail("/modes/X",
                 fmt::format("reference condition {}: component {} of node '{}' moves by {:.3g} in the modes", i,
                             component, b.node_name[node], moved),
                 "compute the modes with these components held");
  }
}

/// Checks the mean axis conditions: Σ m Xd = 0 and Σ m x × Xd + μ Xt = 0.
void check_mean_axis(const ModalBody& b, const FilePlace& place) {
  const double unit = std::sqrt(b.integrals.mass), length = length_of(b);
  for (Index j = 0; j < b.modes(); ++j) {
    const double translation = b.integrals.C1.col(j).norm();
    const double rotation = (vee(block(b.integrals.P1.data(), j)) + b.integrals.N_mu.col(j)).norm();
    if (translation > reference_tolerance * unit || rotation > reference_tolerance * unit * length)
      place.fail(
          "/modes/X",
          fmt::format("mode {} moves the mean axis: translation {:.3g}, rotation {:.3g}, expected 0", j, translation,
                      rotation),
          "use elastic modes of the free body that are orthogonal to its rigid-body motions with the lumped masses");
  }
}

void check_integrals(const ModalBody& b, const FilePlace& place, std::vector<std::string>& warnings) {
  const ModalIntegrals& s = b.integrals;
  if (!(s.mass > 0.0))
    place.fail("/integrals/mass", fmt::format("is {}, expected a positive mass", s.mass), "give the nodes masses");
  const double length = length_of(b);
  if (s.c0.norm() > 1e-9 * s.mass * length)
    place.fail("/integrals/c0",
               fmt::format("the centre of mass is {:.3g} away from the origin of the frame", s.c0.norm() / s.mass),
               "put the frame at the centre of mass of the undeformed body");
  const Matrix3d J = s.P0.trace() * Matrix3d::Identity() - s.P0 + s.J_mu;
  if (!is_inertia(s.P0) || !is_inertia(s.J_mu))
    place.fail("/integrals/P0", "P0 and J_mu must be symmetric and positive semidefinite",
               "write the sums over the nodes");
  const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(J);
  if (eigen.eigenvalues()[0] <= 1e-12 * eigen.eigenvalues()[2])
    warnings.push_back(
        fmt::format("The body has no inertia about the axis ({:.6g}, {:.6g}, {:.6g}) of its frame. The mechanism must "
                    "prevent rotation about this axis.",
                    eigen.eigenvectors()(0, 0), eigen.eigenvectors()(1, 0), eigen.eigenvectors()(2, 0)));
  for (Index i = 0; i < b.modes(); ++i)
    for (Index j = 0; j <= i; ++j) {
      const Matrix3d difference = block(s.P2.col(i).data(), j) - block(s.P2.col(j).data(), i).transpose();
      if (difference.cwiseAbs().maxCoeff() > integral_tolerance)
        place.fail("/integrals/P2", fmt::format("[{}, {}] is not the transpose of [{}, {}]", i, j, j, i),
                   "write the sums over the nodes");
    }
}

/// Checks stored integrals against the sums over the nodes, and modes against the masses.
void check_against_nodes(const ModalBody& b, const FilePlace& place) {
  const ModalIntegrals sums = integrals_of(b);
  const ModalIntegrals& s = b.integrals;
  const double mass = sums.mass, length = length_of(b), root = std::sqrt(std::max(mass, 0.0));
  const auto agree = [&](const char* name, const auto& stored, const auto& computed, double scale) {
    const double difference = computed.size() > 0 ? (stored - computed).cwiseAbs().maxCoeff() : 0.0;
    if (!(difference <= integral_tolerance * scale))
      place.fail(std::string("/integrals/") + name,
                 fmt::format("differs from the sum over the nodes by {:.3g}", difference),
                 "write the sums over all nodes, or set all_nodes to 0 if the file omits some nodes");
  };
  using One = Eigen::Matrix<double, 1, 1>;
  agree("mass", One(s.mass), One(sums.mass), mass);
  agree("c0", s.c0, sums.c0, mass * length);
  agree("C1", s.C1, sums.C1, root);
  agree("P0", s.P0, sums.P0, mass * length * length);
  agree("P1", s.P1, sums.P1, root * length);
  agree("P2", s.P2, sums.P2, 1.0);
  agree("J_mu", s.J_mu, sums.J_mu, std::max(sums.J_mu.norm(), 1e-300));
  agree("N_mu", s.N_mu, sums.N_mu, std::max(root * length, sums.N_mu.norm()));
  Eigen::MatrixXd XMX = Eigen::MatrixXd::Zero(b.modes(), b.modes());
  for (std::size_t k = 0; k < b.X.size(); ++k) {
    XMX += b.node_mass[k] * b.X[k].topRows<3>().transpose() * b.X[k].topRows<3>();
    XMX += b.X[k].bottomRows<3>().transpose() * b.node_inertia[k] * b.X[k].bottomRows<3>();
  }
  for (Index i = 0; i < b.modes(); ++i)
    for (Index j = 0; j <= i; ++j)
      if (!(std::abs(XMX(i, j) - (i == j ? 1.0 : 0.0)) <= normal_tolerance))
        place.fail("/modes/X",
                   fmt::format("modes {} and {}: XᵀM X is {:.12g}, expected {}", i, j, XMX(i, j), i == j ? 1 : 0),
                   "normalise the modes with the masses and inertias of the nodes");
}

/// Checks indices, sizes and symmetry of the residual.
void check_residual(const ModalBody& body, const FilePlace& place) {
  const ModalResidual& r = body.residual;
  const char* const remedy = "write the residual that formats/MODAL_BODY.md defines";
  const auto f = static_cast<Index>(r.node.size());
  if (r.component.size() != r.node.size() || r.flexibility.rows() != f || r.flexibility.cols() != f ||
      r.mass.rows() != f || r.mass.cols() != f || r.coupling.cols() != f || (f > 0 && r.coupling.rows() != 6))
    place.fail("/residual", "its datasets differ in length", remedy);
  for (std::size_t k = 0; k < r.node.size(); ++k) {
    if (r.node[k] < 0 || r.node[k] >= count_of(body.node_name))
      place.fail(fmt::format("/residual/node[{}]", k),
                 fmt::format("is {}, which is not a row of /nodes/name", r.node[k]), remedy);
    if (r.component[k] < 0 || r.component[k] > 5)
      place.fail(fmt::format("/residual/component[{}]", k), fmt::format("is {}, expected 0 to 5", r.component[k]),
                 remedy);
  }
  for (const auto& [matrix, name] : {std::pair{&r.flexibility, "/residual/flexibility"}, {&r.mass, "/residual/mass"}}) {
    const double largest = f > 0 ? matrix->cwiseAbs().maxCoeff() : 0.0;
    if (f > 0 && ((*matrix - matrix->transpose()).cwiseAbs().maxCoeff() > integral_tolerance * largest ||
                  matrix->diagonal().minCoeff() < -integral_tolerance * largest))
      place.fail(name, "is not symmetric with a positive diagonal", remedy);
  }
}

}  // namespace

ModalIntegrals integrals_of(const ModalBody& b) {
  const Index m = b.modes();
  ModalIntegrals s;
  s.C1.setZero(3, m);
  s.P1.setZero(9 * m);
  s.P2.setZero(9 * m, m);
  s.N_mu.setZero(3, m);
  for (std::size_t k = 0; k < b.node_name.size(); ++k) {
    const double mass = b.node_mass[k];
    const Vector3d x = b.node_position.row(k).transpose();
    const Eigen::Matrix3Xd Xd = b.X[k].topRows<3>(), Xt = b.X[k].bottomRows<3>();
    s.mass += mass;
    s.c0 += mass * x;
    s.C1 += mass * Xd;
    s.P0 += mass * x * x.transpose();
    s.J_mu += b.node_inertia[k];
    s.N_mu += b.node_inertia[k] * Xt;
    for (Index j = 0; j < m; ++j) {
      Eigen::Map<Matrix3d>(s.P1.data() + 9 * j) += mass * x * Xd.col(j).transpose();
      for (Index i = 0; i < m; ++i)
        Eigen::Map<Matrix3d>(s.P2.col(i).data() + 9 * j) += mass * Xd.col(i) * Xd.col(j).transpose();
    }
  }
  return s;
}

std::vector<std::string> check(const ModalBody& body, const std::string& where) {
  const FilePlace place{where};
  hdf5::check_units(body.units, where);
  check_sizes(body, place);
  check_names(body, place);
  check_all_finite(body, place);
  check_masses(body, place);
  check_modes(body, place);
  check_residual(body, place);
  std::vector<std::string> warnings;
  check_integrals(body, place, warnings);
  if (body.all_nodes) check_against_nodes(body, place);
  switch (body.reference) {
    case ModalReference::nodes:
      check_node_reference(body, place);
      break;
    case ModalReference::mean_axis:
      check_mean_axis(body, place);
      break;
  }
  return warnings;
}

}  // namespace tisserand::formats
