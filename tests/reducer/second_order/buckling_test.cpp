// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of buckling of reduced parts against Euler, plates, the full model of the same mesh, and an independent
// program.
#include <cmath>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/reducer/second_order/reduced_buckling.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::reducer::reduced_buckling_test {
namespace {

// One cubic between the ends has 12, 30 and 2.4860 EI/L² (tables of beam elements); with modes the values of an
// independent program of this theory, whose tolerance is half of their last digit.
TEST(ReducedBuckling, ColumnsOfFourEndConditions) {
  const double pi2 = std::numbers::pi * std::numbers::pi;
  struct Known {
    ColumnEnds ends;
    int modes;
    double ratio, tolerance;
  };
  for (const Known& known : {Known{ColumnEnds::pinned, 0, 12.0 / pi2, 1e-6},
                             {ColumnEnds::clamped_pinned, 0, 30.0 / pi2 / 2.045748, 1e-6},
                             {ColumnEnds::clamped_free, 0, (52.0 - std::sqrt(1984.0)) / 3.0 / (0.25 * pi2), 1e-6},
                             {ColumnEnds::clamped, 4, 1.031, 5e-4},
                             {ColumnEnds::clamped_pinned, 4, 1.0012, 5e-5},
                             {ColumnEnds::clamped_free, 4, 1.00005, 5e-6},
                             {ColumnEnds::clamped, 8, 1.0022, 5e-5},
                             {ColumnEnds::clamped_pinned, 8, 1.0002, 5e-5},
                             {ColumnEnds::clamped_free, 8, 1.00001, 5e-6}}) {
    // The independent program's tangent has the shortening P/EA under the load, twice.
    const double shortening = known.modes > 0 ? 2.0 * euler_factor(known.ends) * pi2 * 1e-6 : 0.0;
    EXPECT_NEAR(reduced_column(known.ends, known.modes) * (1.0 + shortening), known.ratio, known.tolerance)
        << static_cast<int>(known.ends) << " " << known.modes;
  }
}

// What more modes leave out can only lower the load, down to Euler's.
TEST(ReducedBuckling, LoadsFallToEulersWithMoreModes) {
  for (const ColumnEnds ends :
       {ColumnEnds::pinned, ColumnEnds::clamped_free, ColumnEnds::clamped_pinned, ColumnEnds::clamped}) {
    double before = reduced_column(ends, 4);
    for (const int modes : {8, 12, 20}) {
      const double load = reduced_column(ends, modes);
      EXPECT_LE(load, before * (1.0 + 1e-12)) << static_cast<int>(ends) << " " << modes;
      EXPECT_GE(load, 1.0 - 1e-7) << static_cast<int>(ends) << " " << modes;
      before = load;
    }
    EXPECT_LT(before, 1.0 + 2e-4) << static_cast<int>(ends);
  }
}

// Torsion must be among the modes; with axial forces alone in K_G it would be 1.305 for all. The independent program's
// loads are of the bent strip, which turns over at up to ½ (EI_y + GJ)/EI_z = 0.0009 more.
TEST(ReducedBuckling, StripTurnsOverAtTheKnownLoads) {
  std::ifstream file(std::string(TISSERAND_REFERENCES) + "/second_order_known_answers.json");
  const nlohmann::json physics = nlohmann::json::parse(file).at("physics");
  const std::vector<double> known = physics.at("lateral_buckling").at("values");
  for (int i = 0; i < 4; ++i) {
    const double ratio = known.at(static_cast<std::size_t>(i)) / reduced_strip(4 * i);
    EXPECT_GT(ratio, 1.0) << 4 * i;
    EXPECT_LT(ratio, 1.001) << 4 * i;
  }
}

TEST(ReducedBuckling, BoxColumnOfShells) {
  for (const int modes : {4, 8}) {
    EXPECT_NEAR(reduced_box_column(modes), 1.0, 0.01) << modes;
  }
}

// Between the two formulas for shear; tolerances are those of the same meshes without a reduction (buckling_test of the
// elements).
TEST(ReducedBuckling, ColumnsOfSolids) {
  for (const auto& [shape, cells, tolerance] : {std::tuple{SolidShape::hexahedron8, 10, 0.01},
                                                {SolidShape::hexahedron20, 6, 0.004},
                                                {SolidShape::tetrahedron10, 6, 0.005},
                                                {SolidShape::prism15, 6, 0.005}}) {
    const SolidColumn column = reduced_solid_column(shape, cells, 8);
    EXPECT_GT(column.load, column.engesser * (1.0 - 0.002)) << solid_name(shape);
    EXPECT_LT(column.load, column.haringx * (1.0 + tolerance)) << solid_name(shape);
  }
}

// The first mode with the edges held is the shape of buckling under pressure: one mode does. In shear Ritz's method
// takes modes (1,1) and (2,2), 11.1 π² D/b² (Timoshenko and Gere 1961, 9.7), and more.
TEST(ReducedBuckling, PlatesFallToTheFullModel) {
  for (const Facets facets : {Facets::quadrilaterals, Facets::triangles}) {
    const ShellMesh mesh{facets, 8};
    const double pressed = full_plate(PlatePreload::compression, mesh), sheared = full_plate(PlatePreload::shear, mesh);
    const double one = reduced_plate(PlatePreload::compression, mesh, 1);
    const double few = reduced_plate(PlatePreload::shear, mesh, 4), many = reduced_plate(PlatePreload::shear, mesh, 12);
    EXPECT_GE(one, pressed * (1.0 - 1e-7));
    EXPECT_LT(one, pressed * 1.002);
    EXPECT_NEAR(few / sheared, 11.1 / 9.325, 0.03);
    EXPECT_GE(many, sheared * (1.0 - 1e-7));
    EXPECT_LT(many, sheared * 1.02);
    if (facets != Facets::quadrilaterals) continue;
    EXPECT_NEAR(pressed / exact_plate(PlatePreload::compression), 1.0, 0.03);
    EXPECT_NEAR(sheared / exact_plate(PlatePreload::shear), 1.0, 0.03);
  }
}

TEST(ReducedBuckling, PanelOfACylinder) {
  const double full = full_panel(8), one = reduced_panel(8, 1), many = reduced_panel(8, 8);
  EXPECT_NEAR(full / exact_panel(), 1.0, 0.03);
  EXPECT_GT(exact_panel(), 4.5);  // half a unit of it is the curvature's
  EXPECT_GE(many, full * (1.0 - 1e-7));
  EXPECT_LT(many, full * 1.005);
  EXPECT_LE(many, one * (1.0 + 1e-12));
}

}  // namespace
}  // namespace tisserand::reducer::reduced_buckling_test
