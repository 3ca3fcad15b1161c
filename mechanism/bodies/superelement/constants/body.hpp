// SPDX-License-Identifier: GPL-3.0-or-later
// The superelement as a body of the mechanism: constants built once from the file, which the Model holds, and its uses.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/scene/scene.hpp"
#include "formats/superelement/superelement.hpp"
#include "mechanism/bodies/superelement/constants/second_order.hpp"

namespace tisserand::mechanism {

/// Options of the scene for one use of a superelement file.
struct SuperelementOptions {
  formats::FrameKind frame = formats::FrameKind::karcher;
  std::string frame_node;  ///< for FrameKind::node
  formats::InertiaOption inertia = formats::InertiaOption::B;
  formats::StiffeningOption stiffening = formats::StiffeningOption::off;
  bool double_curvature = false;                      ///< use the rows Λ of the companion
  const formats::Companion* companion = nullptr;      ///< for inertia F, stiffening and load cases
  std::vector<std::string> load_cases;                ///< load cases in use, ascending
  std::optional<int> modes;                           ///< number of modes; absent: all in the file
  std::optional<double> cutoff;                       ///< frequency ω/2π [1/time of the scene]
  std::vector<formats::NodeWeight> position_weights;  ///< empty: weights follow from the centre of mass
  std::vector<formats::NodeWeight> rotation_weights;
  formats::Damping damping;
  UnitConversion units;  ///< file -> scene
  std::string where;     ///< path of the body in the scene, for messages
};

/// Algorithm for R₀ from the nodes: THEORY (12) to (16). The first four are [Car00] (14)-(16); where possible the
/// Karcher mean replaces the incremental one. `polar` is for nodes that have translations only.
enum class FrameAlgorithm {
  single_node,  ///< one node has all the rotation weight: R₀ = R_k
  pair,         ///< two rotation nodes: Karcher mean in closed form, R₀ = R₁ exp(α₂ log(R₁ᵀR₂))
  karcher,      ///< Σ αⱼ log(R₀ᵀRⱼ) = 0, iterated from a guess
  incremental,  ///< R₀ = R_ref exp(Σ αⱼ log(R_refᵀRⱼ)), [Car00] (16)
  polar         ///< R₀ = argmin Σ wᵢ |R₀ᵀ(xᵢ − x̄) − Xᵢ|²
};

/// One boundary node: rows of its coordinates in the boundary vector, and its constants in the floating frame.
struct SuperelementNode {
  std::string name;
  int translation_row = -1;                           ///< first of three rows [x] (planar: two), -1: no translations
  int rotation_row = -1;                              ///< first of three rows [Θ] (planar: one), -1: no rotations
  double alpha = 0.0;                                 ///< weight of the position, Σ = 1
  double alpha_rotation = 0.0;                        ///< weight of the rotation, Σ = 1
  Eigen::Vector3d X = Eigen::Vector3d::Zero();        ///< reference position relative to x₀ = Σ αⱼ Xⱼ
  double polar_weight = 0.0;                          ///< w of FrameAlgorithm::polar
  Eigen::Vector3d X_polar = Eigen::Vector3d::Zero();  ///< X relative to Σ w X

  bool has_translation() const { return translation_row >= 0; }
  bool has_rotation() const { return rotation_row >= 0; }
};

/// Damping of the deformation rates, THEORY (41): D = b S̄ + diag(2 ζ ω) on the internal coordinates + a full matrix.
/// The full matrix (damping.cpp) is a M̄ without the rigid motions, plus M̄ΦΔΦᵀM̄ with the elastic modes Φ of the free
/// body and Δ = diag(2 ζ ω).
struct SuperelementDamping {
  double stiffness = 0.0;      ///< b [time]
  Eigen::VectorXd internal;    ///< m: b ω² + 2 ζ ω of the internal modes
  Eigen::MatrixXd BB, BI, II;  ///< full matrix; empty if there is none
  Eigen::MatrixXd IB;          ///< BI transposed
  bool active = false;
  bool is_full() const { return BB.size() > 0; }
};

/// Load case of the companion file with the factor 1, in axes of the frame (load_cases.hpp).
struct BodyLoadCase {
  std::string name;
  Eigen::VectorXd force;                             ///< nb + m: f
  Eigen::MatrixXd stiffness;                         ///< (nb + m)²: K; empty without stiffening
  Eigen::Vector3d total = Eigen::Vector3d::Zero();   ///< resultant
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< moment about x₀, undeformed
  Eigen::Matrix<double, 3, Eigen::Dynamic> arm;      ///< 3 x (nb + m): ∂(moment)/∂y
};

/// Map from the coordinates of the body to those of the file: y_I(file) = static_part y_B + modal_part y_I.
struct FileCoordinates {
  std::vector<int> boundary_row;  ///< nb: row in the file of each boundary coordinate
  std::vector<int> internal_row;  ///< rows of the internal coordinates in the file
  Eigen::MatrixXd static_part;    ///< −S_II⁻¹ S_IB
  Eigen::MatrixXd modal_part;     ///< Q, only of the kept modes
  Eigen::MatrixXd lift;           ///< of planar bodies: boundary rows of the file from the boundary coordinates
  Eigen::MatrixXd left_out;       ///< of planar bodies: Q of the modes out of the plane
};

/// Superelement in canonical form, THEORY (7) with S_II ascending, in units of the scene. All uses of one file with the
/// same options share these constants. Boundary coordinates: per node [x, Θ], nodes in the order of the file; then m
/// internal coordinates.
struct SuperelementBody {
  std::string name;  ///< name in the file
  /// Whether the body is planar (planar_body.hpp). It then has two translations and one rotation per node in `axes` of
  /// the part, z normal to the plane, and vectors of the frame have z = 0.
  bool planar = false;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  int translations() const { return planar ? 2 : 3; }  ///< number of translations of a node
  int rotations() const { return planar ? 1 : 3; }
  std::vector<SuperelementNode> node;
  int boundary_size = 0;  ///< nb
  int modes = 0;          ///< m

  Eigen::MatrixXd S_BB;  ///< nb x nb
  Eigen::MatrixXd M_BB;  ///< nb x nb
  Eigen::MatrixXd M_BI;  ///< nb x m
  Eigen::MatrixXd M_IB;  ///< m x nb, M_BI transposed: both products run along columns
  Eigen::VectorXd S_II;  ///< m, ω² of the internal modes (boundary held)
  SuperelementDamping damping;

  formats::InertiaOption inertia = formats::InertiaOption::B;
  FrameAlgorithm frame = FrameAlgorithm::pair;
  int frame_node = -1;                 ///< local node of FrameAlgorithm::single_node; −1: none
  std::vector<int> rotation_nodes;     ///< local nodes that own rotations
  std::vector<int> translation_nodes;  ///< local nodes that own translations

  Eigen::Vector3d reference_origin = Eigen::Vector3d::Zero();  ///< x₀ of the reference configuration, part frame
  double mass = 0.0;
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();  ///< relative to x₀
  Eigen::Matrix<double, 3, Eigen::Dynamic> Gamma_B;          ///< Φ_TᵀM̄, boundary columns (3 x nb)
  Eigen::Matrix<double, 3, Eigen::Dynamic> Gamma_I;          ///< Φ_TᵀM̄, internal columns (3 x m)

  SecondOrder second_order;  ///< without terms: linear strain, inertia by M̄ alone
  std::vector<BodyLoadCase> load_cases;

  FileCoordinates file;
  std::vector<std::string> notes;  ///< messages for the user, whole sentences
};

/// One superelement of the mechanism.
struct SuperelementUse {
  std::string name;
  int body = 0;              ///< index into the model's bodies
  std::vector<int> nodes;    ///< indices into the model's nodes, in the order of the body
  std::string companion_id;  ///< id of the companion whose terms or load cases it uses; empty: none
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
};

/// Units in which all coordinates have similar size: a length for translations, and a length times the root of the mass
/// for internal coordinates.
Eigen::VectorXd coordinate_units(const SuperelementBody& body);

/// Matrix (nb + m) x 6 of translations, and rotations about x₀. Internal coordinates are zero (canonical form).
Eigen::MatrixXd rigid_columns(const SuperelementBody& body);

/// Elastic modes of the free reduced body, ascending, and their elastic forces f = S̄ φ with φᵀS̄φ = 1, so that
/// M̄ΦΔΦᵀM̄ = Σ (2 ζ/ω) f fᵀ. Massless directions are omitted.
struct FreeModes {
  Eigen::VectorXd omega;  ///< [rad/time]
  Eigen::MatrixXd force;  ///< (nb + m) x modes
};
/// Computes the free modes. Throws Error (at `where`) if the body has other motions without strain than the rigid ones.
FreeModes free_modes(const SuperelementBody& body, const std::string& where);

/// Sets body.damping from the options of the scene, THEORY (41). Throws Error if they are invalid.
void set_damping(const formats::Damping& given, const std::string& where, SuperelementBody& body);

/// Load cases of a companion in the coordinates of the body (companion_on_body()), with `stiffness` if the body has
/// stiffening.
std::vector<BodyLoadCase> make_load_cases(const SuperelementBody& body, const formats::Companion& companion);

/// Builds a body: canonical form by congruence, selection of modes, conversion of units, weights. Node poses of the
/// reference configuration are those of the file. Throws Error.
SuperelementBody build_superelement_body(const formats::Superelement& element, const formats::RigidProperties& rigid,
                                         const SuperelementOptions& options);

}  // namespace tisserand::mechanism
