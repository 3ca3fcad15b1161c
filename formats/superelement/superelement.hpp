// The superelement file *.superelement.h5: the only contract between the two stages (formats/SUPERELEMENT.md).
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"

namespace tisserand::formats {

/// Reduced stiffness and mass and what names their rows. n coordinates, nB boundary nodes; any order of rows.
struct Superelement {
  std::string name;
  std::string method;    ///< "craig_bampton", "guyan", ... free text for the reader, no meaning to the numerics
  std::string producer;  ///< program and version
  Units units;
  std::string content_id;  ///< SHA-256 (hex); filled by read and by write

  std::vector<std::string> node_name;                      ///< nB, unique
  Eigen::Matrix<double, Eigen::Dynamic, 3> node_position;  ///< nB x 3, part frame
  std::vector<int> dof_node;                               ///< n; row of the boundary node, -1: internal coordinate
  std::vector<int> dof_component;                          ///< n; 0-2 translations, 3-5 rotations; internal: its number
  Eigen::MatrixXd stiffness;                               ///< n x n, S̄
  Eigen::MatrixXd mass;                                    ///< n x n, M̄

  Eigen::Index size() const { return static_cast<Eigen::Index>(dof_node.size()); }
};

/// Mass, centre of mass and inertia about it (part frame) that M̄ represents: [Car00] 3.1 step 1, from the rigid
/// motions.
struct RigidProperties {
  double mass = 0.0;
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/// What check() measured. Warnings are whole sentences.
struct SuperelementReport {
  double characteristic_length = 1.0;  ///< l = max distance of a node from the mean of the nodes (1 if 0)
  double rigid_residual = 0.0;         ///< max |S R| / (max |S|), rotations scaled with the characteristic length
  double rigid_change = 0.0;           ///< of the softest deformation by that residual (rigid_strain.hpp); 0: round-off
  std::string rounding;                ///< "10 digits", "single precision": what entries of S have; empty: double
  bool filtered = false;               ///< read_superelement() has projected the rigid motions out of S̄
  RigidProperties rigid;
  std::vector<std::string> warnings;
};

struct LoadedSuperelement {
  Superelement superelement;
  SuperelementReport report;
};

/// The six rigid motions on the rows of `element` (n x 6): unit translations, then (e_k x X_a, e_k) about the part
/// origin shifted to `origin`; zero in the internal coordinates.
Eigen::MatrixXd rigid_motions(const Superelement& element, const Eigen::Vector3d& origin);

/// From M̄ alone.
RigidProperties rigid_properties(const Superelement& element);

struct EntryErrors;

/// All that SUPERELEMENT.md demands. `where` is the file name in messages. Throws Error. `errors` are those of the
/// entries of S; without them its digits are counted, which a turn of axes before this would have hidden.
SuperelementReport check(const Superelement& element, const std::string& where);
SuperelementReport check(const Superelement& element, const std::string& where, const EntryErrors& errors);

/// Whether rigid motions are to be projected out of S: residual above 1e-9, or felt by the softest deformation.
bool needs_filter(const SuperelementReport& report);

/// The sentence for the user once that was done.
std::string filter_note(const SuperelementReport& report, const std::string& where);

/// S <- Piᵀ S Pi with Pi = 1 − R R⁺: removes a small rigid-mode residual.
void filter_rigid_motions(Superelement& element);

/// SHA-256 over dof table, names, positions, S, M as stored.
std::string content_id(const Superelement& element);

/// Reads, checks and (needs_filter()) filters. Throws Error naming dataset, indices, value and meaning.
LoadedSuperelement read_superelement(const std::string& path);

/// Checks, fills element.content_id and returns the bytes of the file.
std::string superelement_image(const std::string& path, Superelement& element);

/// The same, written beside and renamed.
void write_superelement(const std::string& path, Superelement& element);

}  // namespace tisserand::formats
