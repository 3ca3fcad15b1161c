// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that belong to one solid only, and their triangles.
#include "reducer/fields/surface.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "reducer/elements/solid/shapes.hpp"

namespace tisserand::reducer {
namespace {

/// Corners of a face, counter-clockwise seen from outside; a triangle ends with −1.
using Face = std::array<int, 4>;

struct Faces {
  std::vector<Face> corners;
  std::vector<Edge> edges;  ///< edges with middle nodes, which follow the corners
  int corner_count = 0;
};

template <SolidShape shape>
Faces faces_with_edges(std::vector<Face> corners, bool quadratic) {
  constexpr auto edges = SolidBasis<shape>::edges;
  Faces faces{std::move(corners), {}, static_cast<int>(SolidBasis<shape>::corners)};
  if (quadratic) faces.edges.assign(edges.begin(), edges.end());
  return faces;
}

Faces faces_of(SolidShape shape) {
  const bool quadratic =
      shape == SolidShape::tetrahedron10 || shape == SolidShape::hexahedron20 || shape == SolidShape::prism15;
  switch (shape) {
    case SolidShape::tetrahedron4:
    case SolidShape::tetrahedron10:
      return faces_with_edges<SolidShape::tetrahedron10>({{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}},
                                                         quadratic);
    case SolidShape::hexahedron8:
    case SolidShape::hexahedron20:
      return faces_with_edges<SolidShape::hexahedron20>(
          {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}, quadratic);
    case SolidShape::prism6:
    case SolidShape::prism15:
      return faces_with_edges<SolidShape::prism15>(
          {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}, quadratic);
  }
  return {};
}

int middle(const Faces& faces, int a, int b) {
  for (int e = 0; e < std::ssize(faces.edges); ++e) {
    const int first = static_cast<int>(faces.edges[e][0]), second = static_cast<int>(faces.edges[e][1]);
    if ((first == a && second == b) || (first == b && second == a)) return faces.corner_count + e;
  }
  return -1;
}

class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const Mesh& mesh) : mesh_(mesh) {}

  void triangle(int a, int b, int c, int element) {
    surface_.triangle.emplace_back(a, b, c);
    surface_.element.push_back(element);
  }
  void quadrilateral(const Face& n, int element) {
    const auto diagonal = [&](int a, int b) { return (mesh_.position.col(a) - mesh_.position.col(b)).squaredNorm(); };
    const bool first = diagonal(n[0], n[2]) <= diagonal(n[1], n[3]);
    const int turn = first ? 0 : 1;
    triangle(n[turn], n[turn + 1], n[turn + 2], element);
    triangle(n[turn], n[turn + 2], n[(turn + 3) % 4], element);
  }
  void face(const SolidElement& solid, const Faces& faces, const Face& corners, int element) {
    const int count = corners[3] < 0 ? 3 : 4;
    Face node{-1, -1, -1, -1}, halfway{-1, -1, -1, -1};
    for (int k = 0; k < count; ++k) {
      node[k] = solid.nodes[corners[k]];
      const int between = middle(faces, corners[k], corners[(k + 1) % count]);
      halfway[k] = between < 0 ? -1 : solid.nodes[between];
    }
    if (halfway[0] < 0) {
      if (count == 3)
        triangle(node[0], node[1], node[2], element);
      else
        quadrilateral(node, element);
      return;
    }
    for (int k = 0; k < count; ++k) triangle(node[k], halfway[k], halfway[(k + count - 1) % count], element);
    if (count == 3)
      triangle(halfway[0], halfway[1], halfway[2], element);
    else
      quadrilateral(halfway, element);
  }
  Surface take() { return std::move(surface_); }

 private:
  const Mesh& mesh_;
  Surface surface_;
};

/// A face by its sorted corners, with the number of solids that have it and the first of them.
struct Meeting {
  Face corners;
  int solid = 0, face = 0;
};

std::vector<Meeting> outer_faces(const Mesh& mesh) {
  std::vector<Meeting> all;
  for (int s = 0; s < std::ssize(mesh.solids); ++s) {
    const Faces faces = faces_of(mesh.solids[s].shape);
    for (int f = 0; f < std::ssize(faces.corners); ++f) {
      Meeting meeting{{-1, -1, -1, -1}, s, f};
      for (int k = 0; k < 4; ++k)
        if (faces.corners[f][k] >= 0) meeting.corners[k] = mesh.solids[s].nodes[faces.corners[f][k]];
      std::sort(meeting.corners.begin(), meeting.corners.end());
      all.push_back(meeting);
    }
  }
  std::sort(all.begin(), all.end(), [](const Meeting& a, const Meeting& b) {
    return std::tie(a.corners, a.solid, a.face) < std::tie(b.corners, b.solid, b.face);
  });
  std::vector<Meeting> once;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i + 1;
    while (end < all.size() && all[end].corners == all[i].corners) ++end;
    if (end == i + 1) once.push_back(all[i]);
    i = end;
  }
  std::sort(once.begin(), once.end(),
            [](const Meeting& a, const Meeting& b) { return std::tie(a.solid, a.face) < std::tie(b.solid, b.face); });
  return once;
}

}  // namespace

Surface surface(const Mesh& mesh) {
  SurfaceBuilder builder(mesh);
  const int beams = count_of(mesh.beams), shells = count_of(mesh.shells);
  for (int s = 0; s < shells; ++s) {
    const ShellElement& shell = mesh.shells[s];
    if (shell.corners() == 3)
      builder.triangle(shell.nodes[0], shell.nodes[1], shell.nodes[2], beams + s);
    else
      builder.quadrilateral(shell.nodes, beams + s);
  }
  for (const Meeting& meeting : outer_faces(mesh)) {
    const SolidElement& solid = mesh.solids[meeting.solid];
    const Faces faces = faces_of(solid.shape);
    builder.face(solid, faces, faces.corners[meeting.face], beams + shells + meeting.solid);
  }
  return builder.take();
}

}  // namespace tisserand::reducer
