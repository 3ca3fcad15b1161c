// SPDX-License-Identifier: GPL-3.0-or-later
// The modal body file *.modal.h5: lumped masses, modes and inertia integrals of a floating-frame body
// (formats/MODAL_BODY.md, [GA00] (1)-(16)).
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"

namespace tisserand::formats {

/// Inertia integrals of a modal body, as sums over all its nodes with masses m, inertias μ and positions x. Xd and Xt
/// (3 x modes) are the translations and rotations of the modes at the node; index j names a mode.
struct ModalIntegrals {
  double mass = 0.0;                             ///< Σ m
  Eigen::Vector3d c0 = Eigen::Vector3d::Zero();  ///< Σ m x
  Eigen::Matrix3Xd C1;                           ///< Σ m Xd
  Eigen::Matrix3d P0 = Eigen::Matrix3d::Zero();  ///< Σ m x xᵀ
  Eigen::VectorXd P1;                            ///< (9 · modes) block j is Σ m x Xd_jᵀ, column by column
  /// (9 · modes x modes) block j of column i is Σ m Xd_i Xd_jᵀ, column by column.
  Eigen::MatrixXd P2;
  Eigen::Matrix3d J_mu = Eigen::Matrix3d::Zero();  ///< Σ μ
  Eigen::Matrix3Xd N_mu;                           ///< Σ μ Xt
};

enum class ModalReference { nodes, mean_axis };

/// Residual flexibility of a modal body: static displacements K⁺ p − Φ ω⁻² Φᵀ p, relative to the reference node, under
/// unit forces p at components of some nodes. There are f of them. K: stiffness matrix; Φ: modes; ω: their frequencies.
struct ModalResidual {
  std::vector<int> node;        ///< (f) rows of node_name
  std::vector<int> component;   ///< (f) 0-2 translations, 3-5 rotations, axes of the body frame
  Eigen::MatrixXd flexibility;  ///< (f x f) fᵀ w
  Eigen::MatrixXd mass;         ///< (f x f) wᵀ M w
  Eigen::MatrixXd coupling;     ///< (6 x f) Rᵀ M w for the rigid motions R about the origin of the frame
};

/// Modal body with n nodes and m modes. Vectors are in axes of the body frame. Modes are mass-normalised (unit of modal
/// coordinates: √mass length).
struct ModalBody {
  std::string name;
  std::string producer;  ///< program and version
  Units units;
  Eigen::Vector3d frame_position = Eigen::Vector3d::Zero();      ///< body frame in the part frame
  Eigen::Vector4d frame_orientation = Eigen::Vector4d::Unit(0);  ///< w x y z
  bool all_nodes = true;  ///< true: all nodes with mass are listed; false: only some, and the integrals are not checked
  ModalReference reference = ModalReference::nodes;
  std::vector<int> reference_node;       ///< 6 for ModalReference::nodes
  std::vector<int> reference_component;  ///< 0-2 translations, 3-5 rotations

  std::vector<std::string> node_name;                       ///< n, unique
  Eigen::Matrix<double, Eigen::Dynamic, 3> node_position;   ///< n x 3
  Eigen::VectorXd node_mass;                                ///< n
  std::vector<Eigen::Matrix3d> node_inertia;                ///< n
  std::vector<Eigen::Matrix<double, 6, Eigen::Dynamic>> X;  ///< n: translations and rotations of the modes
  Eigen::VectorXd omega2;                                   ///< m, ascending
  Eigen::VectorXd zeta;                                     ///< m, ratios of critical damping
  ModalIntegrals integrals;
  ModalResidual residual;  ///< since version 1.1; without components if the file has none

  Eigen::Index modes() const { return omega2.size(); }
};

/// SHA-256 (hex) of the modes and nodes of a modal body, by which recovery and results files refer to it.
std::string content_id(const ModalBody& body);

/// Inertia integrals computed from the listed nodes of a modal body.
ModalIntegrals integrals_of(const ModalBody& body);

/// Checks all rules of MODAL_BODY.md. Returns warnings as sentences. `where`: file name in messages. Throws Error.
std::vector<std::string> check(const ModalBody& body, const std::string& where);

/// Modal body that was read from a file, with the warnings of its checks.
struct LoadedModalBody {
  ModalBody body;
  std::vector<std::string> warnings;
};

/// Reads and checks a modal body file. Throws Error that names dataset, indices, value and meaning.
LoadedModalBody read_modal_body(const std::string& path);

/// Bytes of the modal body file. Checks the body first.
std::string modal_body_image(const std::string& path, const ModalBody& body);

/// Checks the body, writes its file under a temporary name and renames it to `path`.
void write_modal_body(const std::string& path, const ModalBody& body);

}  // namespace tisserand::formats
