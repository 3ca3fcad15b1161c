// Table and VTU files.
#include "reducer/solve/files.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "common/text.hpp"
#include "formats/vtk/vtu.hpp"
#include "reducer/recover/places.hpp"
#include "reducer/recover/vtu_data.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;

std::string case_file(const std::string& stem, const std::string& name) { return fmt::format("{}.{}.vtu", stem, name); }

/// Names of nodes with their rows, each name once.
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

/// Every node's rows [from, from + 3) of a state as an array.
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
    formats::write_vtu(case_file(stem, s.mesh.load_cases[static_cast<std::size_t>(c)].name),
                       s.mesh.position.cast<float>(), cells, on_points, vtu_cell_data(s.tables, s.fields, values, c));
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
  formats::write_vtu(path, s.mesh.position.cast<float>(), cells, shapes, {});
}

}  // namespace

std::vector<std::string> solution_files(const std::string& stem, const formats::Part& part,
                                        const SolveRequest& request) {
  std::vector<std::string> files{stem + ".csv"};
  for (const formats::PartLoadCase& load : part.load_cases) files.push_back(case_file(stem, load.name));
  if (request.modes > 0) files.push_back(stem + "-modes.vtu");
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
  for (Index c = 0; c < motion.cols(); ++c) add(s.mesh.load_cases[static_cast<std::size_t>(c)].name, motion, c);
  if (!s.modes) return text;
  const Eigen::MatrixXd shapes = node_motions(s.system, s.modes->q);
  for (Index k = 0; k < shapes.cols(); ++k) add(fmt::format("mode_{}", k + 1), shapes, k);
  return text;
}

void write_solution(const Solution& s, const formats::Part& part, const SolveRequest& request,
                    const std::string& stem) {
  const std::string table = solution_table(s, part, request);
  const formats::VtuCells cells = formats::vtu_cells(s.tables.elements);
  write_text_file(stem + ".csv", table);
  write_cases(s, stem, cells);
  if (s.modes) write_modes(s, stem + "-modes.vtu", cells);
}

}  // namespace tisserand::reducer
