// SPDX-License-Identifier: GPL-3.0-or-later
// The superelement file *.superelement.h5, the interface between the two programs (formats/SUPERELEMENT.md).
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"

namespace tisserand::formats {

/// Reduced stiffness and mass with the meaning of their rows. n coordinates, nB boundary nodes, any order of rows.
struct Superelement {
  std::string name;
  std::string method;    ///< "craig_bampton", "guyan", ...: information without effect on computations
  std::string producer;  ///< program and version
  Units units;
  std::string content_id;  ///< SHA-256 (hex); filled by read and write

  std::vector<std::string> node_name;                      ///< nB, unique
  Eigen::Matrix<double, Eigen::Dynamic, 3> node_position;  ///< nB x 3, part frame
  std::vector<int> dof_node;                               ///< n: row of the boundary node, −1: internal coordinate
  std::vector<int> dof_component;                          ///< n; 0-2 translations, 3-5 rotations; internal: its number
  Eigen::MatrixXd stiffness;                               ///< n x n, S̄
  Eigen::MatrixXd mass;                                    ///< n x n, M̄

  Eigen::Index size() const { return static_cast<Eigen::Index>(dof_node.size()); }
};

/// Mass, centre of mass and inertia about it (part frame) of M̄, from the rigid motions ([Car00] 3.1 step 1).
struct RigidProperties {
  double mass = 0.0;
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/// Measurements of check(). Warnings are sentences.
struct SuperelementReport {
  double characteristic_length = 1.0;  ///< l = max distance of a node from the mean of the nodes (1 if 0)
  double rigid_residual = 0.0;         ///< max |S R| / (max |S|), rotations scaled with the characteristic length
  double rigid_change = 0.0;           ///< RigidStrain::change of that residual (rigid_strain.hpp); 0: round-off
  std::string rounding;                ///< "10 digits", "single precision" of entries of S; empty: double
  bool filtered = false;               ///< whether read_superelement() projected rigid motions out of S̄
  RigidProperties rigid;
  std::vector<std::string> warnings;
};

struct LoadedSuperelement {
  Superelement superelement;
  SuperelementReport report;
};

/// Six rigid motions on the rows of `element` (n x 6): unit translations, then (e_k x X_a, e_k) with X_a from `origin`.
/// Zero in internal coordinates. See THEORY (8).
Eigen::MatrixXd rigid_motions(const Superelement& element, const Eigen::Vector3d& origin);

/// Rigid properties from M̄ alone.
RigidProperties rigid_properties(const Superelement& element);

struct EntryErrors;

/// Checks all rules of SUPERELEMENT.md. `where`: file name in messages. `errors`: errors of entries of S. Without them
/// digits of S are counted, which fails if its axes were rotated before. Throws Error.
SuperelementReport check(const Superelement& element, const std::string& where);
SuperelementReport check(const Superelement& element, const std::string& where, const EntryErrors& errors);

/// Whether rigid motions must be projected out of S: residual above 1e-9, or strain of the softest deformation.
bool needs_filter(const SuperelementReport& report);

/// Note for the user after the projection.
std::string filter_note(const SuperelementReport& report, const std::string& where);

/// Replaces S by Piᵀ S Pi with Pi = 1 − R R⁺, which removes a small rigid-body residual.
void filter_rigid_motions(Superelement& element);

/// SHA-256 over dof table, names, positions, S and M as stored.
std::string content_id(const Superelement& element);

/// Reads, checks and, if needs_filter(), filters. Throws Error that names dataset, indices, value and meaning.
LoadedSuperelement read_superelement(const std::string& path);

/// Checks, fills element.content_id and returns the bytes of the file.
std::string superelement_image(const std::string& path, Superelement& element);

/// Checks, writes the file under a temporary name and renames it.
void write_superelement(const std::string& path, Superelement& element);

}  // namespace tisserand::formats
