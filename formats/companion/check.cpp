// SPDX-License-Identifier: GPL-3.0-or-later
// check(): all rules of COMPANION.md for the contents of a companion, in the order of that page.
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/companion/companion.hpp"
#include "formats/companion/rigid_stress.hpp"
#include "formats/hdf5/head.hpp"
#include "formats/superelement/names.hpp"
#include "formats/superelement/scaling.hpp"

namespace tisserand::formats {
namespace {

constexpr double symmetry_accepted = 1e-9;     // symmetry of scaled entries, as for S̄ and M̄
constexpr double rigid_accepted = 1e-8;        // stress of rigid motions: round-off of a stress of the size E
constexpr double largest_of_stiffness = 1e14;  // limit of H and Λ² in scaled coordinates, relative to s/l and s/l²
constexpr double trapped_accepted = 1e-6;      // Λ on rigid motions: round-off of products with S̄
constexpr double gram_accepted = 1e-9;         // negative scaled eigenvalues
constexpr double integral_accepted = 1e-6;     // mass, S0, S1 compared with M̄, as the rigid mass of superelements
constexpr double weight_accepted = 1e-9;       // sum of weights
constexpr double largest_usable = 1e100;       // limit of entries: products of three stay finite
constexpr const char* other_program = "write the companion file again with the program that made the superelement";

/// Companion under check, with file name and scales.
struct Inspection {
  const Companion& companion;
  const Superelement& superelement;
  const std::string& file;
  ScaledMatrices scales;
  Eigen::VectorXd mass_row;   ///< scales of rows by M̄: 1/l for rotations
  Eigen::VectorXd force_row;  ///< scales of rows by S̄

  std::string dataset(const std::string& name) const { return file.empty() ? name : file + ": " + name; }
  Eigen::Index size() const { return superelement.size(); }
};

[[noreturn]] void fail_size(const Inspection& at, const std::string& dataset, Eigen::Index rows, Eigen::Index columns,
                            const std::string& expected) {
  throw Error(fmt::format("has {} x {} numbers, expected {} (superelement '{}' has {} coordinates)", rows, columns,
                          expected, printable_line(at.superelement.name, 60), at.size()),
              at.dataset(dataset), other_program);
}

void check_owner(const Inspection& at) {
  const std::string &quoted = at.companion.content_id, &own = at.superelement.content_id;
  if (quoted != own)
    throw Error(fmt::format("belongs to the superelement with content_id {}..., but '{}' has content_id {}...",
                            printable_line(quoted, 12), printable_line(at.superelement.name, 60), own.substr(0, 12)),
                at.dataset("attribute 'superelement'"),
                "give the companion file that was written with this superelement file, or reduce the part again; to "
                "run without it, remove it or write 'second_order: off' in the body");
  const Units &a = at.companion.units, &b = at.superelement.units;
  if (a.length.factor != b.length.factor || a.mass.factor != b.mass.factor || a.time.factor != b.time.factor)
    throw Error(
        fmt::format("the units are {:g} m, {:g} kg, {:g} s, but those of the superelement {:g} m, {:g} kg, {:g} s",
                    a.length.factor, a.mass.factor, a.time.factor, b.length.factor, b.mass.factor, b.time.factor),
        at.dataset("attribute 'length_unit'"), "write both files in the same units");
}

void check_square(const Inspection& at, const std::string& dataset, const Eigen::MatrixXd& matrix) {
  const Eigen::Index n = at.size();
  if (matrix.rows() != n || matrix.cols() != n)
    fail_size(at, dataset, matrix.rows(), matrix.cols(), fmt::format("{0} x {0}", n));
  for (Eigen::Index l = 0; l < n; ++l)
    for (Eigen::Index k = 0; k < n; ++k)
      if (!(std::abs(matrix(k, l)) < largest_usable))
        throw Error(fmt::format("[{}, {}] = {} is not a usable number: {}, column of {}", k, l, matrix(k, l),
                                row_text(at.superelement, k), row_text(at.superelement, l)),
                    at.dataset(dataset), "write finite numbers below 1e100");
}

void check_symmetric(const Inspection& at, const std::string& dataset, const Eigen::MatrixXd& matrix,
                     const Eigen::VectorXd& row) {
  check_square(at, dataset, matrix);
  const Eigen::MatrixXd scaled = row.asDiagonal() * matrix * row.asDiagonal();
  Eigen::Index k = 0, l = 0;
  if ((scaled - scaled.transpose()).cwiseAbs().maxCoeff(&k, &l) <= symmetry_accepted * scaled.cwiseAbs().maxCoeff())
    return;
  throw Error(fmt::format("is not symmetric: [{}, {}] = {}, but [{}, {}] = {}; {} and {}", k, l, matrix(k, l), l, k,
                          matrix(l, k), row_text(at.superelement, k), row_text(at.superelement, l)),
              at.dataset(dataset), other_program);
}

/// Checks W_k + W_kᵀ = 0.
void check_relative_turns(const Inspection& at) {
  const Companion& c = at.companion;
  if (!c.has_relative_turns()) return;
  for (int k = 0; k < 3; ++k) {
    const Eigen::MatrixXd& W = c.W[k];
    const std::string dataset = fmt::format("/W[{}]", k);
    check_square(at, dataset, W);
    const Eigen::MatrixXd scaled = at.mass_row.asDiagonal() * W * at.mass_row.asDiagonal();
    Eigen::Index row = 0, column = 0;
    if ((scaled + scaled.transpose()).cwiseAbs().maxCoeff(&row, &column) <=
        symmetry_accepted * scaled.cwiseAbs().maxCoeff())
      continue;
    throw Error(fmt::format("is not antisymmetric: [{}, {}] = {}, but [{}, {}] = {}; {} and {}", row, column,
                            W(row, column), column, row, W(column, row), row_text(at.superelement, row),
                            row_text(at.superelement, column)),
                at.dataset(dataset), other_program);
  }
}

/// Checks the weights α (nodes with translations, sum 1) and the reference point that they give.
void check_weights(const Inspection& at) {
  const Companion& c = at.companion;
  const Superelement& element = at.superelement;
  if (c.weights.size() != element.node_position.rows())
    fail_size(at, "/frame/weights", c.weights.size(), 1,
              fmt::format("{} boundary nodes", element.node_position.rows()));
  std::vector<bool> translates(element.node_name.size(), false);
  for (Eigen::Index row = 0; row < element.size(); ++row)
    if (element.dof_node[row] >= 0 && element.dof_component[row] < 3) translates[element.dof_node[row]] = true;
  for (Eigen::Index i = 0; i < c.weights.size(); ++i)
    if (!(std::abs(c.weights[i]) < largest_usable) || (!translates[i] && c.weights[i] != 0.0))
      throw Error(fmt::format("[{}] = {}: node '{}' {}", i, c.weights[i], element.node_name[i],
                              translates[i] ? "needs a finite weight" : "has no translations, so its weight must be 0"),
                  at.dataset("/frame/weights"), "write finite weights, and 0 for nodes without translations");
  if (!(std::abs(c.weights.sum() - 1.0) <= weight_accepted))
    throw Error(fmt::format("the weights have the sum {}, expected 1", c.weights.sum()), at.dataset("/frame/weights"),
                "divide them by their sum");
  const Eigen::Vector3d mean = element.node_position.transpose() * c.weights;
  const double size = at.scales.length * (1.0 + c.weights.cwiseAbs().sum()) + mean.norm();
  if (!((mean - c.reference_point).cwiseAbs().maxCoeff() <= weight_accepted * size))
    throw Error(fmt::format("is ({}, {}, {}), but the weighted mean of the nodes is ({}, {}, {})", c.reference_point[0],
                            c.reference_point[1], c.reference_point[2], mean[0], mean[1], mean[2]),
                at.dataset("/frame/reference_point"), "write the weighted mean of the positions of the nodes");
}

/// Checks mass, S0 and S1 against R_Tᵀ M̄ R.
void check_integrals(const Inspection& at) {
  const Companion& c = at.companion;
  const RigidProperties rigid = rigid_properties(at.superelement);
  const auto fail = [&](const char* dataset, const std::string& what) {
    throw Error(what + ", computed from /mass of the superelement", at.dataset(dataset), other_program);
  };
  if (!(std::abs(c.mass - rigid.mass) <= integral_accepted * rigid.mass))
    fail("/mass", fmt::format("is {}, expected {}", c.mass, rigid.mass));
  const Eigen::Vector3d arm = rigid.center_of_mass - c.reference_point;
  const double moment = integral_accepted * rigid.mass * (at.scales.length + arm.norm());
  for (int k = 0; k < 3; ++k)
    if (!(std::abs(c.S0[k] - rigid.mass * arm[k]) <= moment))
      fail("/S0", fmt::format("[{}] is {}, expected {}", k, c.S0[k], rigid.mass * arm[k]));
  if (c.S1.cols() != at.size()) fail_size(at, "/S1", 3, c.S1.cols(), fmt::format("3 x {}", at.size()));
  const Eigen::MatrixXd R = rigid_motions(at.superelement, c.reference_point);
  const Eigen::MatrixXd momentum = R.leftCols<3>().transpose() * at.superelement.mass;
  const double scale = (momentum * at.mass_row.asDiagonal()).cwiseAbs().maxCoeff();
  for (Eigen::Index l = 0; l < at.size(); ++l)
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(c.S1(k, l) - momentum(k, l)) * at.mass_row[l] <= integral_accepted * scale))
        fail("/S1", fmt::format("[{}, {}] is {}, expected {} ({})", k, l, c.S1(k, l), momentum(k, l),
                                row_text(at.superelement, l)));
}

/// Checks H R = Σ_j R_ja H_j = 0: rigid motions cause no stress.
void check_rigid_stress(const Inspection& at) {
  const RigidStress stress = rigid_stress(at.companion, at.superelement);
  if (!(stress.largest <= largest_of_stiffness * stress.stiffness))
    throw Error(fmt::format("its largest entry is {:.3e} times the stiffness divided by the length (at most {:g}), "
                            "which no real stress causes",
                            stress.largest / stress.stiffness, largest_of_stiffness),
                at.dataset("/H"), other_program);
  if (stress.residual <= rigid_accepted * stress.scale()) return;
  throw Error(fmt::format("a rigid-body motion causes stress: {} gives {:.3e} times the largest entry, and {:.3e} "
                          "times the stiffness divided by the length (at most {:g} times the larger one)",
                          motion_text(stress.motion), stress.residual / stress.largest,
                          stress.residual / stress.stiffness, rigid_accepted),
              at.dataset("/H"), other_program);
}

/// Checks Λ_b R = 0: rigid motions trap no membrane stress.
void check_trapped(const Inspection& at) {
  const Eigen::MatrixXd R = scaled_rigid_motions(at.superelement, at.force_row, at.scales.length);
  for (std::size_t b = 0; b < at.companion.Lambda.size(); ++b) {
    const std::string dataset = fmt::format("/Lambda[{}]", b);
    check_symmetric(at, dataset, at.companion.Lambda[b], at.force_row);
    const Eigen::MatrixXd scaled = at.force_row.asDiagonal() * at.companion.Lambda[b] * at.force_row.asDiagonal();
    const double residual = (scaled * R).cwiseAbs().maxCoeff(), largest = scaled.cwiseAbs().maxCoeff();
    const double of_stiffness = largest * at.scales.length / std::sqrt(at.scales.stiffness_scale);
    if (!(of_stiffness * of_stiffness <= largest_of_stiffness))
      throw Error(fmt::format("its largest entry gives {:.3e} times the strain energy of the stiffness in a "
                              "deformation as large as the body (at most {:g})",
                              of_stiffness * of_stiffness, largest_of_stiffness),
                  at.dataset(dataset),
                  "reduce the part again; if the error returns, remove `double_curvature` from the part file");
    if (!(residual <= trapped_accepted * largest))
      throw Error(
          fmt::format(
              "a rigid-body motion causes membrane stress: Lambda R is {:.3e} times the largest entry (at most {:g})",
              residual / largest, trapped_accepted),
          at.dataset(dataset), other_program);
  }
}

/// Checks that [M̄ Ω_k C_k; . Ω_j Ω_k E_jk], the Gram matrix of the velocities Φ ẏ + Ω × Φ y, is positive semidefinite.
/// E holds the part symmetric in jk. Tested directions of Ω: the 13 axes and diagonals of a cube.
void check_gram(const Inspection& at) {
  const Companion& c = at.companion;
  const Eigen::Index n = at.size();
  const double m = at.scales.mass_scale;
  const auto scaled = [&](const Eigen::MatrixXd& A) -> Eigen::MatrixXd {
    return at.mass_row.asDiagonal() * A * at.mass_row.asDiagonal() / m;
  };
  Eigen::MatrixXd gram(2 * n, 2 * n);
  for (int code = 14; code < 27; ++code) {  // one of each pair of opposite directions
    const Eigen::Vector3d Omega = Eigen::Vector3d(code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1).normalized();
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(n, n), E = C;
    for (int k = 0; k < 3; ++k) C += Omega[k] * c.C[k];
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) E += Omega[j] * Omega[k] * c.E[axis_pair(j, k)];
    gram.topLeftCorner(n, n) = scaled(at.superelement.mass);
    gram.topRightCorner(n, n) = scaled(C);
    gram.bottomLeftCorner(n, n) = gram.topRightCorner(n, n).transpose();
    gram.bottomRightCorner(n, n) = scaled(E);
    gram = (0.5 * (gram + gram.transpose())).eval();
    Eigen::MatrixXd shifted = gram;
    shifted.diagonal().array() += gram_accepted * std::max(1.0, gram.diagonal().maxCoeff());
    if (Eigen::LLT<Eigen::MatrixXd>(shifted).info() == Eigen::Success) continue;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
    Eigen::Index row = 0;
    eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&row);
    throw Error(fmt::format("the kinetic energy is not positive: for rotation about ({:.3g}, {:.3g}, {:.3g}), the "
                            "matrix [M C; C' E] has the scaled eigenvalue {:.3e} (largest {:.3e}), mainly in {}",
                            Omega[0], Omega[1], Omega[2], eigen.eigenvalues()[0], eigen.eigenvalues()[2 * n - 1],
                            row_text(at.superelement, row % n)),
                at.dataset("/E"), other_program);
  }
}

void check_second_order(const Inspection& at) {
  static constexpr const char* pairs[] = {"xx", "yy", "zz", "yz", "xz", "xy"};
  const Companion& c = at.companion;
  const auto n = static_cast<std::size_t>(at.size());
  if (c.H.size() != n)
    fail_size(at, "/H", static_cast<Eigen::Index>(c.H.size()), static_cast<Eigen::Index>(c.H.size()),
              fmt::format("{0} matrices {0} x {0}", n));
  check_integrals(at);
  for (std::size_t j = 0; j < n; ++j) check_symmetric(at, fmt::format("/H[{}]", j), c.H[j], at.force_row);
  for (int k = 0; k < 3; ++k) check_square(at, fmt::format("/C[{}]", k), c.C[k]);
  for (int jk = 0; jk < 6; ++jk) {
    check_symmetric(at, fmt::format("/E[{}] ({})", jk, pairs[jk]), c.E[jk], at.mass_row);
    check_symmetric(at, fmt::format("/N[{}]", jk), c.N[jk], at.mass_row);
    check_symmetric(at, fmt::format("/T[{}] ({})", jk, pairs[jk]), c.T[jk], at.mass_row);
  }
  check_relative_turns(at);
  check_rigid_stress(at);
  check_trapped(at);
  check_gram(at);
}

void check_load_cases(const Inspection& at) {
  std::string before;
  for (const LoadCase& load : at.companion.load_cases) {
    const std::string group = "/load_cases/" + printable_line(load.name, 60);
    if (!valid_name(load.name) || !(before < load.name))
      throw Error(
          "is not a valid name of a load case, or is not in ascending order", at.dataset(group),
          "use letters, digits, _ and -, beginning with a letter or _; write each name once, in ascending order");
    before = load.name;
    if (load.force.size() > 0 && load.force.size() != at.size())
      fail_size(at, group + "/force", load.force.size(), 1, fmt::format("{}", at.size()));
    for (Eigen::Index k = 0; k < load.force.size(); ++k)
      if (!(std::abs(load.force[k]) < largest_usable))
        throw Error(fmt::format("[{}] = {} is not a usable number: {}", k, load.force[k], row_text(at.superelement, k)),
                    at.dataset(group + "/force"), "write finite numbers below 1e100");
    if (load.stiffness.size() > 0) check_symmetric(at, group + "/stiffness", load.stiffness, at.force_row);
  }
}

}  // namespace

void check(const Companion& companion, const Superelement& superelement, const std::string& where) {
  Inspection at{companion, superelement, where, scale(superelement), {}, {}};
  at.mass_row = at.scales.mass_row;
  at.force_row = at.scales.stiffness_row;
  hdf5::check_units(companion.units, where);
  check_owner(at);
  check_weights(at);
  if (companion.has_second_order()) check_second_order(at);
  check_load_cases(at);
}

}  // namespace tisserand::formats
