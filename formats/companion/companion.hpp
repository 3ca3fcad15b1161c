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

/// Largest number of coordinates n of a companion file with the array H, which has n³ numbers.
inline constexpr int max_companion_size = 500;

/// Minor version of files whose arrays T and W contain the second order of rotary inertia.
inline constexpr int companion_version = 2;

/// Pairs jk of axes in the order of the arrays E and T: xx, yy, zz, yz, xz, xy.
inline constexpr std::array<std::pair<int, int>, 6> axis_pairs{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

/// Index in axis_pairs of the pair of the axes j and k, in any order.
constexpr int axis_pair(int j, int k) { return j == k ? j : 6 - j - k; }
static_assert(axis_pair(1, 2) == 3 && axis_pair(2, 0) == 4 && axis_pair(0, 1) == 5);

/// Load case: a distributed load (pressure, line load, body force) on the coordinates y of the superelement. Its work
/// along y is s (force . y + ½ yᵀ stiffness y) for the factor s. `force` and `stiffness` are optional (size 0).
struct LoadCase {
  std::string name;
  Eigen::VectorXd force;      ///< (n) Φᵀ f for the nodal forces f of the load [energy / y_k]
  Eigen::MatrixXd stiffness;  ///< (n x n) −Φᵀ K_G[K_II⁻¹ f] Φ, symmetric [energy / (y_k y_l)]
};

/// Contents of a companion file. Rows and columns belong to the n coordinates y of the superelement, in its order. Φ:
/// finite element displacements per coordinate. M: mass matrix of the finite elements. [e_k x]: cross product with axis
/// k, on translations and rotations of every node. D_a: six rigid motions about the reference point, D_T the first
/// three. K_G[w]: geometric stiffness for the stress of the displacement w. w₂(y): second-order displacement.
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
  /// n x n, pairs jk: ½ yᵀ T_jk y = sym_jk [D_(3+j)ᵀ M [e_k x] w₂(y) + ½ Σ (J e_j)·(θ x (θ x e_k))], with the sum over
  /// all rotary inertias J, which rotate by θ(y).
  std::array<Eigen::MatrixXd, 6> T;

  /// n x n, antisymmetric: ẏᵀ W_k y = −½ Σ (J e_k)·(θ x θ̇), summed over all rotary inertias J, which rotate by θ(y).
  /// It is the second order of relative angular velocities. Size 0 if no mass has rotary inertia, and in files before
  /// version 1.2.
  std::array<Eigen::MatrixXd, 3> W;

  /// Λ_b (n x n, symmetric): ½ Σ_b (½ yᵀ Λ_b y)² is the energy of the membrane stress that bending traps (THEORY (83)).
  /// Empty if unknown.
  std::vector<Eigen::MatrixXd> Lambda;

  std::vector<LoadCase> load_cases;  ///< ascending names

  int minor_version = companion_version;  ///< minor version of the file that was read

  /// Whether the file has the arrays H to W; false if it holds load cases only.
  bool has_second_order() const { return !H.empty(); }
  bool has_relative_turns() const { return W[0].rows() > 0; }
};

/// Name of the companion file: "part.superelement.h5" -> "part.companion.h5". In other names ".companion.h5" replaces
/// ".h5" or is appended.
std::string companion_path(const std::string& superelement_file);

/// Checks all rules of COMPANION.md for a companion and its superelement. `where`: file name in messages. Throws Error.
void check(const Companion& companion, const Superelement& superelement, const std::string& where);

/// Rotary inertia that a companion file before version 1.2 lacks: it has no second order of rotary inertia in T, and no
/// W.
struct MissingTurns {
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();  ///< moment of inertia about each axis of the part, missing in T
  Eigen::Vector3d share =
      Eigen::Vector3d::Zero();  ///< ratio of `inertia` to the part's inertia about the reference point
};

/// Rotary inertia missing in a companion file. For the angular velocity Ω, the energy of the part rotated by θ relative
/// to its frame is known from M̄ and its rigid rotations R_R:
///   ½ (Ω x θ)ᵀ J₀ (Ω x θ) + ½ (J₀ Ω)·(θ x (θ x Ω)), J₀ = R_RᵀM̄R_R
/// The result is the energy by E, T and C less this known energy. It is zero up to round-off for complete files, for
/// masses without rotary inertia, and for shapes whose mass rotates with them. Requires a companion as read, before the
/// functions of operations.hpp change it.
MissingTurns missing_turns(const Companion& companion, const Superelement& superelement);

/// SHA-256 (hex) of the contents of a companion file, as COMPANION.md defines it.
std::string companion_id(const Companion& companion);

/// Reads a companion file and checks it against its superelement. Throws Error that names dataset, indices, value and
/// meaning.
Companion read_companion(const std::string& path, const Superelement& superelement);

/// Bytes of the companion file. Checks the companion first and fills companion_id. Arrays are compressed and have
/// checksums.
std::string companion_image(const std::string& path, Companion& companion, const Superelement& superelement);

/// Checks the companion, fills companion_id, writes the file under a temporary name and renames it to `path`.
void write_companion(const std::string& path, Companion& companion, const Superelement& superelement);

}  // namespace tisserand::formats
