// The companion file *.companion.h5: what goes beyond S̄ and M̄ in the equations of motion of a superelement, tied to it
// by its content_id (formats/COMPANION.md).
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/superelement/superelement.hpp"

namespace tisserand::formats {

/// Coordinates n of a companion with H, which has n³ numbers.
inline constexpr int max_companion_size = 500;

/// Minor version of files that hold the second order of rotary inertia, in T and W.
inline constexpr int companion_version = 2;

/// The pairs jk of E and T in their order: xx, yy, zz, yz, xz, xy.
inline constexpr std::array<std::pair<int, int>, 6> axis_pairs{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

/// Index of the pair jk in axis_pairs, j and k in any order.
constexpr int axis_pair(int j, int k) { return j == k ? j : 6 - j - k; }
static_assert(axis_pair(1, 2) == 3 && axis_pair(2, 0) == 4 && axis_pair(0, 1) == 5);

/// A distributed load (pressure, line load, body force) on the coordinates y of the superelement: its work along a
/// motion y is s (force . y + ½ yᵀ stiffness y) for the factor s. Both parts are optional (size 0).
struct LoadCase {
  std::string name;
  Eigen::VectorXd force;      ///< n: Φᵀ f [energy / y_k]
  Eigen::MatrixXd stiffness;  ///< n x n, symmetric: −Φᵀ K_G[K_II⁻¹ f] Φ [energy / (y_k y_l)]
};

/// Rows and columns: the coordinates y of the superelement (n), in the order of its rows. Φ: displacement of the finite
/// elements for each coordinate, M their mass matrix, [e_k x]: on the translations and on the rotations of every node,
/// D_a: their six rigid motions about the reference point, K_G[w]: geometric stiffness for the stress of w.
struct Companion {
  std::string content_id;    ///< of the superelement that it belongs to
  std::string companion_id;  ///< SHA-256 (hex) of its own contents; filled by read and by write
  std::string producer;      ///< program and version
  Units units;               ///< those of the superelement file
  Eigen::Vector3d reference_point = Eigen::Vector3d::Zero();  ///< Σ weights X, part frame: what S0, N and T refer to
  Eigen::VectorXd weights;                                    ///< nB: α of the boundary nodes, sum 1

  double mass = 0.0;
  Eigen::Vector3d S0 = Eigen::Vector3d::Zero();  ///< ∫ρ (X − reference_point)
  Eigen::Matrix3Xd S1;                           ///< 3 x n: D_Tᵀ M Φ, the momentum of each coordinate
  std::vector<Eigen::MatrixXd> H;                ///< n of n x n: Φᵀ K_G[Φ_j] Φ, symmetric
  std::array<Eigen::MatrixXd, 3> C;              ///< n x n: Φᵀ M [e_k x] Φ, as the finite elements give it
  std::array<Eigen::MatrixXd, 6> E;              ///< n x n, pairs jk: ½ ([e_j x]Φ)ᵀ M [e_k x]Φ + transpose
  std::array<Eigen::MatrixXd, 6> N;              ///< n x n, a: ½ yᵀ N_a y = D_aᵀ M w₂(y), symmetric
  /// n x n, pairs jk: ½ yᵀ T_jk y = sym_jk [D_(3+j)ᵀ M [e_k x] w₂(y) + ½ Σ (J e_j)·(θ x (θ x e_k))], the sum over all
  /// rotary inertia J that turns by θ(y)
  std::array<Eigen::MatrixXd, 6> T;

  /// n x n, antisymmetric: ẏᵀ W_k y = −½ Σ (J e_k)·(θ x θ̇), the second order of relative angular velocities; without
  /// rows where no mass has rotary inertia, and in files before version 1.2
  std::array<Eigen::MatrixXd, 3> W;

  /// n x n, symmetric: ½ Σ_b (½ yᵀ Λ_b y)² is the energy of membrane stress that bending traps, which no motion of the
  /// elements relaxes; empty: not known
  std::vector<Eigen::MatrixXd> Lambda;

  std::vector<LoadCase> load_cases;  ///< ascending names

  int minor_version = companion_version;  ///< of the file that it was read from

  /// False: the file holds load cases only.
  bool has_second_order() const { return !H.empty(); }
  bool has_relative_turns() const { return W[0].rows() > 0; }
};

/// "part.superelement.h5" -> "part.companion.h5"; of another name: ".companion.h5" in place of its ".h5", or appended.
std::string companion_path(const std::string& superelement_file);

/// All that COMPANION.md demands, for the superelement that it belongs to. `where` is the file name in messages. Throws
/// Error.
void check(const Companion& companion, const Superelement& superelement, const std::string& where);

/// What a file before version 1.2 lacks: T holds no second order of rotary inertia, and there is no W.
struct MissingTurns {
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();  ///< about each axis of the part: rotary inertia that T lacks
  Eigen::Vector3d share = Eigen::Vector3d::Zero();    ///< of the inertia of the part about the reference point
};

/// From the energy of the part turned by θ against its frame, which is known from M̄:
///   ½ (Ω x θ)ᵀ J₀ (Ω x θ) + ½ (J₀ Ω)·(θ x (θ x Ω)), J₀ = R_RᵀM̄R_R
/// less that of E, T and C. Zero but for round-off of complete files, of masses without rotary inertia, and of shapes
/// whose mass turns with them. Before other operations.
MissingTurns missing_turns(const Companion& companion, const Superelement& superelement);

/// SHA-256 of the contents as COMPANION.md defines it.
std::string companion_id(const Companion& companion);

/// Reads and checks. Throws Error naming dataset, indices, value and meaning.
Companion read_companion(const std::string& path, const Superelement& superelement);

/// Checks, fills companion_id and returns the bytes of the file; arrays compressed and with checksums.
std::string companion_image(const std::string& path, Companion& companion, const Superelement& superelement);

/// The same, written beside and renamed.
void write_companion(const std::string& path, Companion& companion, const Superelement& superelement);

}  // namespace tisserand::formats
