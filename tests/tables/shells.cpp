// SPDX-License-Identifier: GPL-3.0-or-later
// Plates and shells of the verification page: patch test, statics and frequencies, with the sources of the targets.
#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "reducer/properties/laminate.hpp"
#include "tests/problems/shell_patch.hpp"
#include "tests/problems/shell_statics.hpp"
#include "tests/problems/shell_vibration.hpp"
#include "tests/tables/page.hpp"

namespace tisserand::tables {
namespace {

using namespace reducer;

const char* name(Facets facets) { return facets == Facets::quadrilaterals ? "quads" : "triangles"; }
constexpr Facets both[] = {Facets::quadrilaterals, Facets::triangles};

/// "16 x 32" for every n, cells a·n x b·n.
std::vector<std::string> meshes(const std::vector<int>& n, int a, int b) {
  std::vector<std::string> names;
  for (const int k : n) names.push_back(fmt::format("{} x {}", a * k, b * k));
  return names;
}

/// One number on every mesh, with both elements.
struct Static {
  std::string quantity;
  double target;
  std::function<double(const ShellMesh&)> ours;
};

void add_rows(Problem& problem, const std::vector<int>& n, const std::vector<Static>& quantities) {
  for (const Static& quantity : quantities)
    for (const Facets facets : both) {
      Row row{quantity.quantity, name(facets), quantity.target, Target::published, {}};
      for (const int k : n) row.ours.push_back(quantity.ours({facets, k}));
      problem.rows.push_back(row);
    }
}

/// Some of several frequencies: the place in the list counts the elastic ones from 0.
struct Mode {
  std::string quantity;
  int place;
  double target;
};

struct Vibration {
  std::function<Eigen::VectorXd(const ShellMesh&)> ours;
  int rigid;  ///< modes before the first elastic one
  std::vector<Mode> modes;
};

void add_rows(Problem& problem, const std::vector<int>& n, const Vibration& vibration) {
  for (const Facets facets : both) {
    std::vector<Eigen::VectorXd> values;
    for (const int k : n) values.push_back(vibration.ours({facets, k}));
    for (const Mode& mode : vibration.modes) {
      Row row{mode.quantity, name(facets), mode.target, Target::published, {}};
      for (const Eigen::VectorXd& v : values) row.ours.push_back(v[vibration.rigid + mode.place]);
      problem.rows.push_back(row);
    }
  }
}

const std::string from_memory = "[MH85] (from memory).";

std::vector<Problem> straight_beam_problems() {
  const std::vector<int> n{1, 2, 4, 8}, fine{4, 8, 16};
  Problem problem{"Straight beam",
                  "Displacement of the tip under unit loads. Size 6 x 0.2 x 0.1, E 1e7, nu 0.3. The 6 x 1 mesh "
                  "consists of rectangles, trapezoids or parallelograms (45 degrees). Targets: " +
                      from_memory,
                  meshes(n, 6, 1),
                  {},
                  "Halves of trapezoids or parallelograms, five times as long as wide, are too stiff in in-plane "
                  "bending. They converge: 96 x 16 cells give 0.1052 and 0.1024."};
  const std::pair<Distortion, const char*> shapes[] = {{Distortion::none, "rectangles"},
                                                       {Distortion::trapezoids, "trapezoids"},
                                                       {Distortion::parallelograms, "parallelograms"}};
  const std::tuple<TipLoad, const char*, double> loads[] = {{TipLoad::extension, "extension", 3.0e-5},
                                                            {TipLoad::in_plane, "in plane", 0.1081},
                                                            {TipLoad::out_of_plane, "out of plane", 0.4321}};
  for (const auto& [load, load_name, target] : loads)
    for (const auto& [shape, shape_name] : shapes)
      add_rows(problem, n, {{fmt::format("{}, {}", load_name, shape_name), target, [load, shape](const ShellMesh& m) {
                               return straight_beam(m, shape, load);
                             }}});
  Problem twist{"Straight beam, twist",
                "Rotation of the tip of the straight beam under a unit torque. Target: Saint-Venant's torsion of the "
                "rectangle, TL/(GJ) with J = 4.5736e-5 (exact series). [MH85] has 0.03208 (from memory).",
                meshes(fine, 6, 1),
                {},
                "0.03208 is 6 % below Saint-Venant's value and would need J = 4.863e-5. Refined meshes exceed it. "
                "Transverse shear strains exist only within t/sqrt(10) = 0.03 of the edges. Coarser meshes give values "
                "between 0.0234 (without these strains) and the target. Triangles need finer meshes than quads."};
  add_rows(
      twist, fine,
      {{"twist", 0.034109, [](const ShellMesh& m) { return straight_beam(m, Distortion::none, TipLoad::twist); }}});
  return {problem, twist};
}

Problem curved_beam_problem() {
  const std::vector<int> n{1, 4, 8, 16};
  Problem problem{"Curved beam",
                  "Displacement of the tip under unit loads. Arc of 90 degrees, radii 4.12 and 4.32, t 0.1, E 1e7, nu "
                  "0.25. Target in plane: exact plane-stress solution for a curved bar with a radial force at its end "
                  "(Timoshenko and Goodier, Theory of Elasticity, article 33). Target out of plane: [MH85] (read).",
                  meshes(n, 6, 1),
                  {},
                  "In plane, [MH85] prints 0.08734. This is 1.4 % below the exact 0.088566 and below beam theory, pi P "
                  "R^3/(4 E I) = 0.08853. Out of plane, beam theory without shear gives 0.5003. Torsion converges as "
                  "slowly as in the straight beam."};
  add_rows(problem, n,
           {{"in plane", 0.088566, [](const ShellMesh& m) { return curved_beam(m, TipLoad::in_plane); }},
            {"out of plane", 0.5022, [](const ShellMesh& m) { return curved_beam(m, TipLoad::out_of_plane); }}});
  return problem;
}

Problem twisted_beam_problem() {
  Problem problem{"Twisted beam",
                  "Displacement of the tip under unit loads. Size 12 x 1.1 x 0.32, twisted by 90 degrees, E 29e6, nu "
                  "0.22. Targets: Zupan and Saje 2004 (read), by a beam theory whose sections keep their shape.",
                  meshes({1, 2, 4}, 12, 2),
                  {},
                  ""};
  const auto beam = [](TipLoad load) { return [load](const ShellMesh& m) { return twisted_beam(m, 0.32, load); }; };
  add_rows(problem, {1, 2, 4},
           {{"in plane", 0.005424534868469, beam(TipLoad::in_plane)},
            {"out of plane", 0.001753248285256, beam(TipLoad::out_of_plane)}});
  return problem;
}

Problem rectangular_plates() {
  Problem problem{"Rectangular plates",
                  "Deflection of the centre under a pressure of 1e-4 or a central force of 4e-4; columns: meshes of a "
                  "quarter of the plate. Sides a = 2 and b, t 1e-4, E 1.7472e7, nu 0.3. Targets: [MH85] (from memory). "
                  "Those for b = 2 and for simply supported plates were recomputed by thin-plate series.",
                  meshes({8, 16, 32}, 1, 1),
                  {},
                  "For the clamped plate with b = 10 under pressure [MH85] prints 2.56. At b/a = 5 the short edges "
                  "hardly influence the middle (e^-10), which bends like a strip under the pressure q. The target is "
                  "therefore q a^4/(384 D) = 2.604, which the meshes also give."};
  const auto plate = [](double b, PlateEdges edges, PlateLoad load) {
    return [=](const ShellMesh& m) { return plate_deflection(m, {b, edges, load}); };
  };
  const auto simple = PlateEdges::simply_supported, clamped = PlateEdges::clamped;
  add_rows(problem, {8, 16, 32},
           {{"b = 2, simply supported, pressure", 4.062, plate(2.0, simple, PlateLoad::pressure)},
            {"b = 2, simply supported, force", 11.601, plate(2.0, simple, PlateLoad::force)},
            {"b = 2, clamped, pressure", 1.265, plate(2.0, clamped, PlateLoad::pressure)},
            {"b = 2, clamped, force", 5.612, plate(2.0, clamped, PlateLoad::force)},
            {"b = 10, simply supported, pressure", 12.971, plate(10.0, simple, PlateLoad::pressure)},
            {"b = 10, simply supported, force", 16.961, plate(10.0, simple, PlateLoad::force)},
            {"b = 10, clamped, pressure", 2.604, plate(10.0, clamped, PlateLoad::pressure)},
            {"b = 10, clamped, force", 7.23, plate(10.0, clamped, PlateLoad::force)}});
  return problem;
}

Problem simple_problem(Problem problem, const std::vector<int>& n, const Static& quantity) {
  add_rows(problem, n, {quantity});
  return problem;
}

Problem slit_cylinder_problem() {
  Problem problem{
      "Slit cylinder under torque",
      "A torque T twists a cylinder that is slit along a generator. Results: axial displacement pi C of the edges of "
      "the slit, circumferential displacement C L/R of the end that turns, with C from T = 4 pi D (1 - nu) C/R. "
      "Columns: cells around x cells along. R 300, L 900, t 3, E 3e6, nu 0.3, T 1000. Targets: Morris, NAFEMS P12 "
      "(read in FinEtoolsFlexStructures), exact for a thin shell. The printed formula v = C x lacks the factor 1/R.",
      meshes({1, 2, 4}, 16, 4),
      {},
      "The twisting moment D (1 - nu) C/R^2 = 0.265258 equals T/(4 pi R). The ratio of target to "
      "circumferential displacement is therefore the ratio of the torsional stiffness to its exact value."};
  add_rows(
      problem, {1, 2, 4},
      {{"axial, at the slit", 0.014444, [](const ShellMesh& m) { return slit_cylinder(m).axial; }},
       {"circumferential, at the end", 0.013793, [](const ShellMesh& m) { return slit_cylinder(m).circumferential; }}});
  return problem;
}

}  // namespace

std::vector<Problem> shell_static_problems() {
  std::vector<Problem> problems = straight_beam_problems();
  problems.insert(problems.end(), {curved_beam_problem(), twisted_beam_problem(), rectangular_plates()});
  problems.push_back(simple_problem(
      {"Scordelis-Lo roof",
       "Deflection under a weight of 90 per unit area; columns: meshes of a quarter of the roof. R 25, L 50, t 0.25, "
       "half angle 40 degrees, E 4.32e8, nu 0, diaphragms at both ends. Target: refined shell meshes "
       "(FinEtoolsFlexStructures, commit d7ccda5, read). Shallow-shell theory gives 0.3024, deep-shell theory 0.3008.",
       meshes({8, 16, 32}, 1, 1),
       {},
       ""},
      {8, 16, 32}, {"middle of the free edge", 0.30202, scordelis_lo_roof}));
  problems.push_back(simple_problem(
      {"Pinched cylinder with diaphragms",
       "Displacement under one of two opposite unit forces; columns: meshes of an eighth of the cylinder. R 300, L "
       "600, t 3, E 3e6, nu 0.3. Target: the classical double series without transverse shear "
       "(FinEtoolsFlexStructures, read).",
       meshes({16, 32, 64}, 1, 1),
       {},
       "The series has no shear deformation. With shear deformation the displacement under a concentrated "
       "force grows logarithmically with each refinement, so fine meshes slowly exceed the target."},
      {16, 32, 64}, {"under the load", 1.8248e-5, pinched_cylinder}));
  problems.push_back(simple_problem(
      {"LE5, Z section cantilever",
       "Axial membrane stress [MPa] at a flange tip, x = 2.5 m; columns: cells along the length x cells along the "
       "profile. L 10 m, flanges 1 m, web 2 m, t 0.1 m, E 210e9, nu 0.3. A distributed force on the end of each flange "
       "makes the torque of 1.2 MN m. Target: converged value with these forces at the corners of the web "
       "(FinEtoolsFlexStructures, read). NAFEMS prints -108, from a coarse mesh.",
       meshes({2, 4, 8}, 8, 4),
       {},
       ""},
      {2, 4, 8}, {"axial stress", -111.2, [](const ShellMesh& m) { return 1e-6 * z_section_stress(m); }}));
  problems.push_back(simple_problem(
      {"Cook's membrane",
       "Displacement under a total shear force of 1 on the right edge; the left edge is clamped. Corners (0,0) (48,44) "
       "(48,60) (0,44), t 1, E 1, nu 1/3. Target: from memory; other lists print 23.97.",
       meshes({8, 16, 32}, 1, 1),
       {},
       ""},
      {8, 16, 32}, {"middle of the right edge", 23.96, cooks_membrane}));
  problems.push_back(slit_cylinder_problem());
  return problems;
}

namespace {

Problem square_plates() {
  Problem problem{"Thin square plates",
                  "Frequency parameters omega a^2 sqrt(rho h/D) of a plate of side a and thickness h = 1e-3 a, nu 0.3. "
                  "Targets: computed by the Ritz method with 14 x 14 Legendre polynomials, 6 digits. For the free "
                  "plate Leissa 1973 prints 13.489 19.789 24.432 35.024 61.526. These values are 0 to 0.7 % too high.",
                  meshes({8, 16, 32}, 1, 1),
                  {},
                  ""};
  const auto plate = [](SquareEdges edges) {
    return [edges](const ShellMesh& m) { return square_plate_parameters(m, edges); };
  };
  add_rows(problem, {8, 16, 32},
           Vibration{plate(SquareEdges::simply_supported),
                     0,
                     {{"simply supported, 1", 0, 19.7392},
                      {"simply supported, 2 and 3", 1, 49.3480},
                      {"simply supported, 4", 3, 78.9568}}});
  add_rows(problem, {8, 16, 32},
           Vibration{plate(SquareEdges::clamped),
                     0,
                     {{"clamped, 1", 0, 35.9852},
                      {"clamped, 2 and 3", 1, 73.3938},
                      {"clamped, 4", 3, 108.2165},
                      {"clamped, 5", 4, 131.5808},
                      {"clamped, 6", 5, 132.2048}}});
  add_rows(problem, {8, 16, 32},
           Vibration{plate(SquareEdges::free),
                     0,
                     {{"free, 1", 0, 13.4682},
                      {"free, 2", 1, 19.5961},
                      {"free, 3", 2, 24.2702},
                      {"free, 4 and 5", 3, 34.8009},
                      {"free, 6", 5, 61.0932}}});
  return problem;
}

Problem clamped_cylinder_problem() {
  Problem problem{
      "Clamped cylinder",
      "Frequencies [Hz]; columns: cells around x cells along. R 0.1 m, L 0.4 m, t 0.01 m, E 200e9, nu 0.3, rho 7800, "
      "both ends clamped. Target of the first mode: ADINA (read in FinEtoolsFlexStructures, accuracy not stated). "
      "Target of torsion: sqrt(G/rho)/(2L), exact for a thin wall.",
      meshes({4, 8, 16}, 4, 2),
      {},
      "Clamped ends also hold the drilling rotation (about the normal), which in torsion should be half the shear "
      "strain. This causes an error of order 1. The rows \"drilling free\" hold only the translations of the ends; the "
      "order is 2."};
  add_rows(problem, {4, 8, 16}, Vibration{clamped_cylinder, 0, {{"first (2x)", 0, 1701.0}}});
  const double torsion = std::sqrt(200e9 / 2.6 / 7800.0) / 0.8;
  const auto turn = [](CylinderEnds ends) { return [ends](const ShellMesh& m) { return cylinder_torsion(m, ends); }; };
  add_rows(problem, {4, 8, 16},
           {{"torsion", torsion, turn(CylinderEnds::clamped)},
            {"torsion, drilling free", torsion, turn(CylinderEnds::hinged)}});
  return problem;
}

Problem vibration_problem(Problem problem, const Vibration& vibration) {
  add_rows(problem, {8, 16, 32}, vibration);
  return problem;
}

}  // namespace

std::vector<Problem> shell_vibration_problems() {
  const std::vector<std::string> squares = meshes({8, 16, 32}, 1, 1);
  const std::string steel = "E 200e9, nu 0.3, rho 8000. ";
  std::vector<Problem> problems;
  problems.push_back(
      vibration_problem({"NAFEMS FV12, free square plate",
                         "Frequencies [Hz]. 10 x 10 x 0.05 m, " + steel +
                             "Targets: thin plate by the Ritz method, recomputed. They agree with the revised NAFEMS "
                             "list. Its first print has 4.233 and 7.416 for the two double modes.",
                         squares,
                         {},
                         ""},
                        {free_square_plate,
                         6,
                         {{"7", 0, 1.6217},
                          {"8", 1, 2.3595},
                          {"9", 2, 2.9223},
                          {"10 and 11", 3, 4.1902},
                          {"12 and 13", 5, 7.3560},
                          {"14", 7, 7.6682}}}));
  problems.push_back(
      vibration_problem({"NAFEMS FV15, clamped rhombic plate",
                         "Frequencies [Hz]. Angle 45 degrees, side 10 m, t 0.05 m, " + steel +
                             "Targets: thin plate, computed to 5 digits by the Ritz method with 18 x 18 polynomials in "
                             "oblique coordinates. NAFEMS (read): 7.938 12.835 17.941 19.133 24.009 27.922.",
                         squares,
                         {},
                         ""},
                        {clamped_rhombic_plate,
                         0,
                         {{"1", 0, 7.9038},
                          {"2", 1, 12.8227},
                          {"3", 2, 17.8577},
                          {"4", 3, 18.932},
                          {"5", 4, 23.6927},
                          {"6", 5, 27.6322}}}));
  Problem thick{"NAFEMS FV52, simply supported thick plate",
                "Frequencies [Hz]. 10 x 10 x 1 m, " + steel +
                    "Targets of bending: Mindlin's closed form with the shear factor of our elements, 5/6. With "
                    "pi^2/12 it gives 45.895 109.444 167.886; NAFEMS prints 45.897 109.44 167.89. Targets in the plane "
                    "(free plate): Ritz method, recomputed; NAFEMS prints 193.59 206.19. Another printed list, 44.762 "
                    "110.52 169.08 193.93 206.64, comes from a coarse mesh.",
                squares,
                {},
                ""};
  add_rows(thick, {8, 16, 32},
           Vibration{thick_plate_bending,
                     0,
                     {{"bending 1", 0, 45.911}, {"bending 2 and 3", 1, 109.528}, {"bending 4", 3, 168.074}}});
  add_rows(thick, {8, 16, 32},
           Vibration{thick_plate_in_its_plane, 3, {{"in plane 1", 0, 193.584}, {"in plane 2 and 3", 1, 206.182}}});
  problems.push_back(thick);
  problems.push_back(square_plates());
  problems.push_back(clamped_cylinder_problem());
  return problems;
}

Laws shell_patch_laws() {
  Laws laws{"Patch test",
            "Largest relative errors of displacements, rotations and energy in the patch test of [MH85]. The patch "
            "(0.24 x 0.12, four inner nodes, E 1e6, nu 0.25) is turned in space, with prescribed motions of its outer "
            "nodes. The stresses are 1333, 1333, 400. The moments for t = 0.001 are 1.111e-7, 1.111e-7, 3.333e-8, with "
            "surface stresses 0.667, 0.667, 0.200. Limits: round-off times the condition number (size/thickness)^2.",
            {}};
  for (const Facets facets : both)
    for (const double thickness : {0.001, 0.05}) {
      const ShellSection section = isotropic_shell(1e6, 0.25, 1.0, thickness, 5.0 / 6.0);
      const std::string example = fmt::format("{}, t = {}", name(facets), thickness);
      for (const auto& [state, state_name] :
           {std::pair{patch_membrane(), "membrane"}, std::pair{patch_bending(), "bending"}}) {
        const PatchErrors errors = patch_errors({facets, section, 0.0, state}, Eigen::Vector3d(0.7, -1.1, 0.4));
        laws.laws.push_back({state_name, example, std::max(errors.motion, errors.energy), 1e-9});
      }
    }
  return laws;
}

}  // namespace tisserand::tables
