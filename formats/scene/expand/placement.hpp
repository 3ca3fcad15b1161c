// SPDX-License-Identifier: GPL-3.0-or-later
// Placement of an assembly: moves, rotates and mirrors positions, directions, orientations and inertia of its entries
// in the tree.
#pragma once

#include <set>
#include <string>

#include <Eigen/Core>

#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Map x -> p + G x from the axes of an assembly to the outer ones. G is orthogonal, with determinant −1 if it mirrors.
/// S (diagonal) mirrors the part frames of the assembly's bodies, so that G R S stays a rotation for each orientation
/// R. Without a mirror S is 1.
struct AssemblyFrame {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Matrix3d G = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d S = Eigen::Matrix3d::Identity();

  bool mirrored() const { return S.diagonal().prod() < 0.0; }
  bool turned() const { return !G.isIdentity(0.0); }
  bool moved() const { return turned() || !p.isZero(0.0); }
};

/// The composed map x -> outer(inner(x)).
AssemblyFrame compose(const AssemblyFrame& outer, const AssemblyFrame& inner);

/// Moves, rotates and mirrors entries by rewriting their numbers in the tree. Values that cannot be read become errors
/// of the reader and stay unchanged.
class Placement {
 public:
  Placement(YamlReader& reader, const AssemblyFrame& frame) : reader_(reader), frame_(frame) {}

  /// Places an entry of `bodies`, `joints`, `channels`, `springs`, `bushings`, `initial`, `tyres` or `loads`. Entries
  /// of other collections do not depend on the frame and stay.
  void place(const std::string& collection, YamlNode& entry);

  /// Coordinates of a joint that change sign in a mirrored assembly, for example "slide/z".
  static std::set<std::string> reversed_coordinates(const YamlNode& joint);

 private:
  Context context(const YamlNode& entry) const;
  void body(YamlNode& body);
  void mirror_part(YamlNode& body);
  void mirror_shape(YamlNode& shape);
  void mirror_file(YamlNode& body);
  void pair(YamlNode& entry, const std::string& type);
  void mirror_field(YamlNode& bushing);
  void channel(YamlNode& channel);
  void tyre(YamlNode& tyre);
  void load(YamlNode& load);
  void marker(YamlNode& entry, const char* key, const Eigen::Matrix3d& flip);
  void transform(YamlNode& map, const char* key, const Eigen::Matrix3d& by, const Eigen::Vector3d& shift);
  void turn_orientation(YamlNode& map, const Eigen::Matrix3d& before, const Eigen::Matrix3d& after);

  YamlReader& reader_;
  const AssemblyFrame& frame_;
};

}  // namespace tisserand::formats
