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
  std::string frame_node;  ///< name of the node of FrameKind::node
  formats::InertiaOption inertia = formats::InertiaOption::B;
  formats::StiffeningOption stiffening = formats::StiffeningOption::off;
  bool double_curvature = false;                      ///< use the rows Λ_b of the companion, THEORY (83)
  const formats::Companion* companion = nullptr;      ///< data for inertia F, stiffening, load cases
  std::vector<std::string> load_cases;                ///< load cases in use, ascending
  std::optional<int> modes;                           ///< number of modes; absent: all in the file
  std::optional<double> cutoff;                       ///< highest frequency ω/2π of modes [1/time of the scene]
  std::vector<formats::NodeWeight> position_weights;  ///< empty: weights of THEORY (10)
  std::vector<formats::NodeWeight> rotation_weights;
  formats::Damping damping;
  UnitConversion units;  ///< conversion from the file to the scene
  std::string where;     ///< path of the body in the scene, for messages
};

/// Algorithm for the rotation R₀ of the floating frame from the nodes, THEORY (12) to (16). The first four use
/// rotations of nodes, as [Car00] (14)-(16). Where possible the Karcher mean replaces the incremental one. `polar` is
/// for nodes that have translations only.
enum class FrameAlgorithm {
  single_node,  ///< one node has all the rotation weight: R₀ = R_k
  pair,         ///< two rotation nodes: Karcher mean in closed form, R₀ = R₁ exp(α₂ log(R₁ᵀR₂))
  karcher,      ///< Karcher mean Σ αⱼ log(R₀ᵀRⱼ) = 0, iterated from a guess
  incremental,  ///< R₀ = R_ref exp(Σ αⱼ log(R_refᵀRⱼ)), THEORY (15)
  polar         ///< R₀ = argmin Σ wᵢ |R₀ᵀ(xᵢ − x̄) − Xᵢ|²
};

/// One boundary node: rows of its coordinates in the boundary vector, and its constants in the floating frame.
struct SuperelementNode {
  std::string name;
  int translation_row = -1;                           ///< first of three rows [x] (planar: two), -1: no translations
  int rotation_row = -1;                              ///< first of three rows [Θ] (planar: one), -1: no rotations
  double alpha = 0.0;                                 ///< weight of the position; sum over the nodes: 1
  double alpha_rotation = 0.0;                        ///< weight of the rotation; sum over the nodes: 1
  Eigen::Vector3d X = Eigen::Vector3d::Zero();        ///< undeformed position relative to x₀, THEORY (11)
  double polar_weight = 0.0;                          ///< w of THEORY (16), for FrameAlgorithm::polar
  Eigen::Vector3d X_polar = Eigen::Vector3d::Zero();  ///< X relative to the weighted mean Σ w X

  bool has_translation() const { return translation_row >= 0; }
  bool has_rotation() const { return rotation_row >= 0; }
};

/// Damping matrix D of the rates of deformation, THEORY (41): D = b S̄ + diag(2 ζ ω) on the internal coordinates + a
/// full matrix. The full matrix is a M̄ without the rigid motions, plus M̄ΦΔΦᵀM̄ with the elastic modes Φ of the free
/// body and Δ = diag(2 ζ ω). a and b are the mass and stiffness factors of the scene, ζ are damping ratios.
struct SuperelementDamping {
  double stiffness = 0.0;      ///< factor b of the stiffness [time]
  Eigen::VectorXd internal;    ///< (m): b ω² + 2 ζ ω of each internal mode
  Eigen::MatrixXd BB, BI, II;  ///< blocks of the full matrix; empty if it is zero
  Eigen::MatrixXd IB;          ///< BI transposed
  bool active = false;
  bool is_full() const { return BB.size() > 0; }
};

/// Load case of the companion file with the factor 1, in axes of the floating frame, THEORY (42). The body has nb
/// boundary and m internal coordinates y.
struct BodyLoadCase {
  std::string name;
  Eigen::VectorXd force;                             ///< (nb + m): forces f on the coordinates
  Eigen::MatrixXd stiffness;                         ///< (nb + m)²: stiffness K_L; empty without stiffening
  Eigen::Vector3d total = Eigen::Vector3d::Zero();   ///< resultant force F
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< moment about x₀ of the undeformed body
  Eigen::Matrix<double, 3, Eigen::Dynamic> arm;      ///< (3 x (nb + m)): derivative of the moment by y
};

/// Map from the coordinates of the body to those of its file: internal coordinates of the file are static_part
/// y_B + modal_part y_I.
struct FileCoordinates {
  std::vector<int> boundary_row;  ///< (nb): row in the file of each boundary coordinate
  std::vector<int> internal_row;  ///< rows of the internal coordinates in the file
  Eigen::MatrixXd static_part;    ///< −S_II⁻¹ S_IB of the matrices in the file
  Eigen::MatrixXd modal_part;     ///< kept modes in internal coordinates of the file, one column each
  Eigen::MatrixXd lift;           ///< planar bodies: matrix from y_B to boundary rows of the file
  Eigen::MatrixXd left_out;       ///< planar bodies: modes out of the plane, as in modal_part
};

/// Constants of a superelement body in canonical form, THEORY (7), in units of the scene. S_II is ascending. All uses
/// of one file with the same options share one SuperelementBody. Boundary coordinates are [x, Θ] per node, in the order
/// of the file; then m internal coordinates follow.
struct SuperelementBody {
  std::string name;  ///< name in the file
  /// Whether the body is planar (planar_body.hpp). A node of a planar body has two translations and one rotation in
  /// `axes` (of the part, z normal to the plane). Vectors of its frame have z = 0.
  bool planar = false;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  int translations() const { return planar ? 2 : 3; }  ///< number of translations of a node
  int rotations() const { return planar ? 1 : 3; }
  std::vector<SuperelementNode> node;
  int boundary_size = 0;  ///< nb: number of boundary coordinates
  int modes = 0;          ///< m: number of internal coordinates

  Eigen::MatrixXd S_BB;  ///< (nb x nb): stiffness of the boundary
  Eigen::MatrixXd M_BB;  ///< (nb x nb): mass of the boundary
  Eigen::MatrixXd M_BI;  ///< (nb x m): mass, boundary with internal coordinates
  Eigen::MatrixXd M_IB;  ///< (m x nb): M_BI transposed, so that products run along columns
  Eigen::VectorXd S_II;  ///< (m): ω² of the internal modes, boundary held
  SuperelementDamping damping;

  formats::InertiaOption inertia = formats::InertiaOption::B;
  FrameAlgorithm frame = FrameAlgorithm::pair;
  int frame_node = -1;                 ///< local node of FrameAlgorithm::single_node; −1: none
  std::vector<int> rotation_nodes;     ///< local nodes that own rotations
  std::vector<int> translation_nodes;  ///< local nodes that own translations

  Eigen::Vector3d reference_origin = Eigen::Vector3d::Zero();  ///< x₀ of the reference configuration, part frame
  double mass = 0.0;
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();  ///< undeformed, relative to x₀
  Eigen::Matrix<double, 3, Eigen::Dynamic> Gamma_B;          ///< Φ_TᵀM̄, boundary columns (3 x nb)
  Eigen::Matrix<double, 3, Eigen::Dynamic> Gamma_I;          ///< Φ_TᵀM̄, internal columns (3 x m)

  SecondOrder second_order;  ///< empty: linear strain, and inertia by M̄ alone
  std::vector<BodyLoadCase> load_cases;

  FileCoordinates file;
  std::vector<std::string> notes;  ///< messages for the user, whole sentences
};

/// One superelement of the mechanism: a use of a SuperelementBody on nodes of the model.
struct SuperelementUse {
  std::string name;
  int body = 0;              ///< index into Model::superelement_bodies
  std::vector<int> nodes;    ///< indices into Model::nodes, in the order of the body
  std::string companion_id;  ///< id of the companion whose terms or load cases it uses; empty: none
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
};

/// Unit of each coordinate of the body (nb + m), in which all have similar size. It is a length for translations, 1 for
/// rotations, and a length times the root of the mass for internal coordinates.
Eigen::VectorXd coordinate_units(const SuperelementBody& body);

/// Rigid motions of the body as columns ((nb + m) x 6): unit translations, then unit rotations about x₀. Rows of
/// internal coordinates are zero.
Eigen::MatrixXd rigid_columns(const SuperelementBody& body);

/// Elastic modes φ of the free reduced body, ascending. `force` holds their elastic forces f = S̄ φ, normalised by
/// φᵀS̄φ = 1. Then modal damping is M̄ΦΔΦᵀM̄ = Σ (2 ζ/ω) f fᵀ, with damping ratios ζ. Massless directions are omitted.
struct FreeModes {
  Eigen::VectorXd omega;  ///< (modes): angular frequency [rad/time]
  Eigen::MatrixXd force;  ///< ((nb + m) x modes)
};
/// Computes the elastic modes of the free reduced body. Throws Error at `where` if the body has motions without strain
/// other than the rigid ones.
FreeModes free_modes(const SuperelementBody& body, const std::string& where);

/// Sets body.damping from the options of the scene, THEORY (41). Throws Error if they are invalid.
void set_damping(const formats::Damping& given, const std::string& where, SuperelementBody& body);

/// Load cases of a companion in the coordinates of the body. `companion` is the result of companion_on_body(). They
/// have a `stiffness` if the body has stiffening.
std::vector<BodyLoadCase> make_load_cases(const SuperelementBody& body, const formats::Companion& companion);

/// Builds a superelement body from its file: brings it to canonical form by a congruence, selects modes, converts
/// units, computes weights. Poses of the nodes in the reference configuration are those of the file. `rigid`: rigid
/// properties of the file. Throws Error.
SuperelementBody build_superelement_body(const formats::Superelement& element, const formats::RigidProperties& rigid,
                                         const SuperelementOptions& options);

}  // namespace tisserand::mechanism
