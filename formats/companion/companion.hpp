// SPDX-License-Identifier: GPL-3.0-or-later
// The companion file *.companion.h5: terms beyond S̄ and M̄ in the equations of motion of a superelement. It names the
// superelement by content_id (formats/COMPANION.md).
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/superelement/superelement.hpp"

namespace tisserand::formats {

/// Largest number of coordinates n of a companion with H, which has n³ numbers.
inline constexpr int max_companion_size = 500;

/// Minor version of files that contain the second order of rotary inertia, in T and W.
inline constexpr int companion_version = 2;

/// Pairs jk of E and T in their order: xx, yy, zz, yz, xz, xy.
inline constexpr std::array<std::pair<int, int>, 6> axis_pairs{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

/// Index of the pair jk in axis_pairs, j and k in any order.
constexpr int axis_pair(int j, int k) { return j == k ? j : 6 - j - k; }
static_assert(axis_pair(1, 2) == 3 && axis_pair(2, 0) == 4 && axis_pair(0, 1) == 5);

/// Distributed load (pressure, line load, body force) on the coordinates y of the superelement. Its work along y is
/// s (force . y + ½ yᵀ stiffness y) for the factor s. Both parts are optional (size 0).
struct LoadCase {
  std::string name;
  Eigen::VectorXd force;      ///< n: Φᵀ f [energy / y_k]
  Eigen::MatrixXd stiffness;  ///< n x n, symmetric: −Φᵀ K_G[K_II⁻¹ f] Φ [energy / (y_k y_l)]
};

/// Contents of a companion file. Rows and columns: the n coordinates y of the superelement, in its order. Φ: finite
/// element displacements per coordinate. M: their mass matrix. [e_k x]: on translations and rotations of every node.
/// D_a: six rigid motions about the reference point. K_G[w]: geometric stiffness for the stress of w.
struct Companion {
  std::string content_id;    ///< content_id of the superelement
  std::string companion_id;  ///< SHA-256 (hex) of the contents; filled by read and write
  std::string producer;      ///< program and version
  Units units;               ///< units of the superelement file
  Eigen::Vector3d reference_point = Eigen::Vector3d::Zero();  ///< Σ weights X, part frame; reference of S0, N and T
  Eigen::VectorXd weights;                                    ///< nB: α of the boundary nodes, sum 1

  double mass = 0.0;
  Eigen::Vector3d S0 = Eigen::Vector3d::Zero();  ///< ∫ρ (X − reference_point)
  Eigen::Matrix3Xd S1;                           ///< 3 x n: D_Tᵀ M Φ, momentum of each coordinate
  std::vector<Eigen::MatrixXd> H;                ///< n of n x n: Φᵀ K_G[Φ_j] Φ, symmetric
  std::array<Eigen::MatrixXd, 3> C;              ///< n x n: Φᵀ M [e_k x] Φ of the finite elements
  std::array<Eigen::MatrixXd, 6> E;              ///< n x n, pairs jk: ½ ([e_j x]Φ)ᵀ M [e_k x]Φ + transpose
  std::array<Eigen::MatrixXd, 6> N;              ///< n x n, a: ½ yᵀ N_a y = D_aᵀ M w₂(y), symmetric
  /// n x n, pairs jk: ½ yᵀ T_jk y = sym_jk [D_(3+j)ᵀ M [e_k x] w₂(y) + ½ Σ (J e_j)·(θ x (θ x e_k))], summed over all
  /// rotary inertias J, which turn by θ(y)
  std::array<Eigen::MatrixXd, 6> T;

  /// n x n, antisymmetric: ẏᵀ W_k y = −½ Σ (J e_k)·(θ x θ̇), the second order of relative angular velocities. Size 0
  /// if no mass has rotary inertia, and in files before version 1.2
  std::array<Eigen::MatrixXd, 3> W;

  /// n x n, symmetric: ½ Σ_b (½ yᵀ Λ_b y)² is the energy of the membrane stress that bending traps (THEORY (83)). Empty
  /// if unknown
  std::vector<Eigen::MatrixXd> Lambda;

  std::vector<LoadCase> load_cases;  ///< ascending names

  int minor_version = companion_version;  ///< minor version of the file that was read

  /// False if the file holds load cases only.
  bool has_second_order() const { return !H.empty(); }
  bool has_relative_turns() const { return W[0].rows() > 0; }
};

/// "part.superelement.h5" -> "part.companion.h5". In other names ".companion.h5" replaces ".h5" or is appended.
std::string companion_path(const std::string& superelement_file);

/// Checks all rules of COMPANION.md against the superelement. `where`: file name in messages. Throws Error.
void check(const Companion& companion, const Superelement& superelement, const std::string& where);

/// Rotary inertia that a file before version 1.2 lacks: no second order in T, no W.
struct MissingTurns {
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();  ///< about each axis of the part, missing in T
  Eigen::Vector3d share = Eigen::Vector3d::Zero();    ///< its ratio to the part's inertia about the reference point
};

/// Rotary inertia missing in the file. The energy of the part turned by θ against its frame is known from M̄:
///   ½ (Ω x θ)ᵀ J₀ (Ω x θ) + ½ (J₀ Ω)·(θ x (θ x Ω)), J₀ = R_RᵀM̄R_R
/// The result is the energy by E, T and C less this. It is zero up to round-off for complete files, for masses without
/// rotary inertia, and for shapes whose mass turns with them. Call it before other operations.
MissingTurns missing_turns(const Companion& companion, const Superelement& superelement);

/// SHA-256 of the contents as COMPANION.md defines it.
std::string companion_id(const Companion& companion);

/// Reads and checks a file. Throws Error that names dataset, indices, value and meaning.
Companion read_companion(const std::string& path, const Superelement& superelement);

/// Checks, fills companion_id and returns the bytes of the file. Arrays are compressed and have checksums.
std::string companion_image(const std::string& path, Companion& companion, const Superelement& superelement);

/// Writes the file under a temporary name and renames it, after the steps of companion_image().
void write_companion(const std::string& path, Companion& companion, const Superelement& superelement);

}  // namespace tisserand::formats
