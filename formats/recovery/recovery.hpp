// The recovery file *.recovery.h5: mesh, shapes and stresses of a part, by which the reduced motion of its superelement
// becomes displacement and stress everywhere (formats/RECOVERY.md). Equations of motion never need it.
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

/// Shapes of elements; solids with the node order of gmsh. The numbers are those of the file.
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

/// Section of a beam at one of its ends, in the axes of the element, about its axis (the line between its ends).
struct RecoverySection {
  double area = 0.0;  ///< 0: given by stiffness, so that there are forces and no stresses
  double second_moment_y = 0.0, second_moment_z = 0.0, second_moment_yz = 0.0;  ///< about the centroid
  double centroid_y = 0.0, centroid_z = 0.0;
  std::vector<Eigen::Vector2d> outline;  ///< (y, z) of the outer contour, counter-clockwise seen against x
  bool outline_known = false;            ///< or of an equivalent rectangle or circle
};

/// One element; beams come first, then shells, then solids.
struct RecoveryElements {
  std::vector<ElementShape> shape;
  std::vector<int> group;  ///< row of Recovery::group_name
  std::vector<int> id;     ///< number in the deck or in its group
  std::vector<int> first;  ///< elements + 1; into `node`
  std::vector<int> node;   ///< rows of Recovery::position

  int count() const { return count_of(shape); }
};

inline constexpr int inertia_loads = 12;  ///< six rigid accelerations, six products of angular velocities

/// What else may act on the inside of the part: a load case, or a force or moment on a node of a modal body, of size 1.
struct AppliedLoad {
  std::string load_case;  ///< its name; empty: a force on a node
  std::string node;       ///< name of the node, of a force
  int component = 0;      ///< 0 to 2 forces, 3 to 5 moments, part axes
};

/// Static answers of the part to the inertia loads of its floating frame, with the boundary held, less what the
/// internal coordinates hold of them: what the basis leaves out of displacement and stress. Loads: M D_a of the
/// accelerations of the reference point (3) and of the angular accelerations (3), then those of products of angular
/// velocities ω_j ω_k, jk = xx yy zz yz xz xy (COMPANION.md: g_a, g_jk).
struct RecoveryLoads {
  Eigen::Vector3d reference_point = Eigen::Vector3d::Zero();  ///< part frame
  std::vector<AppliedLoad> applied;                           ///< since version 1.3: columns behind the twelve
  Eigen::MatrixXd share;      ///< n x columns(): Φᵀ g of internal coordinates, zero for those of the boundary
  Eigen::VectorXd stiffness;  ///< n: ω² of internal coordinates, zero for those of the boundary
  double left_out = 0.0;      ///< no mode that is left out has an ω² below this; 0: none is left out
  /// n_B x n_B: S̄ of the coordinates of the boundary; empty if the file has no nodal forces (before version 1.2).
  Eigen::MatrixXd boundary_stiffness;

  bool has_forces() const { return boundary_stiffness.size() > 0; }
  int columns() const { return inertia_loads + count_of(applied); }
};

/// Forces of the inside on the nodes, by which the static answer of the unreduced part is what recovery gives
/// (RECOVERY.md, nodal forces): those of the loads, and S_II φ of each internal coordinate; part axes, on
/// coordinates that ties leave independent. 3 per node.
enum class NodalForce { load_force, load_moment, mode_force, mode_moment };
inline constexpr std::array<NodalForce, 4> nodal_forces{NodalForce::load_force, NodalForce::load_moment,
                                                        NodalForce::mode_force, NodalForce::mode_moment};

/// All but the fields, which are as long as nodes times coordinates. n coordinates, those of the superelement in its
/// order.
struct Recovery {
  std::string name;
  std::string producer;
  std::string content_id;  ///< of the superelement file, or of the modal body, that it belongs to
  /// Of the images of that (mirrored()), mirror_axes() in order.
  std::array<std::string, 7> mirror_content_id;
  Units units;  ///< those of the superelement

  std::vector<std::string> boundary_name;  ///< as in the superelement
  std::vector<int> boundary_node;          ///< row of `position` of each
  std::vector<int> dof_node, dof_component;

  Eigen::Matrix3Xd position;            ///< 3 x nodes, part frame
  std::vector<std::string> node_label;  ///< "tip", "spar[3]", "node 4711"
  std::vector<int> node_number;         ///< in the mesh file, 0: it has none; empty before version 1.2
  std::vector<int> rotates;             ///< 1: the node has rotations; 0: its rows of `rotation` are zero
  std::vector<std::string> group_name;  ///< lines, groups or property cards
  RecoveryElements elements;

  std::vector<Eigen::Matrix3d> beam_axes;  ///< columns: x, y, z of the element in part axes
  Eigen::Matrix3Xd beam_offset;            ///< 3 x 2 beams: from each node to the end of the axis
  std::vector<int> beam_section;           ///< 2 per beam: rows of `sections`
  std::vector<RecoverySection> sections;

  std::vector<Eigen::Matrix3d> shell_axes;  ///< columns: x, y and normal in part axes
  std::vector<double> shell_thickness;
  std::vector<double> shell_offset;  ///< of the middle surface from the nodes along the normal

  std::vector<int> stress_node, stress_group;  ///< points of solids: one per node and group of elements around it

  std::optional<RecoveryLoads> loads;            ///< since version 1.1
  std::optional<SecondOrderForms> second_order;  ///< since version 1.3, of parts with the second order of a companion

  Eigen::Matrix3Xi triangle;  ///< surface: nodes, counter-clockwise seen from outside (shells: from the normal's tip)
  std::vector<int> triangle_element;  ///< shell or solid of each

  int nodes() const { return static_cast<int>(position.cols()); }
  int coordinates() const { return count_of(dof_node); }
  int beams() const { return count_of(beam_axes); }
  int shells() const { return count_of(shell_axes); }
  int stress_points() const { return count_of(stress_node); }
  int internal() const { return static_cast<int>(std::count(dof_node.begin(), dof_node.end(), -1)); }
};

/// Axes of the seven mirror images: (−1, 1, 1), (1, −1, 1), (−1, −1, 1), (1, 1, −1), ...
Eigen::Vector3d mirror_axes(int image);

/// What one unit of each coordinate does, by item of the mesh.
///   translation, rotation: 3 per node, part axes
///   beam_force: 12 per beam, [N Vy Vz Mx My Mz] at its first and its second end: what the part beyond exerts on
///     the part before, in element axes about the axis
///   shell_stress: 6 per shell at the mean of its corners, [xx yy xy] of membrane (N/t), [xx yy xy] of bending (6M/t²),
///     in element axes; on the face of the normal their sum, on the other the difference
///   solid_stress: 6 per stress point, [xx yy zz xy yz zx], part axes; mean of the elements of the group at the node
enum class RecoveryField { translation, rotation, beam_force, shell_stress, solid_stress };
inline constexpr std::array<RecoveryField, 5> recovery_fields{RecoveryField::translation, RecoveryField::rotation,
                                                              RecoveryField::beam_force, RecoveryField::shell_stress,
                                                              RecoveryField::solid_stress};
/// Values per item, and items.
int width(RecoveryField field);
int items(const Recovery& recovery, RecoveryField field);
/// Items of a chunk, which are read and written at best together.
int chunk_items(const Recovery& recovery, RecoveryField field);

/// (width · items) x n, row by row.
using FieldRows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// All that RECOVERY.md demands of it; `where` is the file in messages. Throws Error.
void check(const Recovery& recovery, const std::string& where);

/// part.superelement.h5 -> part.recovery.h5, part.modal.h5 -> part.modal.recovery.h5
std::string recovery_path(const std::string& superelement_file);

/// Writes beside `path`, and publishes in finish(); without that nothing is left.
class RecoveryWriter {
 public:
  RecoveryWriter(const std::string& path, const Recovery& recovery);
  ~RecoveryWriter();
  RecoveryWriter(const RecoveryWriter&) = delete;
  RecoveryWriter& operator=(const RecoveryWriter&) = delete;

  /// The next items of a field: whole chunks, or to the last item. Throws Error (values beyond 32-bit numbers, disk
  /// full).
  void append(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// The same of the loads' answers: RecoveryLoads::columns(). Only of a file with loads.
  void append_loads(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Columns of forces on nodes: RecoveryLoads::columns(), or one for each internal coordinate; with nodal forces only.
  void append_forces(NodalForce force, const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Translations or rotations of the shapes of second order. Only of a file with such shapes.
  void append_second_order(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows);
  /// Closes the file, of which all items must have been appended, under a temporary name, which is returned.
  std::string stage();
  /// The same, and gives it its name.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads and checks everything but the fields. Throws Error.
class RecoveryReader {
 public:
  explicit RecoveryReader(const std::string& path);
  ~RecoveryReader();

  const std::string& path() const;
  const Recovery& recovery() const;
  /// Items [first, first + count) of a field: (width · count) x n, finite.
  FieldRows read(RecoveryField field, int first, int count) const;
  /// The same of the loads' answers: (width · count) x RecoveryLoads::columns(). Only of a file with loads.
  FieldRows read_loads(RecoveryField field, int first, int count) const;
  /// Nodes [first, first + count): 3 count x RecoveryLoads::columns(), or x internal coordinates; with nodal forces
  /// only.
  FieldRows read_forces(NodalForce force, int first, int count) const;
  /// Translations or rotations of nodes [first, first + count): 3 count x shapes of second order; of a file without:
  /// without columns.
  FieldRows read_second_order(RecoveryField field, int first, int count) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Refuses a recovery file of another superelement. Returns the mirror image (signs of the axes, all 1: none) that
/// `content_id` is of.
Eigen::Vector3d require_same_superelement(const Recovery& recovery, const std::string& content_id,
                                          const std::string& where, const std::string& body);

/// Coordinates of an image in units of the scene -> those of the part in units of the file, n x T. `mirror`: signs of
/// the axes; `length`: of a unit of the file in the scene.
void to_part(const Recovery& recovery, const Eigen::Vector3d& mirror, double length, Eigen::MatrixXd& y);

}  // namespace tisserand::formats
