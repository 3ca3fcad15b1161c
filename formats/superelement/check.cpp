// SPDX-License-Identifier: GPL-3.0-or-later
// check(): all rules of SUPERELEMENT.md for the contents of a superelement, in the order of that page.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "common/text.hpp"
#include "formats/hdf5/head.hpp"
#include "formats/superelement/names.hpp"
#include "formats/superelement/rigid_strain.hpp"
#include "formats/superelement/scaling.hpp"

namespace tisserand::formats {
namespace {

constexpr double symmetry_tolerance = 1e-9;      // scaled entries; 100 × round-off of sums of 1e5 terms
constexpr double semidefinite_tolerance = 1e-9;  // scaled eigenvalues
constexpr double rigid_mass_tolerance = 1e-6;    // relative to the mass; lumping and unit conversion lose less
constexpr double triangle_accepted = 0.01;       // relative to the largest principal moment, with a warning
constexpr double collinear_tolerance = 1e-6;     // relative to the characteristic length
constexpr double largest_value = 1e100;          // limit of entries: products of three and a length stay finite
constexpr Eigen::Index max_size_for_eigenvectors = 2000;

struct FilePlace {
  const std::string& file;
  std::string dataset(const std::string& name) const { return file.empty() ? name : file + ": " + name; }
};

void check_sizes(const Superelement& e, const FilePlace& place) {
  const Eigen::Index n = e.size(), nodes = static_cast<Eigen::Index>(e.node_name.size());
  const auto fail = [&](const std::string& dataset, const std::string& what, const std::string& remedy) {
    throw Error(what, place.dataset(dataset), remedy);
  };
  if (nodes < 1)
    fail("/boundary/name", "there is no boundary node", "name at least one node at which the part can be joined");
  if (n < 1) fail("/dof/node", "there are no coordinates", "write one entry per row of /stiffness");
  if (n > max_coordinates)
    fail("/dof/node", fmt::format("has {} coordinates, at most {} are allowed", n, max_coordinates),
         "keep fewer nodes or modes");
  if (e.node_position.rows() != nodes)
    fail("/boundary/position",
         fmt::format("has {} rows, but /boundary/name has {} names", e.node_position.rows(), nodes),
         "write one row x, y, z per name");
  if (static_cast<Eigen::Index>(e.dof_component.size()) != n)
    fail("/dof/component", fmt::format("has {} entries, but /dof/node has {}", e.dof_component.size(), n),
         "write one entry per row of /stiffness");
  if (e.stiffness.rows() != n || e.stiffness.cols() != n)
    fail("/stiffness", fmt::format("has shape {} x {}, expected {} x {}", e.stiffness.rows(), e.stiffness.cols(), n, n),
         "write one row and column per entry of /dof/node");
  if (e.mass.rows() != n || e.mass.cols() != n)
    fail("/mass", fmt::format("has shape {} x {}, expected {} x {}", e.mass.rows(), e.mass.cols(), n, n),
         "write one row and column per entry of /dof/node");
}

void check_names(const Superelement& e, const FilePlace& place) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < e.node_name.size(); ++i) {
    if (!valid_name(e.node_name[i]))
      throw Error(
          fmt::format("entry {} is '{}', which is not a valid name of a node", i, printable_line(e.node_name[i], 60)),
          place.dataset("/boundary/name"), "use letters, digits, _ and -, beginning with a letter or _");
    if (!seen.insert(e.node_name[i]).second)
      throw Error(fmt::format("entry {} is '{}', the name of an earlier node", i, e.node_name[i]),
                  place.dataset("/boundary/name"), "give each node its own name");
  }
}

/// Checks that each row of the table is a different coordinate, and each node has translations, rotations, or both.
void check_dof_table(const Superelement& e, const FilePlace& place) {
  const int nodes = count_of(e.node_name), n = count_of(e);
  const int internal = static_cast<int>(std::count(e.dof_node.begin(), e.dof_node.end(), -1));
  std::vector<std::array<int, 6>> owner(e.node_name.size(), {-1, -1, -1, -1, -1, -1});
  std::vector<int> internal_owner(static_cast<std::size_t>(internal), -1);
  for (int row = 0; row < n; ++row) {
    const int node = e.dof_node[row], component = e.dof_component[row];
    if (node < -1 || node >= nodes)
      throw Error(fmt::format("entry {} is {}, expected -1 (internal coordinate) or the row 0 to {} of a boundary node",
                              row, node, nodes - 1),
                  place.dataset("/dof/node"), "correct the number");
    const int limit = node < 0 ? internal : 6;
    if (component < 0 || component >= limit)
      throw Error(
          node < 0 ? fmt::format("entry {} is {}, expected the number 0 to {} of an internal coordinate", row,
                                 component, limit - 1)
                   : fmt::format("entry {} is {}, expected 0 to 2 (translation x, y, z) or 3 to 5 (rotation x, y, z)",
                                 row, component),
          place.dataset("/dof/component"), "correct the number");
    int& slot = node < 0 ? internal_owner[component] : owner[node][component];
    if (slot >= 0)
      throw Error(fmt::format("rows {} and {} are the same coordinate: {}", slot, row, row_text(e, row)),
                  place.dataset("/dof/component"), "write every coordinate once");
    slot = row;
  }
  for (std::size_t node = 0; node < owner.size(); ++node) {
    int translations = 0, rotations = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      translations += owner[node][k] >= 0 ? 1 : 0;
      rotations += owner[node][k + 3] >= 0 ? 1 : 0;
    }
    const bool whole = (translations == 0 || translations == 3) && (rotations == 0 || rotations == 3);
    if (!whole || translations + rotations == 0)
      throw Error(
          fmt::format("node '{}' has {} translations and {} rotations, expected 3 or 0 of each, and not 0 of both",
                      e.node_name[node], translations, rotations),
          place.dataset("/dof/component"), "keep x, y and z of a node together");
  }
}

void check_finite_matrix(const Superelement& e, const Eigen::MatrixXd& matrix, const std::string& name,
                         const FilePlace& place) {
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      if (!(std::abs(matrix(i, j)) < largest_value))
        throw Error(fmt::format("[{}, {}] = {} is not a usable number: {}, column of {}", i, j, matrix(i, j),
                                row_text(e, i), row_text(e, j)),
                    place.dataset(name), "write finite numbers below 1e100");
}

void check_finite(const Superelement& e, const FilePlace& place) {
  for (Eigen::Index i = 0; i < e.node_position.rows(); ++i)
    for (Eigen::Index k = 0; k < 3; ++k)
      if (!(std::abs(e.node_position(i, k)) < largest_value))
        throw Error(fmt::format("[{}, {}] = {} is not a usable number: {} of node '{}'", i, k, e.node_position(i, k),
                                "xyz"[k], e.node_name[i]),
                    place.dataset("/boundary/position"), "write finite numbers below 1e100");
  check_finite_matrix(e, e.stiffness, "/stiffness", place);
  check_finite_matrix(e, e.mass, "/mass", place);
}

void check_diagonal(const Superelement& e, const Eigen::MatrixXd& matrix, const std::string& name,
                    const FilePlace& place) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    if (matrix(i, i) < 0.0 && e.dof_node[i] < 0)
      throw Error(
          fmt::format("is not positive semidefinite: [{}, {}] = {} < 0, {}", i, i, matrix(i, i), row_text(e, i)),
          place.dataset(name), "check the reduction that made the file");
}

/// Checks symmetry. `scaled` is D A D / scale.
void check_symmetry(const Superelement& e, const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& scaled,
                    const std::string& name, const FilePlace& place) {
  Eigen::Index i = 0, j = 0;
  const double worst = (scaled - scaled.transpose()).cwiseAbs().maxCoeff(&i, &j);
  if (worst <= symmetry_tolerance) return;
  if (i > j) std::swap(i, j);
  throw Error(fmt::format("is not symmetric: [{}, {}] = {}, but [{}, {}] = {}; {} and {}", i, j, matrix(i, j), j, i,
                          matrix(j, i), row_text(e, i), row_text(e, j)),
              place.dataset(name), "check the reduction that made the file");
}

/// Checks by Cholesky of A + tolerance 1. Computes eigenvectors for the message only on failure.
void check_semidefinite(const Superelement& e, const Eigen::MatrixXd& scaled, const std::string& name,
                        const FilePlace& place) {
  const Eigen::Index n = scaled.rows();
  Eigen::MatrixXd shifted = 0.5 * (scaled + scaled.transpose());
  shifted.diagonal().array() += semidefinite_tolerance;
  if (Eigen::LLT<Eigen::MatrixXd>(shifted).info() == Eigen::Success) return;
  std::string text = "is not positive semidefinite";
  if (n <= max_size_for_eigenvectors) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(shifted);
    Eigen::Index row = 0;
    eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&row);
    text += fmt::format(": scaled eigenvalue {:.3e} (largest {:.3e}), mainly in {}",
                        eigen.eigenvalues()[0] - semidefinite_tolerance, eigen.eigenvalues()[n - 1], row_text(e, row));
  }
  throw Error(text, place.dataset(name), "check the reduction that made the file");
}

/// Checks that every rigid motion moves a retained row. Nodes with translations and nodes with rotations ensure it.
void check_rigid_rank(const Superelement& e, const FilePlace& place) {
  const std::size_t count = e.node_name.size();
  std::vector<Eigen::Index> translating;
  std::vector<bool> has_translation(count, false);
  bool rotations = false;
  for (Eigen::Index row = 0; row < e.size(); ++row) {
    const int node = e.dof_node[row];
    if (node < 0) continue;
    if (e.dof_component[row] < 3)
      has_translation[node] = true;
    else
      rotations = true;
  }
  for (std::size_t i = 0; i < count; ++i)
    if (has_translation[i]) translating.push_back(static_cast<Eigen::Index>(i));
  const auto fail = [&](const std::string& motion, const std::string& remedy) {
    throw Error(fmt::format("the coordinates of the boundary nodes do not change when the part {}", motion),
                place.dataset("/dof/node"), remedy);
  };
  if (translating.empty()) fail("moves in x, y or z", "keep the translations of at least one node");
  if (rotations) return;
  const auto name = [&](Eigen::Index node) { return e.node_name[node]; };
  const double tolerance = collinear_tolerance * characteristic_length(e);
  const Eigen::RowVector3d a = e.node_position.row(translating.front());
  Eigen::Index far = translating.front();
  for (const Eigen::Index node : translating)
    if ((e.node_position.row(node) - a).norm() > (e.node_position.row(far) - a).norm()) far = node;
  const Eigen::RowVector3d line = e.node_position.row(far) - a;
  const std::string remedy = "keep rotations at a node, or the translations of three nodes that are not on one line";
  if (line.norm() <= tolerance) fail(fmt::format("turns about node {}", name(translating.front())), remedy);
  for (const Eigen::Index node : translating) {
    const Eigen::RowVector3d d = e.node_position.row(node) - a;
    if (d.cross(line.normalized()).norm() > tolerance) return;
  }
  // The farthest node from node a is one end of the set, and the farthest from that end is the other.
  Eigen::Index other = far;
  for (const Eigen::Index node : translating)
    if ((e.node_position.row(node) - e.node_position.row(far)).norm() >
        (e.node_position.row(other) - e.node_position.row(far)).norm())
      other = node;
  fail(fmt::format("turns about the line {}-{}", name(std::min(other, far)), name(std::max(other, far))), remedy);
}

/// Stiffness, rigid motions and errors of the entries, all scaled.
struct ScaledStiffness {
  Eigen::MatrixXd S, R, bound;
};

/// Throws Error if rigid motions cause more force than projection may remove.
void check_rigid_strain(const Superelement& e, const ScaledStiffness& scaled, SuperelementReport& report,
                        const FilePlace& place) {
  static constexpr const char* motions[] = {"moving in x",     "moving in y",     "moving in z",
                                            "turning about x", "turning about y", "turning about z"};
  const std::string positions =
      "check the positions of the nodes and their unit, the signs and the order of the rotations (in radians), and "
      "that the part is not fixed to the ground";
  Eigen::Index row = 0, motion = 0;
  report.rigid_residual = (scaled.S * scaled.R).cwiseAbs().maxCoeff(&row, &motion);
  if (report.rigid_residual <= rigid_residual_exact) return;
  if (report.rigid_residual > rigid_residual_filtered)
    throw Error(
        fmt::format("the part resists rigid-body motion: {} gives a relative force of {:.3e} (at most {:g}) in {}",
                    motions[motion], report.rigid_residual, rigid_residual_filtered, row_text(e, row)),
        place.dataset("/stiffness"), positions);
  const RigidStrain strain = rigid_strain(0.5 * (scaled.S + scaled.S.transpose()), scaled.R, scaled.bound);
  report.rigid_change = strain.change;
  const bool explained = strain.cause == RigidStrainCause::rounding;
  if (strain.change <= (explained ? rigid_change_rounding : rigid_change_accepted)) return;
  const std::string found = fmt::format(
      "the part resists rigid-body motion: {} gives a relative force of {:.3e} in {}, which is {:.3g} times the "
      "stiffness of its softest deformation",
      motions[strain.motion], strain.force, row_text(e, strain.row), strain.change);
  const std::string digits = report.rounding.empty() ? "" : fmt::format(" ({})", report.rounding);
  if (explained)
    throw Error(fmt::format("{} (at most {:g}). Rounding of the entries{} may be the cause, but then the entries are "
                            "too inaccurate for that deformation",
                            found, rigid_change_rounding, digits),
                place.dataset("/stiffness"), "write the matrix with more digits; if it has them, " + positions);
  throw Error(fmt::format("{} (at most {:g}). Rounding of the entries{} is not the cause", found, rigid_change_accepted,
                          digits),
              place.dataset("/stiffness"), positions);
}

void check_rigid_mass(const Superelement& e, double length, const FilePlace& place) {
  Eigen::MatrixXd R = rigid_motions(e, e.node_position.colwise().mean().transpose());
  R.rightCols<3>() /= length;
  const Eigen::Matrix<double, 6, 6> M = R.transpose() * e.mass * R;
  const double m = M.topLeftCorner<3, 3>().trace() / 3.0;
  if (!(m > 0.0))
    throw Error(fmt::format("the rigid-body mass of the part is {}, expected a positive number", m),
                place.dataset("/mass"), "give the part a density or point masses");
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (!(std::abs(M(i, j) - (i == j ? m : 0.0)) <= rigid_mass_tolerance * m))
        throw Error(
            fmt::format("the rigid-body mass of the part is not the same in all directions: along x {}, y {}, z {}, "
                        "coupling {}-{} {}",
                        M(0, 0), M(1, 1), M(2, 2), "xyz"[i], "xyz"[j], i == j ? 0.0 : M(i, j)),
            place.dataset("/mass"), "check that the whole mass moves with each translation of the part");
  const Eigen::Matrix3d C = M.topRightCorner<3, 3>();
  if (!((C + C.transpose()).cwiseAbs().maxCoeff() <= rigid_mass_tolerance * std::max(m, C.cwiseAbs().maxCoeff())))
    throw Error(
        "the coupling of translation and rotation does not fit one centre of mass (the coupling block is not "
        "skew-symmetric)",
        place.dataset("/mass"), "check the positions of the nodes and the signs of the rotations");
}

/// Checks principal moments ≥ 0 and the triangle inequality. A zero moment causes a warning that names the axis.
void check_inertia(const Superelement& e, double length, SuperelementReport& report, const FilePlace& place) {
  const RigidProperties& rigid = report.rigid;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(rigid.inertia);
  const Eigen::Vector3d I = eigen.eigenvalues();
  const double offset = (rigid.center_of_mass - e.node_position.colwise().mean().transpose()).norm();
  const double scale = rigid.mass * (length * length + offset * offset);
  const double zero = semidefinite_tolerance * scale, tolerance = rigid_mass_tolerance * std::max(I[2], zero);
  if (!(I[0] >= -zero))
    throw Error(fmt::format("the inertia about the centre of mass has the negative principal moment {}", I[0]),
                place.dataset("/mass"), "check the positions of the nodes and the signs of the rotations");
  const std::string no_body = fmt::format(
      "no real body has the principal moments of inertia {}, {}, {}: the largest exceeds the sum of the others", I[0],
      I[1], I[2]);
  if (!(I[0] + I[1] >= (1.0 - triangle_accepted) * I[2] - 3 * zero))
    throw Error(no_body, place.dataset("/mass"),
                "check the mass matrix; a short part without rotary inertia of bending can cause this");
  if (!(I[0] + I[1] >= I[2] - std::max(tolerance, 3 * zero)))
    report.warnings.push_back(fmt::format("{}: {}.", place.dataset("/mass"), no_body));
  for (int k = 0; k < 3; ++k) {
    if (I[k] > 1e-12 * scale) continue;
    const Eigen::Vector3d axis = eigen.eigenvectors().col(k) * (eigen.eigenvectors().col(k).sum() < 0 ? -1.0 : 1.0);
    report.warnings.push_back(fmt::format(
        "The part has no inertia about the axis ({:.6g}, {:.6g}, {:.6g}) through its centre of mass ({:.6g}, {:.6g}, "
        "{:.6g}). The mechanism must prevent rotation about this axis.",
        axis[0] + 0.0, axis[1] + 0.0, axis[2] + 0.0, rigid.center_of_mass[0], rigid.center_of_mass[1],
        rigid.center_of_mass[2]));
  }
}

}  // namespace

bool needs_filter(const SuperelementReport& report) {
  return report.rigid_residual > rigid_residual_accepted || report.rigid_change > rigid_change_accepted;
}

std::string filter_note(const SuperelementReport& report, const std::string& where) {
  const std::string note = fmt::format(
      "{}: rigid-body motions cause strain in the part (relative force {:.3e}, {:.1e} times the stiffness of its "
      "softest deformation). This strain was removed from /stiffness by projection",
      where, report.rigid_residual, report.rigid_change);
  if (report.rigid_change <= rigid_change_accepted) return note + ".";
  return note + fmt::format(
                    ". Rounding of the entries{} is the cause. The stiffness of that deformation is uncertain by about "
                    "the same ratio; a matrix with more digits is more accurate.",
                    report.rounding.empty() ? "" : fmt::format(" ({})", report.rounding));
}

SuperelementReport check(const Superelement& element, const std::string& where) {
  const bool square = element.stiffness.rows() == element.size() && element.stiffness.cols() == element.size();
  return check(element, where,
               square && element.stiffness.allFinite() ? entry_errors(element.stiffness) : EntryErrors{});
}

SuperelementReport check(const Superelement& element, const std::string& where, const EntryErrors& errors) {
  const FilePlace place{where};
  hdf5::check_units(element.units, where);
  check_sizes(element, place);
  check_names(element, place);
  check_dof_table(element, place);
  check_finite(element, place);
  check_diagonal(element, element.stiffness, "/stiffness", place);
  check_diagonal(element, element.mass, "/mass", place);

  const ScaledMatrices s = scale(element);
  const auto scaled = [&s](const Eigen::MatrixXd& A) -> Eigen::MatrixXd {
    return s.stiffness_row.asDiagonal() * A * s.stiffness_row.asDiagonal() / s.stiffness_scale;
  };
  ScaledStiffness stiffness{scaled(element.stiffness), scaled_rigid_motions(element, s.stiffness_row, s.length), {}};
  const Eigen::MatrixXd M = s.mass_row.asDiagonal() * element.mass * s.mass_row.asDiagonal() / s.mass_scale;
  if (!stiffness.S.allFinite() || !M.allFinite() || !stiffness.R.allFinite())
    throw Error("values of /boundary/position, /stiffness and /mass differ by too many powers of ten", where,
                "choose units in which lengths, forces and masses are neither very large nor very small");
  check_symmetry(element, element.stiffness, stiffness.S, "/stiffness", place);
  check_symmetry(element, element.mass, M, "/mass", place);
  check_rigid_rank(element, place);

  SuperelementReport report;
  report.characteristic_length = s.length;
  report.rounding = errors.reason;
  if (errors.bound.size() > 0) stiffness.bound = scaled(errors.bound);
  check_rigid_strain(element, stiffness, report, place);
  if (needs_filter(report)) {
    Superelement filtered = element;
    filter_rigid_motions(filtered);
    stiffness.S = scaled(filtered.stiffness);
  }
  check_semidefinite(element, stiffness.S, "/stiffness", place);
  check_semidefinite(element, M, "/mass", place);
  check_rigid_mass(element, s.length, place);
  report.rigid = rigid_properties(element);
  check_inertia(element, s.length, report, place);
  return report;
}

}  // namespace tisserand::formats
