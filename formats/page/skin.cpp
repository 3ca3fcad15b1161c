// Faces, and beams as their sections at both ends.
#include "formats/page/skin.hpp"

#include <array>
#include <map>

namespace tisserand::formats {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Triangles of shells and solids.
void add_faces(const Recovery& recovery, Skin& skin) {
  std::vector<int> vertex(recovery.nodes(), -1);
  for (Index t = 0; t < recovery.triangle.cols(); ++t) {
    std::array<int, 3> triangle{};
    for (int k = 0; k < 3; ++k) {
      const int node = recovery.triangle(k, t);
      if (vertex[node] < 0) {
        vertex[node] = skin.surface.size();
        skin.surface.vertices.push_back(recovery.position.col(node));
        skin.carriers.push_back({node, Vector3d::Zero()});
      }
      triangle[k] = vertex[node];
    }
    skin.surface.triangles.push_back(triangle);
    skin.triangle_element.push_back(recovery.triangle_element[static_cast<std::size_t>(t)]);
  }
}

/// Each beam as its sections at both ends.
void add_beams(const Recovery& recovery, Skin& skin) {
  for (int e = 0; e < recovery.beams(); ++e) {
    const int* nodes = recovery.elements.node.data() + recovery.elements.first[e];
    const std::vector<Eigen::Vector2d>*outlines[2], *first = nullptr;
    for (int end = 0; end < 2; ++end) outlines[end] = &recovery.sections[recovery.beam_section[2 * e + end]].outline;
    first = outlines[0];
    if (outlines[1]->size() != first->size()) outlines[1] = first;
    if (first->size() < 3) {  // a line
      const int at = skin.surface.size();
      skin.surface.lines.push_back({at, at + 1});
      skin.line_element.push_back(e);
    } else {
      const Surface faces = swept_faces(2, static_cast<int>(first->size()));
      const int at = skin.surface.size();
      for (const auto& [a, b, c] : faces.triangles) skin.surface.triangles.push_back({a + at, b + at, c + at});
      skin.triangle_element.insert(skin.triangle_element.end(), faces.triangles.size(), e);
    }
    for (int end = 0; end < 2; ++end) {
      const Vector3d offset = recovery.beam_offset.col(2 * e + end);
      const auto add = [&](const Vector3d& arm) {
        skin.surface.vertices.push_back(recovery.position.col(nodes[end]) + arm);
        skin.carriers.push_back({nodes[end], arm});
      };
      if (first->size() < 3)
        add(offset);
      else
        for (const Eigen::Vector2d& corner : *outlines[end])
          add(offset + recovery.beam_axes[e] * Vector3d(0.0, corner.x(), corner.y()));
    }
  }
}

}  // namespace

Skin skin_of(const Recovery& recovery) {
  Skin skin;
  add_faces(recovery, skin);
  add_beams(recovery, skin);
  return skin;
}

MatrixXd shapes_at(const RecoveryReader& reader, const std::vector<SkinCarrier>& carriers) {
  const Recovery& recovery = reader.recovery();
  MatrixXd shapes = MatrixXd::Zero(3 * carriers.size(), recovery.coordinates());
  std::multimap<int, Index> at;  // by node
  bool turns = false;
  for (std::size_t v = 0; v < carriers.size(); ++v) {
    at.emplace(carriers[v].node, static_cast<Index>(v));
    turns = turns || !carriers[v].arm.isZero(0.0);
  }
  for (const RecoveryField field : {RecoveryField::translation, RecoveryField::rotation}) {
    if (field == RecoveryField::rotation && !turns) break;
    const int chunk = chunk_items(recovery, field);
    for (int first = 0; first < recovery.nodes(); first += chunk) {
      const int count = std::min(chunk, recovery.nodes() - first);
      const auto begin = at.lower_bound(first), end = at.lower_bound(first + count);
      if (begin == end) continue;
      const FieldRows rows = reader.read(field, first, count);
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

}  // namespace tisserand::formats
