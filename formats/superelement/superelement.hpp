// SPDX-License-Identifier: GPL-3.0-or-later
// The superelement file *.superelement.h5, the interface between the two programs (formats/SUPERELEMENT.md).
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"

namespace tisserand::formats {

/// Superelement: reduced stiffness S̄ and mass M̄ with the meaning of their rows. It has n coordinates, in any order,
/// and nB boundary nodes.
struct Superelement {
  std::string name;
  std::string method;    ///< "craig_bampton", "guyan", ...: information without effect on computations
  std::string producer;  ///< program and version
  Units units;
  std::string content_id;  ///< SHA-256 (hex); filled by read and write

  std::vector<std::string> node_name;                      ///< nB, unique
  Eigen::Matrix<double, Eigen::Dynamic, 3> node_position;  ///< nB x 3, part frame
  std::vector<int> dof_node;                               ///< n: row of the boundary node, −1: internal coordinate
  /// n; 0-2 translations, 3-5 rotations; for an internal coordinate its number.
  std::vector<int> dof_component;
  Eigen::MatrixXd stiffness;  ///< n x n, S̄
  Eigen::MatrixXd mass;       ///< n x n, M̄

  Eigen::Index size() const { return static_cast<Eigen::Index>(dof_node.size()); }
};

/// Mass, centre of mass, and inertia about the centre of mass, in part axes. They follow from the reduced mass matrix
/// and the rigid motions ([Car00] 3.1 step 1).
struct RigidProperties {
  double mass = 0.0;
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/// Measurements of check() on a superelement. `warnings` are sentences.
struct SuperelementReport {
  double characteristic_length = 1.0;  ///< largest distance of a node from the mean of the nodes (1 if 0)
  double rigid_residual = 0.0;         ///< max |S R| / max |S|, rotations scaled with the characteristic length
  double rigid_change = 0.0;           ///< RigidStrain::change of the rigid motions; 0: round-off
  std::string rounding;                ///< precision of entries of S: "10 digits", "single precision"; empty: double
  bool filtered = false;               ///< whether read_superelement() projected rigid motions out of S̄
  RigidProperties rigid;
  std::vector<std::string> warnings;
};

/// Superelement that was read from a file, with the report of its checks.
struct LoadedSuperelement {
  Superelement superelement;
  SuperelementReport report;
};

/// Six rigid motions on the rows of `element` (n x 6), THEORY (8): unit translations, then (e_k x X_a, e_k) for
/// rotation about axis e_k, with X_a from `origin` to node a. They are zero in internal coordinates.
Eigen::MatrixXd rigid_motions(const Superelement& element, const Eigen::Vector3d& origin);

/// Mass, centre of mass and inertia, computed from the reduced mass matrix M̄ alone.
RigidProperties rigid_properties(const Superelement& element);

struct EntryErrors;

/// Checks all rules of SUPERELEMENT.md. `where`: file name in messages. `errors`: bounds of the errors of entries of S.
/// Without `errors` digits of S are counted, which fails if the axes of S were rotated before. Throws Error.
SuperelementReport check(const Superelement& element, const std::string& where);
SuperelementReport check(const Superelement& element, const std::string& where, const EntryErrors& errors);

/// Whether rigid motions must be projected out of the stiffness S: their residual is above 1e-9, or they strain the
/// softest deformation.
bool needs_filter(const SuperelementReport& report);

/// Note for the user that rigid motions were projected out of the stiffness.
std::string filter_note(const SuperelementReport& report, const std::string& where);

/// Projects the rigid motions R out of the stiffness: replaces S by Piᵀ S Pi with Pi = 1 − R R⁺. This removes small
/// forces that rigid motions cause.
void filter_rigid_motions(Superelement& element);

/// SHA-256 (hex) over dof table, names, positions, stiffness and mass as the file stores them.
std::string content_id(const Superelement& element);

/// Reads and checks a superelement file. Projects rigid motions out of S if needs_filter(). Throws Error that names
/// dataset, indices, value and meaning.
LoadedSuperelement read_superelement(const std::string& path);

/// Bytes of the superelement file. Checks the element first and fills element.content_id.
std::string superelement_image(const std::string& path, Superelement& element);

/// Checks the element, writes its file under a temporary name and renames it to `path`.
void write_superelement(const std::string& path, Superelement& element);

}  // namespace tisserand::formats
