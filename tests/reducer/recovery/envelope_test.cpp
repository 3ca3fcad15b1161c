// SPDX-License-Identifier: GPL-3.0-or-later
// Envelopes and histories of `recover` against stresses that the test itself makes from the fields, instant by instant.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "common/error.hpp"
#include "formats/sections/profiles.hpp"
#include "reducer/properties/laminate.hpp"
#include "reducer/properties/solid_material.hpp"
#include "reducer/recover/places.hpp"
#include "reducer/recover/recover.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/recovery/recovered.hpp"
#include "tests/reducer/recovery/stored_run.hpp"
#include "tests/support/meshes/shell_grids.hpp"
#include "tests/support/meshes/solid_mesh.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/vtk/vtu_reader.hpp"

namespace tisserand::testing::envelope_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::RecoveryField;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int instants = 300;  // more than one batch
constexpr double round_off = 5e-6;

/// Cells of a line of CSV, without their quotes.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells{""};
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

/// A table by heading.
struct Table {
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> line;

  const std::string& text(std::size_t row, const std::string& name) const {
    const auto column = std::find(heading.begin(), heading.end(), name) - heading.begin();
    return line.at(row).at(static_cast<std::size_t>(column));
  }
  double number(std::size_t row, const std::string& name) const { return std::stod(text(row, name)); }
};

Table read_table(const std::string& path) {
  Table table;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    table.heading.empty() ? void(table.heading = cells_of(line)) : table.line.push_back(cells_of(line));
  return table;
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Stresses of an element at the places that it has, at one instant: [largest |normal| or von Mises, principals].
struct AtPlace {
  std::string place;
  double von_mises, largest, smallest;
};

AtPlace at_place(const std::string& place, const Eigen::Matrix3d& tensor, bool in_plane) {
  const Eigen::Matrix3d deviator = tensor - tensor.trace() / 3.0 * Eigen::Matrix3d::Identity();
  const double von_mises = std::sqrt(1.5 * deviator.squaredNorm());
  if (in_plane) {
    const Eigen::Vector2d s =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(Eigen::Matrix2d(tensor.topLeftCorner<2, 2>())).eigenvalues();
    return {place, von_mises, s[1], s[0]};
  }
  const Vector3d s = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor).eigenvalues();
  return {place, von_mises, s[2], s[0]};
}

/// The places of an element by the numbers of its fields, which are those of a recovery file in memory.
std::vector<AtPlace> places_of(const Recovered& data, int element, const VectorXd& y) {
  const formats::Recovery& r = data.tables;
  std::vector<AtPlace> found;
  const auto rows = [&](RecoveryField field, Index first, Index count) {
    return VectorXd(data.of(field).middleRows(first, count) * y);
  };
  if (element < r.beams()) {
    const VectorXd f = rows(RecoveryField::beam_force, 12 * element, 12);
    for (int end = 0; end < 2; ++end) {
      const auto& section =
          r.sections[static_cast<std::size_t>(r.beam_section[static_cast<std::size_t>(2 * element + end)])];
      for (const Eigen::Vector2d& corner : section.outline) {  // doubly symmetric sections about their centroid
        const double s = f[6 * end] / section.area + f[6 * end + 4] * corner.y() / section.second_moment_y -
                         f[6 * end + 5] * corner.x() / section.second_moment_z;
        found.push_back(
            {fmt::format("end {} (y {:.4g}, z {:.4g})", end + 1, corner.x(), corner.y()), std::abs(s), s, s});
      }
    }
    return found;
  }
  if (const Index shell = element - r.beams(); shell < r.shells()) {
    const VectorXd s = rows(RecoveryField::shell_stress, 6 * shell, 6);
    for (const double face : {1.0, -1.0}) {
      const Vector3d plane = s.head<3>() + face * s.tail<3>();
      Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
      tensor.topLeftCorner<2, 2>() << plane[0], plane[2], plane[2], plane[1];
      found.push_back(at_place(face > 0.0 ? "top" : "bottom", tensor, true));
    }
    return found;
  }
  const auto e = static_cast<std::size_t>(element);
  for (int k = r.elements.first[e]; k < r.elements.first[e + 1]; ++k) {
    const int node = r.elements.node[static_cast<std::size_t>(k)];
    const auto point = std::find(r.stress_node.begin(), r.stress_node.end(), node) - r.stress_node.begin();
    const VectorXd s = rows(RecoveryField::solid_stress, 6 * point, 6);
    Eigen::Matrix3d tensor;
    tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    found.push_back(at_place(r.node_label[static_cast<std::size_t>(node)], tensor, false));
  }
  return found;
}

reducer::Mesh beams() {
  formats::Part part = plain_beam({0, 0, 0}, {2, 0, 0}, 6, 2);
  part.sections = {formats::shape_section("rectangle", {0.02, 0.03})};
  part.sections[0].name = part.beams[0].section;
  return reducer::build_mesh(part);
}

reducer::Mesh shells() {
  const reducer::GridShape grid{4, 3, reducer::Facets::quadrilaterals, false};
  reducer::Mesh mesh = reducer::shell_grid(
      grid,
      [](double a, double b) -> Vector3d {
        return {a, 0.7 * b, 0.0};
      },
      reducer::isotropic_shell(2.1e11, 0.3, 7800.0, 0.02, 5.0 / 6.0));
  set_boundary(mesh, {reducer::grid_node(grid, 0, 0), reducer::grid_node(grid, 4, 3)}, true);
  return mesh;
}

reducer::Mesh solids() {
  reducer::Mesh mesh = reducer::solid_block({reducer::SolidShape::tetrahedron10, {2, 1, 1}, {2.0, 1.0, 0.8}, 0.1},
                                            {reducer::isotropic_solid(2.1e11, 0.3, 7800.0), {}, "body"});
  set_boundary(mesh, {0, 1, 2, 3}, false);
  return mesh;
}

/// A body whose coordinates are random at 300 instants.
struct Random {
  explicit Random(const reducer::Mesh& mesh) : data(recovered(mesh, 3)) {
    for (int e = 0; e < data.tables.elements.count(); ++e) data.tables.elements.id[static_cast<std::size_t>(e)] = e + 1;
    std::mt19937 numbers(7);
    std::uniform_real_distribution<double> amplitude(-1e-3, 1e-3);
    for (int t = 0; t < instants; ++t) {
      VectorXd y(data.tables.coordinates());
      for (Index k = 0; k < y.size(); ++k) y[k] = amplitude(numbers);
      run.y.push_back(y);
    }
    run.ids = {data.tables.content_id};
    write(data, folder.file("arm.recovery.h5"));
    write(run, folder.file("run.results.h5"));
    request.recovery = folder.file("arm.recovery.h5");
    request.results = folder.file("run.results.h5");
    request.output = folder.file("out");
    request.envelope_only = true;
  }

  std::string file(const std::string& name) const { return folder.file("out/arm" + name); }

  const test_support::TemporaryFolder folder;
  Recovered data;
  StoredRun run;
  reducer::RecoverRequest request;
};

/// A number, time and place of the table: the largest over all instants and places, and the value where the table says.
void expect_largest(const Random& body, const Table& table, int element, const std::string& name,
                    double AtPlace::*quantity, double sign, const std::vector<std::vector<AtPlace>>& over_time) {
  const auto row = static_cast<std::size_t>(element);
  double largest = -1e300;
  for (const std::vector<AtPlace>& places : over_time)
    for (const AtPlace& at : places) largest = std::max(largest, sign * (at.*quantity));
  const double reported = table.number(row, name + " [Pa]"), tolerance = round_off * std::abs(largest);
  EXPECT_NEAR(sign * reported, largest, tolerance) << element << ' ' << name;
  const auto instant = static_cast<std::size_t>(std::lround(10.0 * table.number(row, name + "_time [s]")));
  ASSERT_LT(instant, over_time.size());
  const std::vector<AtPlace>& places = over_time[instant];
  const auto at = std::find_if(places.begin(), places.end(),
                               [&](const AtPlace& one) { return one.place == table.text(row, name + "_place"); });
  ASSERT_NE(at, places.end()) << table.text(row, name + "_place");
  EXPECT_NEAR((*at).*quantity, reported, tolerance) << element << ' ' << name << ' ' << at->place;
  static_cast<void>(body);
}

// Expected values: the fields of the reduction in 64 bits times y, at every instant and every place.
TEST(Envelope, HoldsTheLargestOfEveryElementWithPlaceAndTime) {
  for (const reducer::Mesh& mesh : {beams(), shells(), solids()}) {
    const Random body(mesh);
    EXPECT_THAT(reducer::recover(body.request),
                AllOf(HasSubstr("largest principal stress"), HasSubstr("300 instants")));
    const Table table = read_table(body.file("_envelope.csv"));
    const int elements = body.data.tables.elements.count();
    ASSERT_EQ(table.line.size(), static_cast<std::size_t>(elements));
    for (int e = 0; e < elements; ++e) {
      std::vector<std::vector<AtPlace>> over_time;
      for (const VectorXd& y : body.run.y) over_time.push_back(places_of(body.data, e, y));
      EXPECT_EQ(table.text(static_cast<std::size_t>(e), "element"),
                std::to_string(body.data.tables.elements.id[static_cast<std::size_t>(e)]));
      expect_largest(body, table, e, "von_mises", &AtPlace::von_mises, 1.0, over_time);
      expect_largest(body, table, e, "largest_principal", &AtPlace::largest, 1.0, over_time);
      expect_largest(body, table, e, "smallest_principal", &AtPlace::smallest, -1.0, over_time);
    }
    const test_support::VtuFile grid = test_support::read_vtu(body.file("_envelope.vtu"));
    for (std::size_t e = 0; e < table.line.size(); ++e) {
      const double smallest = table.number(e, "smallest_principal [Pa]");
      EXPECT_NEAR(grid.arrays.at("smallest_principal").at(e), smallest, 1e-6 * std::abs(smallest));
      EXPECT_NEAR(grid.arrays.at("largest_principal_time").at(e), table.number(e, "largest_principal_time [s]"), 1e-5);
      EXPECT_GE(grid.arrays.at("von_mises_place").at(e), 1.0);
    }
  }
}

// With a series, in other batches, the envelope is the same file.
TEST(Envelope, IsTheSameWithASeries) {
  Random body(shells());
  body.request.every = 3;
  body.request.groups = {body.data.tables.group_name[0]};
  body.request.points = {"0,0,0"};
  std::map<std::string, std::string> alone;
  reducer::recover(body.request);
  for (const char* ending : {"_envelope.csv", "_envelope.vtu", "_groups.csv", "_points.csv"})
    alone[ending] = text_of(body.file(ending));
  EXPECT_FALSE(std::ifstream(body.file(".pvd")).good());
  body.request.envelope_only = false;
  reducer::recover(body.request);
  EXPECT_EQ(test_support::read_pvd(body.file(".pvd")).size(), 100u);
  for (const auto& [ending, text] : alone) EXPECT_EQ(text_of(body.file(ending)), text) << ending;
}

// A scene in mm, t, s shows N/mm², and lengths of places in mm.
TEST(Envelope, HasTheUnitsOfTheScene) {
  Random body(beams());
  body.run.units = {{1e-3, "mm"}, {1e3, "t"}, {1.0, "s"}};
  VectorXd y = body.run.y[0];
  body.run.y = {y};
  for (Index k = 0; k < y.size(); ++k)
    if (body.data.tables.dof_node[static_cast<std::size_t>(k)] >= 0 &&
        body.data.tables.dof_component[static_cast<std::size_t>(k)] < 3)
      body.run.y[0][k] *= 1e3;
  write(body.run, body.request.results);
  body.request.elements = {"1"};
  reducer::recover(body.request);
  const Table table = read_table(body.file("_envelope.csv"));
  double largest = 0.0;
  for (const AtPlace& at : places_of(body.data, 0, y)) largest = std::max(largest, at.von_mises);
  EXPECT_NEAR(table.number(0, "von_mises [MPa]"), 1e-6 * largest, 1e-6 * round_off * largest);
  EXPECT_THAT(table.text(0, "von_mises_place"), HasSubstr("(y "));
  EXPECT_THAT(table.text(0, "von_mises_place"), ::testing::ContainsRegex("1[05]"));  // half of 20 or 30 mm
  const VectorXd force = body.data.of(RecoveryField::beam_force).topRows(12) * y;
  const Table history = read_table(body.file("_elements.csv"));
  EXPECT_NEAR(history.number(0, "1/N_1 [N]"), force[0], 1e-5 * force.norm());
  EXPECT_NEAR(history.number(0, "1/Mz_2 [N mm]"), 1e3 * force[11], 1e-2 * force.norm());
}

/// Number of the first element of a file, and its group.
std::string first_element(const Recovered& data, int element) {
  const auto e = static_cast<std::size_t>(element);
  return data.tables.group_name[static_cast<std::size_t>(data.tables.elements.group[e])] + "/" +
         std::to_string(data.tables.elements.id[e]);
}

TEST(Histories, OfElementsAndGroupsAreThoseOfEveryInstant) {
  for (const reducer::Mesh& mesh : {beams(), shells(), solids()}) {
    Random body(mesh);
    const std::string element = first_element(body.data, 1), group = body.data.tables.group_name[0];
    body.request.elements = {element};
    body.request.groups = {group};
    reducer::recover(body.request);
    const Table one = read_table(body.file("_elements.csv")), all = read_table(body.file("_groups.csv"));
    ASSERT_EQ(one.line.size(), static_cast<std::size_t>(instants));
    ASSERT_EQ(all.line.size(), static_cast<std::size_t>(instants));
    const bool is_beam = body.data.tables.beams() > 0, is_shell = body.data.tables.shells() > 0;
    for (std::size_t t = 0; t < one.line.size(); t += 37) {
      AtPlace worst{"", 0.0, -1e300, 1e300}, of_group = worst;
      for (int e = 0; e < body.data.tables.elements.count(); ++e)
        for (const AtPlace& at : places_of(body.data, e, body.run.y[t]))
          for (AtPlace* sum : {&of_group, &worst}) {
            if (sum == &worst && e != 1) continue;
            sum->von_mises = std::max(sum->von_mises, at.von_mises);
            sum->largest = std::max(sum->largest, at.largest);
            sum->smallest = std::min(sum->smallest, at.smallest);
          }
      const double size = round_off * of_group.von_mises;
      const std::string kind = is_beam ? "_normal [Pa]" : "_principal [Pa]";
      EXPECT_NEAR(one.number(t, element + "/largest" + kind), worst.largest, size);
      EXPECT_NEAR(one.number(t, element + "/smallest" + kind), worst.smallest, size);
      if (is_shell) {
        EXPECT_NEAR(
            std::max(one.number(t, element + "/von_mises_top [Pa]"), one.number(t, element + "/von_mises_bottom [Pa]")),
            worst.von_mises, size);
      }
      EXPECT_NEAR(all.number(t, group + "/von_mises [Pa]"), of_group.von_mises, size);
      EXPECT_NEAR(all.number(t, group + "/largest_principal [Pa]"), of_group.largest, size);
      EXPECT_NEAR(all.number(t, group + "/smallest_principal [Pa]"), of_group.smallest, size);
      EXPECT_NEAR(all.number(t, "time [s]"), 0.1 * static_cast<double>(t), 1e-12);
    }
  }
}

std::string error_of(const reducer::RecoverRequest& request) {
  try {
    reducer::recover(request);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Histories, WordsThatMeanNothingAreErrors) {
  Random body(solids());
  const auto with = [&](std::vector<std::string> reducer::RecoverRequest::*list, const std::string& word) {
    reducer::RecoverRequest request = body.request;
    (request.*list).push_back(word);
    return error_of(request);
  };
  EXPECT_THAT(with(&reducer::RecoverRequest::elements, "9999"), HasSubstr("has no element '9999'"));
  EXPECT_THAT(with(&reducer::RecoverRequest::elements, "body/x"),
              HasSubstr("'body/x' is not the number of an element"));
  EXPECT_THAT(with(&reducer::RecoverRequest::elements, "wing/1"),
              AllOf(HasSubstr("no group 'wing'"), HasSubstr("body")));
  EXPECT_THAT(with(&reducer::RecoverRequest::groups, "bdy"), AllOf(HasSubstr("no group 'bdy'"), HasSubstr("body")));
  EXPECT_FALSE(std::ifstream(body.file("_envelope.csv")).good()) << "nothing is written after a fault";
}

// The results of this test hold no acceleration of the frame, as those before version 1.10.
TEST(Histories, LoadsNeedTheMotionOfTheFrame) {
  Random body(solids());
  body.request.loads = {reducer::LoadFormat::nastran};
  EXPECT_THAT(error_of(body.request), AllOf(HasSubstr("do not hold the acceleration"), HasSubstr("1.10")));
  EXPECT_FALSE(std::ifstream(body.file("_envelope.csv")).good());
}

}  // namespace
}  // namespace tisserand::testing::envelope_test
