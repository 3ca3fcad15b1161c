// SPDX-License-Identifier: GPL-3.0-or-later
// The recovery file *.recovery.h5: mesh, shapes and stresses of a part, which turn the motion of its superelement into
// displacement and stress everywhere (formats/RECOVERY.md). Equations of motion never use it.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/math/count.hpp"
#include "common/units.hpp"
#include "formats/recovery/second_order.hpp"
#include "formats/superelement/superelement.hpp"

namespace tisserand::formats {

/// Shapes of elements. The file stores their numbers. Solids have the node order of gmsh.
enum class ElementShape : int {
  beam = 0,
  triangle = 1,
  quadrilateral = 2,
  tetrahedron4 = 3,
  tetrahedron10 = 4,
  hexahedron8 = 5,
  hexahedron20 = 6,
  prism6 = 7,
  prism15 = 8
};
inline constexpr int element_shapes = 9;
int node_count(ElementShape shape);

/// Section of a beam at one end, in the axes of the element and about the element's axis (the line between its ends).
struct RecoverySection {
  double area = 0.0;  ///< 0: section given by stiffness, which has forces but no stresses
  double second_moment_y = 0.0, second_moment_z = 0.0, second_moment_yz = 0.0;  ///< about the centroid
  double centroid_y = 0.0, centroid_z = 0.0;
  std::vector<Eigen::Vector2d> outline;  ///< (y, z) of the outer contour, counter-clockwise seen against x
  bool outline_known = false;            ///< false: outline of an equivalent rectangle or circle
};

/// Elements of the mesh: first beams, then shells, then solids.
struct RecoveryElements {
  std::vector<ElementShape> shape;
  std::vector<int> group;  ///< row of Recovery::group_name
  std::vector<int> id;     ///< number in the deck or in its group
  std::vector<int> first;  ///< elements + 1 indices into `node`
  std::vector<int> node;   ///< rows of Recovery::position

  int count() const { return count_of(shape); }
};

inline constexpr int inertia_loads = 12;  ///< six rigid accelerations, six products of angular velocities

/// Load on the interior of the part in addition to inertia loads: a load case, or a unit force or moment on a node of a
/// modal body.
struct AppliedLoad {
  std::string load_case;  ///< name; empty: a force on a node
  std::string node;       ///< name of the loaded node
  int component = 0;      ///< 0 to 2 forces, 3 to 5 moments, part axes
};

/// Loads whose static answers a recovery file holds, and the data to scale them. The answers are computed with the
/// boundary held, less the share of the internal coordinates (THEORY (95)): what the basis misses in displacement and
/// stress. The inertia loads are M D_a for accelerations (3) and angular accelerations (3) of the reference point, then
/// those of products ω_j ω_k of angular velocities, jk = xx yy zz yz xz xy (g_a, g_jk of THEORY (94)). M is the mass
/// matrix, D_a are rigid motions about the reference point.
struct RecoveryLoads {
  Eigen::Vector3d reference_point = Eigen::Vector3d::Zero();  ///< part frame
  std::vector<AppliedLoad> applied;  ///< loads whose columns follow the twelve inertia loads; since version 1.3
  /// n x columns(): Φᵀ g for the loads g and the modes Φ of internal coordinates; zero for boundary coordinates.
  Eigen::MatrixXd share;
  Eigen::VectorXd stiffness;  ///< (n) ω² of internal coordinates; zero for boundary coordinates
  double left_out = 0.0;      ///< lower bound of ω² of the modes that were left out; 0: all kept
  /// Reduced stiffness S̄ of the boundary coordinates (n_B x n_B). Empty if the file has no nodal forces (before
  /// version 1.2).
  Eigen::MatrixXd boundary_stiffness;

  bool has_forces() const { return boundary_stiffness.size() > 0; }
  int columns() const { return inertia_loads + count_of(applied); }
};

/// Kinds of nodal forces: interior forces for which the recovered displacement is the static answer of the unreduced
/// part (RECOVERY.md, nodal forces). load_force and load_moment are those of the loads; mode_force and mode_moment are
/// S_II φ of each internal coordinate with mode φ. They are in part axes, on coordinates that ties leave independent, 3
/// per node.
enum class NodalForce { load_force, load_moment, mode_force, mode_moment };
inline constexpr std::array<NodalForce, 4> nodal_forces{NodalForce::load_force, NodalForce::load_moment,
                                                        NodalForce::mode_force, NodalForce::mode_moment};

/// Contents of a recovery file except its fields, which are large (nodes times coordinates). It has n coordinates, in
/// the order of the superelement.
struct Recovery {
  std::string name;
  std::string producer;
  std::string content_id;  ///< content_id of the superelement file or modal body
  /// content_id of each mirror image of the superelement (mirrored()), in the order of mirror_axes().
  std::array<std::string, 7> mirror_content_id;
  Units units;  ///< units of the superelement

  std::vector<std::string> boundary_name;  ///< as in the superelement
  std::vector<int> boundary_node;          ///< row of `position` of each boundary node
  std::vector<int> dof_node, dof_component;

  Eigen::Matrix3Xd position;            ///< 3 x nodes, part frame
  std::vector<std::string> node_label;  ///< "tip", "spar[3]", "node 4711"
  std::vector<int> node_number;         ///< number of the node in the mesh file, 0: none; empty before version 1.2
  std::vector<int> rotates;             ///< 1: the node has rotations; 0: its rows of `rotation` are zero
  std::vector<std::string> group_name;  ///< lines, groups or property cards
  RecoveryElements elements;

  std::vector<Eigen::Matrix3d> beam_axes;  ///< columns: x, y, z of the element in part axes
  Eigen::Matrix3Xd beam_offset;            ///< (3 x 2 beams) from each node to the end of the axis
  std::vector<int> beam_section;           ///< 2 per beam: rows of `sections`
  std::vector<RecoverySection> sections;

  std::vector<Eigen::Matrix3d> shell_axes;  ///< columns: x, y and normal in part axes
  std::vector<double> shell_thickness;
  std::vector<double> shell_offset;  ///< from the nodes to the middle surface along the normal

  std::vector<int> stress_node, stress_group;  ///< stress points of solids: one per node and group of elements

  std::optional<RecoveryLoads> loads;  ///< since version 1.1
  /// Since version 1.3, for parts whose companion file has the second order.
  std::optional<SecondOrderForms> second_order;

  Eigen::Matrix3Xi triangle;  ///< surface: nodes, counter-clockwise seen from outside (shells: from the normal's tip)
  std::vector<int> triangle_element;  ///< shell or solid of each triangle

  int nodes() const { return static_cast<int>(position.cols()); }
  int coordinates() const { return count_of(dof_node); }
  int beams() const { return count_of(beam_axes); }
  int shells() const { return count_of(shell_axes); }
  int stress_points() const { return count_of(stress_node); }
  int internal() const { return static_cast<int>(std::count(dof_node.begin(), dof_node.end(), -1)); }
};

/// Signs of the axes of mirror image 0 to 6: (−1, 1, 1), (1, −1, 1), (−1, −1, 1), (1, 1, −1), ...
Eigen::Vector3d mirror_axes(int image);

/// Fields of a recovery file. Each has values per item of the mesh (node, beam, shell, stress point) and per unit of
/// each coordinate.
///   translation, rotation: 3 per node, part axes
///   beam_force: 12 per beam, [N Vy Vz Mx My Mz] at its first and its second end, in element axes about the axis. They
///   act from the part beyond the section on the part before it
///   shell_stress: 6 per shell at the mean of its corners, [xx yy xy] of membrane (N/t) and of bending (6M/t²), element
///   axes. The face of the normal has their sum, the other face the difference
///   solid_stress: 6 per stress point, [xx yy zz xy yz zx], part axes; mean of the elements of the group at the node
enum class RecoveryField { translation, rotation, beam_force, shell_stress, solid_stress };
inline constexpr std::array<RecoveryField, 5> recovery_fields{RecoveryField::translation, RecoveryField::rotation,
                                                              RecoveryField::beam_force, RecoveryField::shell_stress,
                                                              RecoveryField::solid_stress};
/// Number of values per item of a field; items() returns the number of its items.
int width(RecoveryField field);
int items(const Recovery& recovery, RecoveryField field);
/// Number of items in one chunk of a field's dataset. Reading and writing whole chunks is fastest.
int chunk_items(const Recovery& recovery, RecoveryField field);

/// Values of a field, stored row by row: (width · items) x n, with n coordinates.
using FieldRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Checks all rules of RECOVERY.md. `where`: name of the file in messages. Throws Error.
void check(const Recovery& recovery, const std::string& where);

/// Name of the recovery file: part.superelement.h5 -> part.recovery.h5, part.modal.h5 -> part.modal.recovery.h5.
std::string recovery_path(const std::string& superelement_file);

/// Writer of a recovery file under a temporary name. finish() publishes the file; without finish() nothing is left.
class RecoveryWriter {
 public:
  RecoveryWriter(const std::string& path, const Recovery& recovery);
  ~RecoveryWriter();
  RecoveryWriter(const RecoveryWriter&) = delete;
  RecoveryWriter& operator=(const RecoveryWriter&) = delete;

  /// Appends the next items of a field (width · items x n). Requires whole chunks, or items up to the last one. Throws
  /// Error (values beyond 32-bit numbers, disk full).
  void append(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Appends items of a field of the answers to loads (width · items x RecoveryLoads::columns()). Requires a file with
  /// loads.
  void append_loads(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Appends nodal forces. They have RecoveryLoads::columns() columns, or one column per internal coordinate for
  /// mode_force and mode_moment. Requires a file with nodal forces.
  void append_forces(NodalForce force, const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Appends translations or rotations of second-order shapes. Requires a file with second-order shapes.
  void append_second_order(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Closes the complete file and returns its temporary name. Requires that all items were appended.
  std::string stage();
  /// Closes the complete file and gives it its final name.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reader of a recovery file. The constructor reads and checks everything except the fields, which are read on request.
/// Throws Error.
class RecoveryReader {
 public:
  explicit RecoveryReader(const std::string& path);
  ~RecoveryReader();

  const std::string& path() const;
  const Recovery& recovery() const;
  /// Items [first, first + count) of a field, (width · count) x n with n coordinates. All values are finite.
  FieldRows read(RecoveryField field, int first, int count) const;
  /// Items [first, first + count) of a field of the answers to loads, (width · count) x RecoveryLoads::columns().
  /// Requires a file with loads.
  FieldRows read_loads(RecoveryField field, int first, int count) const;
  /// Nodal forces on nodes [first, first + count): 3 count x RecoveryLoads::columns(), or 3 count x internal
  /// coordinates for mode_force and mode_moment. Requires a file with nodal forces.
  FieldRows read_forces(NodalForce force, int first, int count) const;
  /// Translations or rotations of second-order shapes at nodes [first, first + count): 3 count x shapes. No columns if
  /// the file has no second-order shapes.
  FieldRows read_second_order(RecoveryField field, int first, int count) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Mirror image that `content_id` identifies, as signs of the axes (all 1: none). Throws Error if the recovery file
/// belongs to another superelement.
Eigen::Vector3d require_same_superelement(const Recovery& recovery, const std::string& content_id,
                                          const std::string& where, const std::string& body);

/// Converts coordinates y (n x T) of a mirror image in units of the scene to those of the part in units of the file.
/// `mirror`: signs of the axes. `length`: the file's unit of length, in units of the scene.
void to_part(const Recovery& recovery, const Eigen::Vector3d& mirror, double length, Eigen::MatrixXd& y);

}  // namespace tisserand::formats
