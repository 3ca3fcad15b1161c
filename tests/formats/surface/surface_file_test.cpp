// SPDX-License-Identifier: GPL-3.0-or-later
// STL and OBJ files, good and broken ones.
#include "formats/surface/surface_file.hpp"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::surface_file_test {
namespace {

using ::testing::HasSubstr;

const std::string text_stl = R"(solid wedge
 facet normal 0 0 1
  outer loop
   vertex 0 0 0
   vertex 1 0 0
   vertex 0 1e0 0
  endloop
 endfacet
 facet normal 0 0 1
  outer loop
   vertex 1 0 0
   vertex 1 1 0
   vertex 0 1 0
  endloop
 endfacet
endsolid wedge
)";

/// One triangle of binary STL; `head` promises `count`.
std::string binary_stl(std::uint32_t count, float last) {
  std::string bytes = "solid that is binary";
  bytes.resize(80, '\0');
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  const float numbers[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, last};
  bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
  return bytes + std::string(2, '\0');
}

TriangleSurface read(const std::string& name, const std::string& bytes) {
  const Folder folder;
  return read_surface_file(folder.file(name, bytes));
}

std::string error(const std::string& name, const std::string& bytes) {
  try {
    (void)read(name, bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(SurfaceFile, JoinsTheCornersOfTextStl) {
  const TriangleSurface surface = read("a.STL", text_stl);
  EXPECT_EQ(surface.vertices.size(), 4u);
  EXPECT_THAT(surface.triangles, ::testing::ElementsAre(std::array{0, 1, 2}, std::array{1, 3, 2}));
  EXPECT_EQ(surface.vertices[3], Eigen::Vector3d(1, 1, 0));
}

TEST(SurfaceFile, ReadsBinaryStlAlsoIfItBeginsWithSolid) {
  const TriangleSurface surface = read("a.stl", binary_stl(1, 0.5f));
  ASSERT_EQ(surface.triangles.size(), 1u);
  EXPECT_EQ(surface.vertices[2], Eigen::Vector3d(0, 1, 0.5));
}

TEST(SurfaceFile, ReadsFacesOfObjAsFans) {
  const TriangleSurface surface = read(
      "a.obj", "# quad\nv 0 0 0\nv +1 0 0\nv 1 1 0 1.0\r\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1 4/1\nf -4//1 -3//1 -1//1\n");
  EXPECT_THAT(surface.triangles, ::testing::ElementsAre(std::array{0, 1, 2}, std::array{0, 2, 3}, std::array{0, 1, 3}));
}

TEST(SurfaceFile, RefusesBrokenFilesAndSaysWhere) {
  EXPECT_THAT(error("a.stl", binary_stl(2, 0)), HasSubstr("has 1 of the 2 triangles"));
  EXPECT_THAT(error("a.stl", binary_stl(4'000'000'000u, 0)), HasSubstr("has 1 of the 4000000000 triangles"));
  EXPECT_THAT(error("a.stl", binary_stl(1, std::numeric_limits<float>::quiet_NaN())), HasSubstr("triangle 1"));
  EXPECT_THAT(error("a.stl", text_stl.substr(0, 200)), HasSubstr("is incomplete"));
  EXPECT_THAT(error("a.stl", "solid\nfacet\nvertex 0 0 x\n"), HasSubstr("a.stl:3: 'x' is not a finite number"));
  EXPECT_THAT(error("a.stl", "solid\nfacet\nvertex 0 0 1e999\n"), HasSubstr("is not a finite number"));
  EXPECT_THAT(error("a.stl", "solid\nfacet\nvertex 0 0\n"), HasSubstr("the line has fewer than three coordinates"));
  EXPECT_THAT(error("a.stl", "solid\nfacet\nvertex 0 0 1\nendfacet\n"),
              HasSubstr("a facet has 1 vertices instead of 3"));
  EXPECT_THAT(error("a.stl", ""), HasSubstr("is incomplete"));
  EXPECT_THAT(error("a.stl", "solid\nfacet\nendsolid\n"), HasSubstr("has no triangles"));
  EXPECT_THAT(error("a.obj", "v 0 0 0\nf 1 2 3\n"), HasSubstr("a.obj:2: a face refers to vertex '2', but there are 1"));
  EXPECT_THAT(error("a.obj", "v 0 0 0\nf 1 1\n"), HasSubstr("a face has fewer than three vertices"));
  EXPECT_THAT(error("a.obj", "v 0 0 0\nf 0 1 1\n"), HasSubstr("vertex '0'"));
  EXPECT_THAT(error("a.obj", "nothing here\n"), HasSubstr("has no triangles"));
  EXPECT_THAT(error_of(Folder(), [] { (void)read_surface_file("/nowhere/a.stl"); }), HasSubstr("no such file"));
}

}  // namespace
}  // namespace tisserand::formats::surface_file_test
