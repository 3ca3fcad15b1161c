// SPDX-License-Identifier: GPL-3.0-or-later
// Table and VTU files.
#include "reducer/solve/files.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/program/version.hpp"
#include "common/text.hpp"
#include "formats/vtk/vtu.hpp"
#include "reducer/recover/places.hpp"
#include "reducer/recover/vtu_data.hpp"
#include "reducer/report/certificate.hpp"
#include "reducer/view/part_page.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;

std::string case_file(const std::string& stem, const std::string& name) { return fmt::format("{}.{}.vtu", stem, name); }

/// Names of nodes with their numbers, each name once.
std::vector<std::pair<std::string, int>> named_nodes(const Solution& s, const formats::Part& part,
                                                     const SolveRequest& request) {
  std::vector<std::pair<std::string, int>> nodes;
  const auto add = [&nodes](const std::string& name, int node) {
    if (std::ranges::find(nodes, name, &std::pair<std::string, int>::first) == nodes.end())
      nodes.emplace_back(name, node);
  };
  for (const MeshBoundary& boundary : s.mesh.boundary) add(boundary.name, boundary.node);
  std::vector<std::string> names;
  for (const formats::NamedPoint& point : part.points) names.push_back(point.name);
  for (const formats::SpiderLine& spider : part.spiders) names.push_back(spider.name);
  for (const std::string& name : names)
    if (const auto label = std::ranges::find(s.mesh.node_label, name); label != s.mesh.node_label.end())
      add(name, static_cast<int>(label - s.mesh.node_label.begin()));
  for (const std::string& point : request.points) add(point, find_node(s.tables, point, part.file));
  return nodes;
}

/// Array of the rows [from, from + 3) of every node for one state.
formats::VtuArray vectors(const std::string& name, const Eigen::MatrixXd& motion, Index column, Index from,
                          double factor) {
  formats::VtuArray array{name, 3, {}};
  for (Index node = 0; node < motion.rows() / 6; ++node)
    for (Index k = 0; k < 3; ++k)
      array.values.push_back(static_cast<float>(factor * motion(6 * node + from + k, column)));
  return array;
}

void write_cases(const Solution& s, const std::string& stem, const formats::VtuCells& cells) {
  const Eigen::MatrixXd motion = node_motions(s.system, s.statics.q);
  const SolidPoints points = solid_points(s.tables);
  for (Index c = 0; c < motion.cols(); ++c) {
    const InstantValues values = instant_values(s.tables, points, s.fields, c);
    std::vector<formats::VtuArray> on_points =
        vtu_point_data(s.tables, s.fields, values, Eigen::Matrix3d::Identity(), c);
    on_points.insert(on_points.begin() + 1, vectors("rotation", motion, c, 3, 1.0));
    formats::write_vtu(case_file(stem, s.mesh.load_cases[c].name), producer("reducer"), s.mesh.position.cast<float>(),
                       cells, on_points, vtu_cell_data(s.tables, s.fields, values, c));
  }
}

std::string buckling_file(const std::string& stem, const std::string& name) {
  return case_file(stem + "-buckling", name);
}

/// Name of a load case, and motions of the nodes in its shapes.
struct CaseShapes {
  const std::string& name;
  const CaseBuckling& buckling;
  Eigen::MatrixXd motion;
};

std::vector<CaseShapes> shapes_of(const Solution& s) {
  std::vector<CaseShapes> shapes;
  for (std::size_t c = 0; c < s.buckling.size(); ++c)
    shapes.push_back({s.mesh.load_cases[c].name, s.buckling[c], node_motions(s.system, s.buckling[c].q)});
  return shapes;
}

void write_buckling(const Solution& s, const std::string& stem, const formats::VtuCells& cells) {
  for (const CaseShapes& shapes : shapes_of(s)) {
    std::vector<formats::VtuArray> arrays;
    for (Index k = 0; k < shapes.motion.cols(); ++k) {
      const std::string name = fmt::format("buckling_{:03} {:.6g}", k + 1, shapes.buckling.factor[k]);
      arrays.push_back(vectors(name, shapes.motion, k, 0, 1.0));
      arrays.push_back(vectors(name + " rotation", shapes.motion, k, 3, 1.0));
    }
    formats::write_vtu(buckling_file(stem, shapes.name), producer("reducer"), s.mesh.position.cast<float>(), cells,
                       arrays, {});
  }
}

void write_modes(const Solution& s, const std::string& path, const formats::VtuCells& cells) {
  const Eigen::MatrixXd motion = node_motions(s.system, s.modes->q);
  std::vector<formats::VtuArray> shapes;
  for (Index k = 0; k < motion.cols(); ++k) {
    const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> nodes(motion.col(k).data(), 6, s.mesh.nodes());
    const double largest = nodes.topRows<3>().colwise().norm().maxCoeff();
    shapes.push_back(vectors(fmt::format("mode_{:03} {:.6g}", k + 1, frequency(s.modes->lambda[k])), motion, k, 0,
                             largest > 0.0 ? 1.0 / largest : 1.0));
  }
  formats::write_vtu(path, producer("reducer"), s.mesh.position.cast<float>(), cells, shapes, {});
}

}  // namespace

std::vector<std::string> solution_files(const std::string& stem, const formats::Part& part,
                                        const SolveRequest& request) {
  std::vector<std::string> files{stem + ".csv"};
  for (const formats::PartLoadCase& load : part.load_cases) files.push_back(case_file(stem, load.name));
  if (request.modes > 0) files.push_back(stem + "-modes.vtu");
  if (request.buckling == 0) return files;
  for (const formats::PartLoadCase& load : part.load_cases) files.push_back(buckling_file(stem, load.name));
  files.push_back(stem + "-buckling.csv");
  files.push_back(stem + "-buckling.html");
  return files;
}

std::string solution_table(const Solution& s, const formats::Part& part, const SolveRequest& request) {
  const std::string length = unit_label(part.units, 1, 0, 0);
  std::string text = "case,point";
  for (const char* axis : {"ux", "uy", "uz"})
    text += length.empty() ? fmt::format(",{}", axis) : fmt::format(",{} [{}]", axis, length);
  text += ",rx,ry,rz\n";
  const auto nodes = named_nodes(s, part, request);
  const auto add = [&](const std::string& name, const Eigen::MatrixXd& motion, Index column) {
    for (const auto& [point, node] : nodes) {
      std::string label = printable_line(point, 60);
      std::ranges::replace(label, '"', '\'');
      text += fmt::format("{},\"{}\"", name, label);
      for (Index k = 0; k < 6; ++k) text += fmt::format(",{:.17g}", motion(6 * node + k, column));
      text += '\n';
    }
  };
  const Eigen::MatrixXd motion = node_motions(s.system, s.statics.q);
  for (Index c = 0; c < motion.cols(); ++c) add(s.mesh.load_cases[c].name, motion, c);
  if (s.modes) {
    const Eigen::MatrixXd shapes = node_motions(s.system, s.modes->q);
    for (Index k = 0; k < shapes.cols(); ++k) add(fmt::format("mode_{}", k + 1), shapes, k);
  }
  for (const CaseShapes& shapes : shapes_of(s))
    for (Index k = 0; k < shapes.motion.cols(); ++k)
      add(fmt::format("{}-buckling_{}", shapes.name, k + 1), shapes.motion, k);
  return text;
}

std::string buckling_table(const Solution& s) {
  std::string text = "case,mode,load_factor\n";
  for (const CaseShapes& shapes : shapes_of(s)) {
    for (Index k = 0; k < shapes.buckling.factor.size(); ++k)
      text += fmt::format("{},{},{:.17g}\n", shapes.name, k + 1, shapes.buckling.factor[k]);
    if (shapes.buckling.reversed) text += fmt::format("{},reversed,{:.17g}\n", shapes.name, -*shapes.buckling.reversed);
  }
  return text;
}

std::string buckling_page(const Solution& s, const formats::Part& part) {
  ViewedPart viewed;
  viewed.title = part.name + ", buckling";
  viewed.file = part.file;
  viewed.units = part.units;
  viewed.tables = s.tables;
  viewed.spiders = s.mesh.spiders;
  viewed.notes = s.warnings;
  for (const CaseShapes& shapes : shapes_of(s))
    for (Index k = 0; k < shapes.motion.cols(); ++k)
      viewed.shapes.push_back({fmt::format("{} {}: load factor {:.5g}", shapes.name, k + 1, shapes.buckling.factor[k]),
                               shapes.motion.col(k)});
  return part_page(viewed);
}

void write_solution(const Solution& s, const formats::Part& part, const SolveRequest& request,
                    const std::string& stem) {
  const std::string table = solution_table(s, part, request);
  const formats::VtuCells cells = formats::vtu_cells(s.tables.elements);
  write_text_file(stem + ".csv", table);
  write_cases(s, stem, cells);
  if (s.modes) write_modes(s, stem + "-modes.vtu", cells);
  if (s.buckling.empty()) return;
  write_buckling(s, stem, cells);
  write_text_file(stem + "-buckling.csv", buckling_table(s));
  write_text_file(stem + "-buckling.html", buckling_page(s, part));
}

}  // namespace tisserand::reducer
