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

/// Shapes of elements. Solids have the node order of gmsh. The file stores these numbers.
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

/// Section of a beam at one end, in the axes of the element, about its axis (the line between its ends).
struct RecoverySection {
  double area = 0.0;  ///< 0: given by stiffness, so there are forces but no stresses
  double second_moment_y = 0.0, second_moment_z = 0.0, second_moment_yz = 0.0;  ///< about the centroid
  double centroid_y = 0.0, centroid_z = 0.0;
  std::vector<Eigen::Vector2d> outline;  ///< (y, z) of the outer contour, counter-clockwise seen against x
  bool outline_known = false;            ///< false: outline of an equivalent rectangle or circle
};

/// Elements: first beams, then shells, then solids.
struct RecoveryElements {
  std::vector<ElementShape> shape;
  std::vector<int> group;  ///< row of Recovery::group_name
  std::vector<int> id;     ///< number in the deck or in its group
  std::vector<int> first;  ///< elements + 1 indices into `node`
  std::vector<int> node;   ///< rows of Recovery::position

  int count() const { return count_of(shape); }
};

inline constexpr int inertia_loads = 12;  ///< six rigid accelerations, six products of angular velocities

/// Further load on the interior of the part: a load case, or a unit force or moment on a node of a modal body.
struct AppliedLoad {
  std::string load_case;  ///< name; empty: a force on a node
  std::string node;       ///< name of the loaded node
  int component = 0;      ///< 0 to 2 forces, 3 to 5 moments, part axes
};

/// Static answers of the part to the inertia loads of its floating frame, with the boundary held, less the share of the
/// internal coordinates (THEORY (95)). They are what the basis misses in displacement and stress. Loads: M D_a for
/// accelerations (3) and angular accelerations (3) of the reference point, then products of angular velocities ω_j ω_k,
/// jk = xx yy zz yz xz xy (COMPANION.md: g_a, g_jk).
struct RecoveryLoads {
  Eigen::Vector3d reference_point = Eigen::Vector3d::Zero();  ///< part frame
  std::vector<AppliedLoad> applied;                           ///< since version 1.3: columns after the twelve
  Eigen::MatrixXd share;      ///< n x columns(): Φᵀ g of internal coordinates, zero for boundary coordinates
  Eigen::VectorXd stiffness;  ///< n: ω² of internal coordinates, zero for boundary coordinates
  double left_out = 0.0;      ///< every dropped mode has at least this ω²; 0: none is dropped
  /// n_B x n_B: S̄ of the boundary coordinates; empty if the file has no nodal forces (before version 1.2).
  Eigen::MatrixXd boundary_stiffness;

  bool has_forces() const { return boundary_stiffness.size() > 0; }
  int columns() const { return inertia_loads + count_of(applied); }
};

/// Forces of the interior on the nodes, of which the recovered displacement is the static answer of the unreduced part
/// (RECOVERY.md, nodal forces): those of the loads, and S_II φ of each internal coordinate. Part axes, on coordinates
/// that ties leave independent, 3 per node.
enum class NodalForce { load_force, load_moment, mode_force, mode_moment };
inline constexpr std::array<NodalForce, 4> nodal_forces{NodalForce::load_force, NodalForce::load_moment,
                                                        NodalForce::mode_force, NodalForce::mode_moment};

/// Contents of a recovery file except the fields, whose size is nodes times coordinates. n coordinates, in the order of
/// the superelement.
struct Recovery {
  std::string name;
  std::string producer;
  std::string content_id;  ///< content_id of the superelement file or modal body
  /// content_id of its mirror images (mirrored()), in the order of mirror_axes().
  std::array<std::string, 7> mirror_content_id;
  Units units;  ///< units of the superelement

  std::vector<std::string> boundary_name;  ///< as in the superelement
  std::vector<int> boundary_node;          ///< row of `position` of each
  std::vector<int> dof_node, dof_component;

  Eigen::Matrix3Xd position;            ///< 3 x nodes, part frame
  std::vector<std::string> node_label;  ///< "tip", "spar[3]", "node 4711"
  std::vector<int> node_number;         ///< number in the mesh file, 0: none; empty before version 1.2
  std::vector<int> rotates;             ///< 1: the node has rotations; 0: its rows of `rotation` are zero
  std::vector<std::string> group_name;  ///< lines, groups or property cards
  RecoveryElements elements;

  std::vector<Eigen::Matrix3d> beam_axes;  ///< columns: x, y, z of the element in part axes
  Eigen::Matrix3Xd beam_offset;            ///< 3 x 2 beams: from each node to the end of the axis
  std::vector<int> beam_section;           ///< 2 per beam: rows of `sections`
  std::vector<RecoverySection> sections;

  std::vector<Eigen::Matrix3d> shell_axes;  ///< columns: x, y and normal in part axes
  std::vector<double> shell_thickness;
  std::vector<double> shell_offset;  ///< from the nodes to the middle surface along the normal

  std::vector<int> stress_node, stress_group;  ///< points of solids: one per node and group of elements there

  std::optional<RecoveryLoads> loads;            ///< since version 1.1
  std::optional<SecondOrderForms> second_order;  ///< since version 1.3, of parts with the second order of a companion

  Eigen::Matrix3Xi triangle;  ///< surface: nodes, counter-clockwise seen from outside (shells: from the normal's tip)
  std::vector<int> triangle_element;  ///< shell or solid of each triangle

  int nodes() const { return static_cast<int>(position.cols()); }
  int coordinates() const { return count_of(dof_node); }
  int beams() const { return count_of(beam_axes); }
  int shells() const { return count_of(shell_axes); }
  int stress_points() const { return count_of(stress_node); }
  int internal() const { return static_cast<int>(std::count(dof_node.begin(), dof_node.end(), -1)); }
};

/// Axes of the seven mirror images: (−1, 1, 1), (1, −1, 1), (−1, −1, 1), (1, 1, −1), ...
Eigen::Vector3d mirror_axes(int image);

/// Fields by item of the mesh, per unit of each coordinate.
///   translation, rotation: 3 per node, part axes
///   beam_force: 12 per beam, [N Vy Vz Mx My Mz] at its first and its second end, in element axes about the axis. They
///     act from the part beyond on the part before
///   shell_stress: 6 per shell at the mean of its corners, [xx yy xy] of membrane (N/t) and of bending (6M/t²), element
///     axes. The face of the normal has their sum, the other face the difference
///   solid_stress: 6 per stress point, [xx yy zz xy yz zx], part axes; mean of the elements of the group at the node
enum class RecoveryField { translation, rotation, beam_force, shell_stress, solid_stress };
inline constexpr std::array<RecoveryField, 5> recovery_fields{RecoveryField::translation, RecoveryField::rotation,
                                                              RecoveryField::beam_force, RecoveryField::shell_stress,
                                                              RecoveryField::solid_stress};
/// Number of values per item, and of items.
int width(RecoveryField field);
int items(const Recovery& recovery, RecoveryField field);
/// Number of items of a chunk. Reading and writing whole chunks is fastest.
int chunk_items(const Recovery& recovery, RecoveryField field);

/// Rows of a field: (width · items) x n, row by row.
using FieldRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Checks all rules of RECOVERY.md. `where`: file in messages. Throws Error.
void check(const Recovery& recovery, const std::string& where);

/// Name of the recovery file: part.superelement.h5 -> part.recovery.h5, part.modal.h5 -> part.modal.recovery.h5.
std::string recovery_path(const std::string& superelement_file);

/// Writes a recovery file under a temporary name. finish() publishes it; without finish() nothing is left.
class RecoveryWriter {
 public:
  RecoveryWriter(const std::string& path, const Recovery& recovery);
  ~RecoveryWriter();
  RecoveryWriter(const RecoveryWriter&) = delete;
  RecoveryWriter& operator=(const RecoveryWriter&) = delete;

  /// Appends the next items of a field: whole chunks, or up to the last item. Throws Error (values beyond 32-bit
  /// numbers, disk full).
  void append(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Appends items of the loads' answers: RecoveryLoads::columns() columns. Only for a file with loads.
  void append_loads(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Appends forces on nodes: RecoveryLoads::columns() or one column per internal coordinate. Needs nodal forces.
  void append_forces(NodalForce force, const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Appends translations or rotations of second-order shapes. Only for a file with such shapes.
  void append_second_order(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Closes the complete file and returns its temporary name. All items must have been appended.
  std::string stage();
  /// Closes the complete file and renames it.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads and checks everything except the fields, which it reads on request. Throws Error.
class RecoveryReader {
 public:
  explicit RecoveryReader(const std::string& path);
  ~RecoveryReader();

  const std::string& path() const;
  const Recovery& recovery() const;
  /// Items [first, first + count) of a field: (width · count) x n, finite.
  FieldRows read(RecoveryField field, int first, int count) const;
  /// Items of the loads' answers: (width · count) x RecoveryLoads::columns(). Only for a file with loads.
  FieldRows read_loads(RecoveryField field, int first, int count) const;
  /// Forces on nodes [first, first + count): 3 count x RecoveryLoads::columns(), or x internal coordinates. Needs nodal
  /// forces.
  FieldRows read_forces(NodalForce force, int first, int count) const;
  /// Translations or rotations of nodes [first, first + count): 3 count x second-order shapes; no columns if the file
  /// has none.
  FieldRows read_second_order(RecoveryField field, int first, int count) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Throws Error if the recovery file belongs to another superelement. Returns the mirror image (signs of the axes, all
/// 1: none) that `content_id` identifies.
Eigen::Vector3d require_same_superelement(const Recovery& recovery, const std::string& content_id,
                                          const std::string& where, const std::string& body);

/// Converts coordinates of an image in units of the scene to those of the part in units of the file, n x T. `mirror`:
/// signs of the axes. `length`: unit of length of the file in units of the scene.
void to_part(const Recovery& recovery, const Eigen::Vector3d& mirror, double length, Eigen::MatrixXd& y);

}  // namespace tisserand::formats
