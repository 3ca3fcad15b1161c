// Small parts of every element, tie and offset, made by rule: what crossings of the reducer are tried on.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace tisserand::testing::crossings {

enum class Body { beams, quads, triangles, bricks, bricks20, tetrahedra, prisms, skinned_frame, laminate };
enum class Extra { nothing, mass, bushing, link, offset };
enum class Boundary { ends, averaged_end, bare, one };
enum class Way { modes, moments, rubin, macneal, krylov_schur, lapack, block_lanczos };
enum class Change { turned, mirrored, units, renumbered, far, abaqus };
inline constexpr std::array<int, 5> sizes{9, 5, 4, 7, 6};

/// A choice of each.
struct Cell {
  Body body;
  Extra extra;
  Boundary boundary;
  Way way;
  Change change;
};
std::string name_of(const Cell& cell);
/// False where a cell cannot be: offsets of solids, what decks of Abaqus cannot say.
bool is_sensible(const Cell& cell);

enum class Shape { bar, quad, triangle, brick, brick20, tetrahedron, prism };
struct Element {
  Shape shape;
  std::vector<int> nodes;
};

/// `reference` leads `nodes` (rigid), or follows their mean motion.
struct Spider {
  bool is_rigid = true;
  int reference = 0;
  std::vector<int> nodes;
  bool with_rotations = false;
};

/// SI units. Nodes count from 0.
struct PartModel {
  std::vector<Eigen::Vector3d> nodes;
  std::vector<Element> elements;
  std::vector<Spider> spiders;
  Eigen::Vector3d across = Eigen::Vector3d(0.1, 0.3, 1.0);  ///< in the x-y plane of bars
  Eigen::Vector3d bar_offset = Eigen::Vector3d::Zero();     ///< of the first end of each bar
  double shell_offset = 0.0;                                ///< along the normal
  double turn = 0.0;                                        ///< of the plies of a laminate, to its sense; else 0
  bool is_laminate = false;
  std::optional<int> mass;                    ///< node of the point mass
  std::optional<std::array<int, 2>> bushing;  ///< its ends
  std::optional<std::array<int, 2>> link;     ///< nodes that keep their distance
  std::vector<int> boundary;                  ///< base first
  bool is_bare = false;                       ///< of the boundary the translations alone
  int loaded = 0;                             ///< an inner node
  /// False of an average whose reference stays: the second order that its nodes follow by is put on those of them that
  /// elimination chose, so that internal coordinates differ at second order, and with them arrays of the companion.
  bool has_own_second_order = true;

  /// Of the point mass.
  static constexpr double mass_value = 0.8;
  static Eigen::Vector3d mass_offset() { return {0.03, -0.02, 0.05}; }
  static Eigen::Matrix3d mass_inertia();
};
PartModel part_model(const Cell& cell);

}  // namespace tisserand::testing::crossings
