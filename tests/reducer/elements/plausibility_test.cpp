// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of a part that hardly can be meant are told; what designs may have is not (PART.md, "Numbers that are
// doubted").
#include "reducer/elements/plausibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/properties/laminate.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/varied_numbers.hpp"

namespace tisserand::testing::plausibility_test {
namespace {

using Eigen::Vector3d;
using reducer::Mesh;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A bar of 2 m along x.
Mesh bar() { return reducer::build_mesh(plain_beam(Vector3d::Zero(), Vector3d(2, 0, 0), 20, 0)); }

/// Appends a node that leads some nodes of the bar.
void add_spider(Mesh& mesh, const Vector3d& at, std::vector<int> nodes) {
  mesh.position.conservativeResize(3, mesh.position.cols() + 1);
  mesh.position.col(mesh.position.cols() - 1) = at;
  reducer::Spider spider;
  spider.reference = static_cast<int>(mesh.position.cols()) - 1;
  spider.nodes = std::move(nodes);
  spider.name = "pin";
  mesh.spiders.push_back(spider);
}

std::vector<std::string> doubts(const Mesh& mesh) { return reducer::plausibility_warnings(mesh, Units::si()); }

TEST(DoubtedNumbers, SpidersFarOffWhatTheyHold) {
  Mesh near = bar();
  add_spider(near, Vector3d(1.0, 0, 0.05), {8, 9, 10});
  EXPECT_THAT(doubts(near), IsEmpty());
  // Over the other end of the bar: within its box, and yet far from what it holds.
  Mesh far = bar();
  add_spider(far, Vector3d(0.1, 0, 0), {17, 18, 19});
  EXPECT_THAT(doubts(far), ElementsAre(AllOf(HasSubstr("the node of spider 'pin' lies 1."),
                                             HasSubstr("m away from the nodes that it holds; the part is 2 m large"))));
  Mesh link = bar();
  add_spider(link, Vector3d(0.1, 0, 0), {19});
  EXPECT_THAT(doubts(link), IsEmpty()) << "a rigid link between two nodes is as long as it is";
}

TEST(DoubtedNumbers, OffsetsOfManyThicknesses) {
  Mesh mesh = bar();
  const formats::Section& section = mesh.beam_properties[0].data.section;
  const double thickness = std::sqrt(12.0 * std::max(section.second_moment_y, section.second_moment_z) / section.area);
  for (reducer::BeamElement& beam : mesh.beams)
    beam.first_offset = beam.second_offset = 10.0 * thickness * Vector3d::UnitZ();
  EXPECT_THAT(doubts(mesh), IsEmpty());
  for (reducer::BeamElement& beam : mesh.beams)
    beam.first_offset = beam.second_offset = 100.0 * thickness * Vector3d::UnitZ();
  EXPECT_THAT(doubts(mesh),
              ElementsAre(AllOf(HasSubstr("lie"), HasSubstr("away from their nodes, 100 times their thickness"))));
}

TEST(DoubtedNumbers, OffsetsOfShells) {
  Mesh mesh;
  mesh.position.resize(3, 4);
  mesh.position << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0;
  mesh.shells.push_back({{0, 1, 2, 3}, 0, 0.05, Vector3d::Zero(), 1});
  reducer::ShellProperty skin;
  skin.section = reducer::isotropic_shell(2.1e11, 0.3, 7850.0, 0.01, 5.0 / 6.0);
  skin.name = "skin";
  mesh.shell_properties.push_back(skin);
  EXPECT_THAT(doubts(mesh), IsEmpty());
  mesh.shells[0].offset = -1.0;
  EXPECT_THAT(doubts(mesh), ElementsAre(HasSubstr("the shells of 'skin' lie 1 m away from their nodes, 100 times")));
}

TEST(DoubtedNumbers, MassesThatDwarfThePart) {
  Mesh mesh = bar();
  formats::RigidProperties rigid;
  const auto reported = [&](double mass, const Vector3d& offset) {
    mesh.masses = {{0, mass, Eigen::Matrix3d::Zero(), offset, "payload"}};
    rigid.mass = 5.0 + mass;
    rigid.center_of_mass = (5.0 * Vector3d(1, 0, 0) + mass * offset) / rigid.mass;
    return reducer::mass_warnings(mesh, rigid, Units::si());
  };
  EXPECT_THAT(reported(250.0, Vector3d::Zero()), IsEmpty());
  EXPECT_THAT(reported(2500.0, Vector3d::Zero()),
              ElementsAre(HasSubstr("point mass 'payload' of 2500 kg is 500 times the mass of all elements, 5 kg")));
  EXPECT_THAT(reported(50.0, Vector3d(0, 0, -1.5)), IsEmpty());
  EXPECT_THAT(reported(50.0, Vector3d(0, 0, -300.0)),
              ElementsAre(AllOf(HasSubstr("the centre of mass of the part lies 272.7 m away from its nodes"),
                                HasSubstr("which extend over 2 m"))));
}

// What gmsh meshes is left out, and variations that cannot be built.
TEST(DoubtedNumbers, AreSilentAboutExamplesAndTheirVariations) {
  const test_support::TemporaryFolder folder;
  namespace fs = std::filesystem;
  std::mt19937 random(7);
  int reported = 0;
  for (const auto& entry : fs::recursive_directory_iterator(TISSERAND_SOURCE_DIR "/examples")) {
    const std::string original = entry.path().string();
    if (!original.ends_with(".part.yaml")) continue;
    std::ifstream file(original);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (text.find("mesh:") != std::string::npos) continue;
    for (int round = 0; round < 9; ++round) {
      const std::string path = folder.file("varied.part.yaml");
      write_text_file(path, round == 0 ? text : test_support::varied(text, random));
      try {
        const formats::Part part = formats::read_part(path, {});
        EXPECT_THAT(reducer::plausibility_warnings(reducer::build_mesh(part), part.units, part.materials), IsEmpty())
            << original << " round " << round;
        ++reported;
      } catch (const Error& error) {
        EXPECT_GT(round, 0) << error.what();
      }
    }
  }
  EXPECT_GT(reported, 100);
}

}  // namespace
}  // namespace tisserand::testing::plausibility_test
