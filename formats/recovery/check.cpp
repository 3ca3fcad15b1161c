// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the rules of RECOVERY.md: every index is valid, every number is finite.
#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

#include <Eigen/LU>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/hdf5/head.hpp"
#include "formats/recovery/recovery.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

constexpr double largest_number = 1e100;
constexpr const char* compare_page = "compare the file with formats/RECOVERY.md, or reduce the part again";

class Inspector {
 public:
  explicit Inspector(const std::string& where) : where_(where) {}

  [[noreturn]] void fail(const std::string& dataset, const std::string& what) const {
    throw Error(what, fmt::format("{}: {}", where_, dataset), compare_page);
  }
  void size(const std::string& dataset, std::size_t found, std::size_t expected, const char* of) const {
    if (found != expected) fail(dataset, fmt::format("has {} entries, expected {} ({})", found, expected, of));
  }
  void range(const std::string& dataset, const int* values, std::size_t count, int low, int high) const {
    for (std::size_t i = 0; i < count; ++i)
      if (values[i] < low || values[i] > high)
        fail(dataset, fmt::format("entry {} is {}, expected {} to {}", i, values[i], low, high));
  }
  void range(const std::string& dataset, const std::vector<int>& values, int low, int high) const {
    range(dataset, values.data(), values.size(), low, high);
  }
  void finite(const std::string& dataset, const double* values, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i)
      if (!(std::abs(values[i]) < largest_number))
        fail(dataset, fmt::format("entry {} is {}, expected a finite number below {:g}", i, values[i], largest_number));
  }
  /// Checks that axes are orthonormal and right-handed.
  void axes(const std::string& dataset, const std::vector<Eigen::Matrix3d>& axes) const {
    for (std::size_t i = 0; i < axes.size(); ++i)
      if (!axes[i].allFinite() || !axes[i].isUnitary(1e-6) || axes[i].determinant() < 0.0)
        fail(dataset, fmt::format("entry {} is not a set of right-handed orthonormal axes", i));
  }
  /// Checks that offsets ascend from 0 to `end`.
  void offsets(const std::string& dataset, const std::vector<int>& values, std::size_t groups, std::size_t end) const {
    size(dataset, values.size(), groups + 1, "the number of groups, plus 1");
    if (values.front() != 0 || !std::is_sorted(values.begin(), values.end()) ||
        static_cast<std::size_t>(values.back()) != end)
      fail(dataset, fmt::format("does not ascend from 0 to {}", end));
  }

 private:
  std::string where_;
};

bool is_content_id(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

void check_head(const Recovery& r, const Inspector& inspect) {
  for (const std::string& text : {r.name, r.producer})
    if (printable_line(text, 255) != text)
      inspect.fail("attributes 'name', 'producer'", "must each be one line of at most 255 bytes");
  if (!is_content_id(r.content_id)) inspect.fail("attribute 'content_id'", "is not a SHA-256 of 64 hexadecimal digits");
  for (const std::string& id : r.mirror_content_id)
    if (!is_content_id(id))
      inspect.fail("/mirror/content_id", "holds an entry that is not a SHA-256 of 64 hexadecimal digits");
}

void check_coordinates(const Recovery& r, const Inspector& inspect) {
  const std::size_t n = r.dof_node.size();
  const int boundary = count_of(r.boundary_name);
  if (n < 1 || n > 10'000) inspect.fail("/dof/node", fmt::format("has {} entries, expected 1 to 10000", n));
  std::set<std::string> seen;
  for (const std::string& name : r.boundary_name)
    if (!is_name(name) || !seen.insert(name).second)
      inspect.fail("/boundary/name",
                   fmt::format("holds '{}', which is not a valid name or is given twice", printable_line(name, 60)));
  inspect.size("/boundary/node", r.boundary_node.size(), r.boundary_name.size(), "names of boundary nodes");
  inspect.range("/boundary/node", r.boundary_node, 0, r.nodes() - 1);
  inspect.size("/dof/component", r.dof_component.size(), n, "entries of /dof/node");
  inspect.range("/dof/node", r.dof_node, -1, boundary - 1);
  const int internal = static_cast<int>(std::count(r.dof_node.begin(), r.dof_node.end(), -1));
  std::set<std::pair<int, int>> coordinates;
  for (std::size_t k = 0; k < n; ++k) {
    const int component = r.dof_component[k], most = r.dof_node[k] < 0 ? internal : 6;
    if (component < 0 || component >= most || !coordinates.insert({r.dof_node[k], component}).second)
      inspect.fail("/dof/component",
                   fmt::format("entry {} is {}, which is not a valid component or is given twice", k, component));
  }
}

void check_elements(const Recovery& r, const Inspector& inspect) {
  const RecoveryElements& e = r.elements;
  const auto count = e.shape.size();
  const int groups = count_of(r.group_name);
  inspect.size("/elements/group", e.group.size(), count, "elements");
  inspect.size("/elements/id", e.id.size(), count, "elements");
  inspect.range("/elements/group", e.group, 0, groups - 1);
  inspect.offsets("/elements/first", e.first, count, e.node.size());
  inspect.range("/elements/node", e.node, 0, r.nodes() - 1);
  int beams = 0, shells = 0, last = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const int shape = static_cast<int>(e.shape[i]), kind = shape == 0 ? 0 : shape < 3 ? 1 : 2;
    if (shape < 0 || shape >= element_shapes)
      inspect.fail("/elements/shape", fmt::format("entry {} is {}, which is not a known shape", i, shape));
    if (e.first[i + 1] - e.first[i] != node_count(e.shape[i]))
      inspect.fail("/elements/first", fmt::format("element {} has {} nodes, but its shape has {}", i,
                                                  e.first[i + 1] - e.first[i], node_count(e.shape[i])));
    if (kind < last)
      inspect.fail("/elements/shape",
                   fmt::format("entry {} is in the wrong order: beams come first, then shells, then solids", i));
    last = kind;
    beams += kind == 0 ? 1 : 0;
    shells += kind == 1 ? 1 : 0;
  }
  inspect.size("/beams/axes", r.beam_axes.size(), static_cast<std::size_t>(beams), "beams of /elements/shape");
  inspect.size("/shells/axes", r.shell_axes.size(), static_cast<std::size_t>(shells), "shells of /elements/shape");
}

void check_beams_and_shells(const Recovery& r, const Inspector& inspect) {
  inspect.axes("/beams/axes", r.beam_axes);
  inspect.axes("/shells/axes", r.shell_axes);
  inspect.size("/beams/offset", static_cast<std::size_t>(r.beam_offset.cols()), 2 * r.beam_axes.size(), "two per beam");
  inspect.finite("/beams/offset", r.beam_offset.data(), static_cast<std::size_t>(r.beam_offset.size()));
  inspect.size("/beams/section", r.beam_section.size(), 2 * r.beam_axes.size(), "two per beam");
  inspect.range("/beams/section", r.beam_section, 0, count_of(r.sections) - 1);
  inspect.size("/shells/thickness", r.shell_thickness.size(), r.shell_axes.size(), "shells");
  inspect.size("/shells/offset", r.shell_offset.size(), r.shell_axes.size(), "shells");
  inspect.finite("/shells/thickness", r.shell_thickness.data(), r.shell_thickness.size());
  inspect.finite("/shells/offset", r.shell_offset.data(), r.shell_offset.size());
  for (const RecoverySection& s : r.sections) {
    const double constants[] = {s.area,       s.second_moment_y, s.second_moment_z, s.second_moment_yz,
                                s.centroid_y, s.centroid_z};
    inspect.finite("/sections/constants", constants, std::size(constants));
    if (s.area < 0.0)
      inspect.fail("/sections/constants", fmt::format("holds the area {}, but an area must not be negative", s.area));
    for (const Eigen::Vector2d& point : s.outline) inspect.finite("/sections/outline", point.data(), 2);
  }
}

void check_applied(const RecoveryLoads& loads, const Inspector& inspect) {
  std::set<std::tuple<std::string, std::string, int>> seen;
  for (std::size_t k = 0; k < loads.applied.size(); ++k) {
    const AppliedLoad& load = loads.applied[k];
    const bool is_case = !load.load_case.empty();
    if (is_case == !load.node.empty())
      inspect.fail("/applied/load_case", fmt::format("entry {} must name either a load case or a node", k));
    if (printable_line(is_case ? load.load_case : load.node, 255) != (is_case ? load.load_case : load.node))
      inspect.fail("/applied/load_case, /applied/node",
                   fmt::format("entry {} must be one line of at most 255 bytes", k));
    if (load.component < 0 || load.component >= (is_case ? 1 : 6))
      inspect.fail("/applied/component",
                   fmt::format("entry {} is {}, which is not a valid component", k, load.component));
    if (!seen.insert({load.load_case, load.node, load.component}).second)
      inspect.fail("/applied/load_case, /applied/node", fmt::format("entry {} is given twice", k));
  }
}

void check_loads(const Recovery& r, const Inspector& inspect) {
  if (!r.loads) return;
  const RecoveryLoads& loads = *r.loads;
  const auto n = static_cast<std::size_t>(r.coordinates());
  inspect.finite("/loads/reference_point", loads.reference_point.data(), 3);
  const auto columns = static_cast<std::size_t>(loads.columns());
  inspect.size("/loads/share", static_cast<std::size_t>(loads.share.size()), n * columns, "coordinates times loads");
  inspect.finite("/loads/share, /applied/share", loads.share.data(), n * columns);
  check_applied(loads, inspect);
  inspect.size("/loads/stiffness", static_cast<std::size_t>(loads.stiffness.size()), n, "coordinates");
  inspect.finite("/loads/stiffness", loads.stiffness.data(), n);
  for (std::size_t k = 0; k < n; ++k)
    if (const double value = loads.stiffness[static_cast<Eigen::Index>(k)];
        r.dof_node[k] < 0 ? value <= 0.0 : value != 0.0)
      inspect.fail("/loads/stiffness",
                   fmt::format("entry {} is {}, expected a positive number for internal coordinates "
                               "and 0 for others",
                               k, value));
  inspect.finite("/loads/left_out", &loads.left_out, 1);
  if (loads.left_out < 0.0)
    inspect.fail("/loads/left_out", fmt::format("is {}, but must not be negative", loads.left_out));
  if (!loads.has_forces()) return;
  const auto boundary = n - static_cast<std::size_t>(r.internal());
  inspect.size("/loads/boundary_stiffness", static_cast<std::size_t>(loads.boundary_stiffness.size()),
               boundary * boundary, "coordinates of the boundary, squared");
  inspect.finite("/loads/boundary_stiffness", loads.boundary_stiffness.data(), boundary * boundary);
  // Readers take the first coordinates as those of the boundary.
  for (std::size_t k = 0; k < boundary; ++k)
    if (r.dof_node[k] < 0)
      inspect.fail("/dof/node",
                   fmt::format("entry {} is an internal coordinate, but boundary coordinates come first", k));
}

void check_forms(const Recovery& r, const std::string& dataset, const std::vector<Eigen::MatrixXd>& forms,
                 const Inspector& inspect) {
  const Eigen::Index n = r.coordinates();
  for (std::size_t k = 0; k < forms.size(); ++k) {
    const Eigen::MatrixXd& form = forms[k];
    if (form.rows() != n || form.cols() != n)
      inspect.fail(dataset,
                   fmt::format("matrix {} has {} rows and {} columns, expected {} of each, the number of coordinates",
                               k, form.rows(), form.cols(), n));
    inspect.finite(dataset, form.data(), static_cast<std::size_t>(form.size()));
    if (form != form.transpose()) inspect.fail(dataset, fmt::format("matrix {} is not symmetric", k));
  }
}

void check_second_order(const Recovery& r, const Inspector& inspect) {
  if (!r.second_order) return;
  const SecondOrderForms& forms = *r.second_order;
  check_forms(r, "/second_order/shape_form", forms.of_shape, inspect);
  check_forms(r, "/second_order/coordinate_form", forms.of_coordinate, inspect);
  inspect.size("/second_order/coordinate", forms.coordinate.size(), forms.of_coordinate.size(),
               "matrices of /second_order/coordinate_form");
  inspect.range("/second_order/coordinate", forms.coordinate, 0, r.coordinates() - 1);
  for (std::size_t k = 0; k < forms.coordinate.size(); ++k)
    if (r.dof_node[static_cast<std::size_t>(forms.coordinate[k])] >= 0)
      inspect.fail("/second_order/coordinate",
                   fmt::format("entry {} is {}, a boundary coordinate, expected an internal coordinate", k,
                               forms.coordinate[k]));
}

}  // namespace

void check(const Recovery& r, const std::string& where) {
  hdf5::check_units(r.units, where);
  const Inspector inspect(where);
  check_head(r, inspect);
  if (r.nodes() < 1) inspect.fail("/nodes/position", "holds no node");
  inspect.finite("/nodes/position", r.position.data(), static_cast<std::size_t>(r.position.size()));
  inspect.size("/nodes/label", r.node_label.size(), static_cast<std::size_t>(r.nodes()), "nodes");
  inspect.size("/nodes/rotates", r.rotates.size(), static_cast<std::size_t>(r.nodes()), "nodes");
  inspect.range("/nodes/rotates", r.rotates, 0, 1);
  if (!r.node_number.empty()) {
    inspect.size("/nodes/number", r.node_number.size(), static_cast<std::size_t>(r.nodes()), "nodes");
    inspect.range("/nodes/number", r.node_number, 0, std::numeric_limits<int>::max());
  }
  check_coordinates(r, inspect);
  check_elements(r, inspect);
  check_beams_and_shells(r, inspect);
  check_loads(r, inspect);
  check_second_order(r, inspect);
  inspect.size("/stress_points/group", r.stress_group.size(), r.stress_node.size(), "points");
  inspect.range("/stress_points/node", r.stress_node, 0, r.nodes() - 1);
  inspect.range("/stress_points/group", r.stress_group, 0, count_of(r.group_name) - 1);
  inspect.size("/surface/element", r.triangle_element.size(), static_cast<std::size_t>(r.triangle.cols()), "triangles");
  inspect.range("/surface/triangle", r.triangle.data(), static_cast<std::size_t>(r.triangle.size()), 0, r.nodes() - 1);
  inspect.range("/surface/element", r.triangle_element, r.beams(), r.elements.count() - 1);
}

}  // namespace tisserand::formats
