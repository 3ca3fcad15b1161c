// SPDX-License-Identifier: GPL-3.0-or-later
// Visible surface of a mesh: faces of shells and solids, and beams drawn by their end sections.
#include "formats/page/skin.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <Eigen/LU>

#include "common/error.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Adds the triangles of shells and solids.
void add_faces(const Recovery& recovery, Skin& skin) {
  std::vector<int> vertex(recovery.nodes(), -1);
  for (Index t = 0; t < recovery.triangle.cols(); ++t) {
    std::array<int, 3> triangle{};
    for (int k = 0; k < 3; ++k) {
      const int node = recovery.triangle(k, t);
      if (vertex[node] < 0) {
        vertex[node] = skin.surface.size();
        skin.surface.vertices.push_back(recovery.position.col(node));
        skin.carriers.push_back({node});
      }
      triangle[k] = vertex[node];
    }
    skin.surface.triangles.push_back(triangle);
    skin.triangle_element.push_back(recovery.triangle_element[static_cast<std::size_t>(t)]);
  }
}

/// Adds each beam as its sections at both ends.
void add_beams(const Recovery& recovery, Skin& skin) {
  for (int e = 0; e < recovery.beams(); ++e) {
    const int* nodes = recovery.elements.node.data() + recovery.elements.first[e];
    const std::vector<Eigen::Vector2d>*outlines[2], *first = nullptr;
    for (int end = 0; end < 2; ++end) outlines[end] = &recovery.sections[recovery.beam_section[2 * e + end]].outline;
    first = outlines[0];
    if (outlines[1]->size() != first->size()) outlines[1] = first;
    if (first->size() < 3) {  // drawn as a line
      const int at = skin.surface.size();
      skin.surface.lines.push_back({at, at + 1});
      skin.line_element.push_back(e);
    } else {
      const Surface faces = swept_faces(2, count_of(*first));
      const int at = skin.surface.size();
      for (const auto& [a, b, c] : faces.triangles) skin.surface.triangles.push_back({a + at, b + at, c + at});
      skin.triangle_element.insert(skin.triangle_element.end(), faces.triangles.size(), e);
    }
    for (int end = 0; end < 2; ++end) {
      const Vector3d offset = recovery.beam_offset.col(2 * e + end);
      const auto add = [&](const Eigen::Vector2d& corner) {
        const Vector3d arm = offset + recovery.beam_axes[e] * Vector3d(0.0, corner.x(), corner.y());
        skin.surface.vertices.push_back(recovery.position.col(nodes[end]) + arm);
        skin.carriers.push_back({nodes[end], arm, e, end, corner});
      };
      if (first->size() < 3)
        add(Eigen::Vector2d::Zero());
      else
        for (const Eigen::Vector2d& corner : *outlines[end]) add(corner);
    }
  }
}

enum class Fields { coordinates, loads, second_order };

/// Source of fields: of coordinates, of loads, or of second-order shapes.
struct FieldSource {
  const RecoveryReader& reader;
  Fields fields = Fields::coordinates;

  Index columns() const {
    const Recovery& recovery = reader.recovery();
    switch (fields) {
      case Fields::coordinates:
        return recovery.coordinates();
      case Fields::loads:
        return recovery.loads ? recovery.loads->columns() : 0;
      case Fields::second_order:
        return recovery.second_order ? recovery.second_order->shapes() : 0;
    }
    TISSERAND_ENSURE(false, "fields {}", static_cast<int>(fields));
  }
  FieldRows read(RecoveryField field, int first, int count) const {
    switch (fields) {
      case Fields::coordinates:
        return reader.read(field, first, count);
      case Fields::loads:
        return reader.read_loads(field, first, count);
      case Fields::second_order:
        return reader.read_second_order(field, first, count);
    }
    TISSERAND_ENSURE(false, "fields {}", static_cast<int>(fields));
  }
};

MatrixXd shapes_of(const FieldSource& source, const std::vector<SkinCarrier>& carriers) {
  const Recovery& recovery = source.reader.recovery();
  MatrixXd shapes = MatrixXd::Zero(3 * carriers.size(), source.columns());
  if (shapes.cols() == 0) return shapes;
  std::multimap<int, Index> at;  // by node
  bool turns = false;
  for (std::size_t v = 0; v < carriers.size(); ++v) {
    at.emplace(carriers[v].node, v);
    turns = turns || !carriers[v].arm.isZero(0.0);
  }
  for (const RecoveryField field : {RecoveryField::translation, RecoveryField::rotation}) {
    if (field == RecoveryField::rotation && !turns) break;
    const int chunk = chunk_items(recovery, field);
    for (int first = 0; first < recovery.nodes(); first += chunk) {
      const int count = std::min(chunk, recovery.nodes() - first);
      const auto begin = at.lower_bound(first), end = at.lower_bound(first + count);
      if (begin == end) continue;
      const FieldRows rows = source.read(field, first, count);
      for (auto one = begin; one != end; ++one) {
        const auto values = rows.middleRows(3 * (one->first - first), 3).cast<double>();
        auto shape = shapes.middleRows(3 * one->second, 3);
        if (field == RecoveryField::translation)
          shape += values;
        else
          for (Index k = 0; k < shape.cols(); ++k)
            shape.col(k) += Vector3d(values.col(k)).cross(carriers[one->second].arm);
      }
    }
  }
  return shapes;
}

/// Stress tensor s a aᵀ of a unit stress, as [xx yy zz xy yz zx].
Vector6 uniaxial(const Vector3d& a) {
  Vector6 tensor;
  tensor << a.cwiseAbs2(), a.x() * a.y(), a.y() * a.z(), a.z() * a.x();
  return tensor;
}

/// Tensors of the unit stresses xx, yy, xy of a sheet with axes a, b, one per column.
Eigen::Matrix<double, 6, 3> plane(const Vector3d& a, const Vector3d& b) {
  Eigen::Matrix<double, 6, 3> tensors;
  tensors << uniaxial(a), uniaxial(b), (uniaxial(a + b) - uniaxial(a) - uniaxial(b));
  return tensors;
}

/// Normal stress at a corner of a section per unit of [N Vy Vz Mx My Mz]; zero without an area.
Eigen::Matrix<double, 1, 6> normal_stress(const RecoverySection& section, const Eigen::Vector2d& corner) {
  Eigen::Matrix<double, 1, 6> row = Eigen::Matrix<double, 1, 6>::Zero();
  if (!(section.area > 0.0)) return row;
  Eigen::Matrix2d I;
  I << section.second_moment_z, section.second_moment_yz, section.second_moment_yz, section.second_moment_y;
  const Eigen::Vector2d centroid(section.centroid_y, section.centroid_z), at = I.inverse() * (corner - centroid);
  row << 1.0 / section.area - at.dot(centroid), 0.0, 0.0, 0.0, at.y(), -at.x();
  return row;
}

/// Calls visit(first, rows) for the items of a field, in whole chunks.
template <class Visit>
void each_chunk(const FieldSource& source, RecoveryField field, Visit visit) {
  const Recovery& recovery = source.reader.recovery();
  const int chunk = chunk_items(recovery, field), all = items(recovery, field);
  for (int first = 0; first < all; first += chunk)
    visit(first, MatrixXd(source.read(field, first, std::min(chunk, all - first)).cast<double>()));
}

MatrixXd stresses_of(const FieldSource& source, const std::vector<SkinCarrier>& carriers) {
  const Recovery& recovery = source.reader.recovery();
  MatrixXd stress = MatrixXd::Zero(6 * carriers.size(), source.columns());
  if (stress.cols() == 0) return stress;
  std::vector<int> vertex(recovery.nodes(), -1), count(carriers.size(), 0);
  std::multimap<int, Index> of_beam;
  for (int v = 0; v < std::ssize(carriers); ++v)
    if (carriers[v].beam >= 0)
      of_beam.emplace(carriers[v].beam, v);
    else
      vertex[carriers[v].node] = v;
  each_chunk(source, RecoveryField::solid_stress, [&](int first, const MatrixXd& rows) {
    for (Index p = 0; p < rows.rows() / 6; ++p)
      if (const int v = vertex[recovery.stress_node[first + p]]; v >= 0) {
        stress.middleRows<6>(6 * v) += rows.middleRows<6>(6 * p);
        ++count[v];
      }
  });
  each_chunk(source, RecoveryField::shell_stress, [&](int first, const MatrixXd& rows) {
    for (Index s = 0; s < rows.rows() / 6; ++s) {
      const int e = recovery.beams() + first + static_cast<int>(s);
      const Eigen::Matrix3d& axes = recovery.shell_axes[first + s];
      const MatrixXd own =
          plane(axes.col(0), axes.col(1)) * (rows.middleRows<3>(6 * s) + rows.middleRows<3>(6 * s + 3));
      for (int k = recovery.elements.first[e]; k < recovery.elements.first[e + 1]; ++k)
        if (const int v = vertex[recovery.elements.node[k]]; v >= 0) {
          stress.middleRows<6>(6 * v) += own;
          ++count[v];
        }
    }
  });
  for (std::size_t v = 0; v < carriers.size(); ++v)
    if (count[v] > 1) stress.middleRows<6>(6 * v) /= count[v];
  each_chunk(source, RecoveryField::beam_force, [&](int first, const MatrixXd& rows) {
    const auto begin = of_beam.lower_bound(first),
               end = of_beam.lower_bound(first + static_cast<int>(rows.rows()) / 12);
    for (auto one = begin; one != end; ++one) {
      const SkinCarrier& carrier = carriers[one->second];
      const RecoverySection& section = recovery.sections[recovery.beam_section[2 * carrier.beam + carrier.end]];
      stress.middleRows<6>(6 * one->second) =
          uniaxial(recovery.beam_axes[carrier.beam].col(0)) *
          (normal_stress(section, carrier.corner) * rows.middleRows<6>(12 * (carrier.beam - first) + 6 * carrier.end));
    }
  });
  return stress;
}

}  // namespace

Skin skin_of(const Recovery& recovery) {
  Skin skin;
  add_faces(recovery, skin);
  add_beams(recovery, skin);
  return skin;
}

MatrixXd shapes_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers) {
  return shapes_of({reader, Fields::coordinates}, carriers);
}

MatrixXd stresses_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers) {
  return stresses_of({reader, Fields::coordinates}, carriers);
}

MatrixXd load_shapes_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers) {
  return shapes_of({reader, Fields::loads}, carriers);
}

MatrixXd load_stresses_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers) {
  return stresses_of({reader, Fields::loads}, carriers);
}

MatrixXd second_order_shapes_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers) {
  return shapes_of({reader, Fields::second_order}, carriers);
}

}  // namespace tisserand::formats
