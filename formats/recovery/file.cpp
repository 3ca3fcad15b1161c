// SPDX-License-Identifier: GPL-3.0-or-later
// Reads recovery files: tables at once, fields in blocks.
#include <algorithm>
#include <limits>

#include "common/error.hpp"
#include "formats/hdf5/head.hpp"
#include "formats/hdf5/packed.hpp"
#include "formats/recovery/field_sets.hpp"

namespace tisserand::formats {
namespace {

using Numbers = std::vector<double>;

constexpr hdf5::FileKind recovery_kind{recovery_format, "recovery file",
                                       "give a *.recovery.h5 file, as `reducer run` writes it with `recovery: yes`",
                                       "reduce the part again with a program of the same major version"};
constexpr std::uint64_t most_entries = 200'000'000;  // limit of a table's entries, checked before allocation
constexpr std::uint64_t most_applied = 10'000;       // limit of loads

/// Tables of a file. Every length is checked before memory is allocated.
class Tables {
 public:
  explicit Tables(const hdf5::InputFile& file) : file_(file) {}

  bool has(const std::string& dataset) const { return file_.has(dataset); }
  const std::string& path() const { return file_.path(); }
  std::uint64_t length(const std::string& dataset) const {
    const hdf5::Shape shape = file_.info(dataset).shape;
    if (shape.empty() || shape[0] > most_entries)
      throw Error(fmt::format("has shape {}, expected at most {} rows", hdf5::shape_text(shape), most_entries),
                  fmt::format("{}: {}", file_.path(), dataset), "compare the file with formats/RECOVERY.md");
    return shape[0];
  }
  std::vector<int> integers(const std::string& dataset, const hdf5::Shape& shape) const {
    std::vector<std::int64_t> wide(count(dataset, shape));
    file_.read(dataset, shape, "integers", wide.data());
    std::vector<int> values(wide.size());
    for (std::size_t i = 0; i < wide.size(); ++i) {
      if (wide[i] < std::numeric_limits<int>::min() || wide[i] > std::numeric_limits<int>::max())
        throw Error(fmt::format("entry {} is {}, outside the range of 32-bit integers", i, wide[i]),
                    fmt::format("{}: {}", file_.path(), dataset), "write the file again");
      values[i] = static_cast<int>(wide[i]);
    }
    return values;
  }
  std::vector<int> integers(const std::string& dataset) const { return integers(dataset, {length(dataset)}); }
  Numbers numbers(const std::string& dataset, const hdf5::Shape& shape) const {
    Numbers values(count(dataset, shape));
    file_.read(dataset, shape, "numbers", values.data());
    return values;
  }
  std::vector<std::string> texts(const std::string& dataset) const {
    return file_.read_texts(dataset, length(dataset), "texts");
  }
  std::vector<Eigen::Matrix3d> axes(const std::string& dataset) const {
    const Numbers values = numbers(dataset, {length(dataset), 3, 3});
    std::vector<Eigen::Matrix3d> result;
    for (std::size_t i = 0; i < values.size(); i += 9)
      result.emplace_back(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&values[i]));
    return result;
  }

 private:
  /// Number of values of a shape, checked before memory is allocated.
  std::size_t count(const std::string& dataset, const hdf5::Shape& shape) const {
    const hdf5::Shape found = file_.info(dataset).shape;
    if (found != shape)
      throw Error(fmt::format("has shape {}, expected {}", hdf5::shape_text(found), hdf5::shape_text(shape)),
                  fmt::format("{}: {}", file_.path(), dataset), "compare the file with formats/RECOVERY.md");
    std::size_t product = 1;
    for (const std::uint64_t extent : shape) product *= extent;
    return product;
  }

  const hdf5::InputFile& file_;
};

std::vector<RecoverySection> read_sections(const Tables& tables, const std::string& path) {
  const std::uint64_t count = tables.length("/sections/constants");
  const Numbers constants = tables.numbers("/sections/constants", {count, 6});
  const std::vector<int> known = tables.integers("/sections/outline_known", {count});
  const std::vector<int> first = tables.integers("/sections/outline_first", {count + 1});
  const Numbers outline = tables.numbers("/sections/outline", {tables.length("/sections/outline"), 2});
  std::vector<RecoverySection> sections;
  for (std::size_t s = 0; s < count; ++s) {
    const double* c = &constants[6 * s];
    RecoverySection section{c[0], c[1], c[2], c[3], c[4], c[5], {}, known[s] != 0};
    if (first[s] < 0 || first[s + 1] < first[s] || static_cast<std::size_t>(first[s + 1]) > outline.size() / 2)
      throw Error(fmt::format("entries {} and {} do not ascend within the outline", s, s + 1),
                  path + ": /sections/outline_first", "compare the file with formats/RECOVERY.md");
    for (std::size_t k = static_cast<std::size_t>(first[s]); k < static_cast<std::size_t>(first[s + 1]); ++k)
      section.outline.emplace_back(outline[2 * k], outline[2 * k + 1]);
    sections.push_back(section);
  }
  return sections;
}

void read_mesh(const Tables& tables, Recovery& r) {
  const std::uint64_t nodes = tables.length("/nodes/position");
  r.position = Eigen::Map<const Eigen::Matrix3Xd>(tables.numbers("/nodes/position", {nodes, 3}).data(), 3,
                                                  static_cast<Eigen::Index>(nodes));
  r.node_label = tables.texts("/nodes/label");
  r.rotates = tables.integers("/nodes/rotates");
  if (tables.has("/nodes/number")) r.node_number = tables.integers("/nodes/number");
  r.group_name = tables.texts("/groups/name");
  for (const int shape : tables.integers("/elements/shape"))
    r.elements.shape.push_back(static_cast<ElementShape>(shape));
  r.elements.group = tables.integers("/elements/group");
  r.elements.id = tables.integers("/elements/id");
  r.elements.first = tables.integers("/elements/first");
  r.elements.node = tables.integers("/elements/node");
  const std::uint64_t triangles = tables.length("/surface/triangle");
  r.triangle = Eigen::Map<const Eigen::Matrix3Xi>(tables.integers("/surface/triangle", {triangles, 3}).data(), 3,
                                                  static_cast<Eigen::Index>(triangles));
  r.triangle_element = tables.integers("/surface/element");
}

/// Reads applied loads. Their share follows that of the twelve inertia loads.
void read_applied(const Tables& tables, std::uint64_t coordinates, RecoveryLoads& loads) {
  const std::vector<std::string> cases = tables.texts("/applied/load_case"), nodes = tables.texts("/applied/node");
  const std::uint64_t count = cases.size();
  const std::vector<int> component = tables.integers("/applied/component", {count});
  if (nodes.size() != count || count > most_applied)
    throw Error(fmt::format("has {} entries, but /applied/load_case has {}; expected equal numbers of at most {}",
                            nodes.size(), count, most_applied),
                tables.path() + ": /applied/node", "compare the file with formats/RECOVERY.md");
  for (std::size_t k = 0; k < cases.size(); ++k) loads.applied.push_back({cases[k], nodes[k], component[k]});
  const Numbers share = tables.numbers("/applied/share", {coordinates, count});
  const auto columns = static_cast<Eigen::Index>(count);
  loads.share.conservativeResize(Eigen::NoChange, inertia_loads + columns);
  loads.share.rightCols(columns) =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          share.data(), static_cast<Eigen::Index>(coordinates), columns);
}

RecoveryLoads read_loads_table(const Tables& tables, std::uint64_t coordinates) {
  RecoveryLoads loads;
  loads.reference_point = Eigen::Map<const Eigen::Vector3d>(tables.numbers("/loads/reference_point", {3}).data());
  const Numbers share = tables.numbers("/loads/share", {coordinates, static_cast<std::uint64_t>(inertia_loads)});
  loads.share = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      share.data(), static_cast<Eigen::Index>(coordinates), inertia_loads);
  const Numbers stiffness = tables.numbers("/loads/stiffness", {coordinates});
  loads.stiffness = Eigen::Map<const Eigen::VectorXd>(stiffness.data(), static_cast<Eigen::Index>(coordinates));
  loads.left_out = tables.numbers("/loads/left_out", {1})[0];
  if (tables.has("/applied/share")) read_applied(tables, coordinates, loads);
  if (!tables.has("/loads/boundary_stiffness")) return loads;
  const std::uint64_t boundary = tables.length("/loads/boundary_stiffness");
  const Numbers S = tables.numbers("/loads/boundary_stiffness", {boundary, boundary});
  loads.boundary_stiffness = Eigen::Map<const Eigen::MatrixXd>(S.data(), static_cast<Eigen::Index>(boundary),
                                                               static_cast<Eigen::Index>(boundary));
  return loads;
}

/// Reads symmetric matrices, stored as entries (k, l) with k ≤ l, row by row.
std::vector<Eigen::MatrixXd> read_forms(const Tables& tables, const std::string& dataset, std::uint64_t coordinates) {
  const Numbers values = tables.numbers(dataset, {tables.length(dataset), coordinates * (coordinates + 1) / 2});
  const auto n = static_cast<Eigen::Index>(coordinates);
  std::vector<Eigen::MatrixXd> forms;
  for (std::size_t at = 0; at < values.size();) {
    Eigen::MatrixXd& form = forms.emplace_back(n, n);
    for (Eigen::Index k = 0; k < n; ++k)
      for (Eigen::Index l = k; l < n; ++l) form(k, l) = form(l, k) = values[at++];
  }
  return forms;
}

SecondOrderForms read_second_order_table(const Tables& tables, std::uint64_t coordinates) {
  SecondOrderForms forms;
  forms.of_shape = read_forms(tables, "/second_order/shape_form", coordinates);
  forms.of_coordinate = read_forms(tables, "/second_order/coordinate_form", coordinates);
  forms.coordinate = tables.integers("/second_order/coordinate", {forms.of_coordinate.size()});
  return forms;
}

Recovery read_tables(const hdf5::InputFile& file) {
  const Tables tables(file);
  Recovery r;
  r.name = file.text_attribute("/", "name");
  r.producer = file.text_attribute("/", "producer");
  r.content_id = file.text_attribute("/", "content_id");
  const std::vector<std::string> images = file.read_texts("/mirror/content_id", 7, "images of the superelement");
  std::copy(images.begin(), images.end(), r.mirror_content_id.begin());
  r.units = hdf5::read_units(file);
  r.boundary_name = tables.texts("/boundary/name");
  r.boundary_node = tables.integers("/boundary/node");
  r.dof_node = tables.integers("/dof/node");
  r.dof_component = tables.integers("/dof/component");
  read_mesh(tables, r);
  r.beam_axes = tables.axes("/beams/axes");
  const std::uint64_t beams = r.beam_axes.size(), shells = tables.length("/shells/axes");
  r.beam_offset = Eigen::Map<const Eigen::Matrix3Xd>(tables.numbers("/beams/offset", {beams, 2, 3}).data(), 3,
                                                     static_cast<Eigen::Index>(2 * beams));
  r.beam_section = tables.integers("/beams/section", {beams, 2});
  r.sections = read_sections(tables, file.path());
  r.shell_axes = tables.axes("/shells/axes");
  r.shell_thickness = tables.numbers("/shells/thickness", {shells});
  r.shell_offset = tables.numbers("/shells/offset", {shells});
  r.stress_node = tables.integers("/stress_points/node");
  r.stress_group = tables.integers("/stress_points/group");
  if (file.has("/loads")) r.loads = read_loads_table(tables, r.dof_node.size());
  if (file.has("/second_order")) r.second_order = read_second_order_table(tables, r.dof_node.size());
  return r;
}

void check_field_shapes(const hdf5::InputFile& file, const Recovery& recovery) {
  for (const FieldSet& set : field_sets(recovery)) {
    const hdf5::DatasetInfo info = file.info(set.dataset);
    if (info.kind != hdf5::ElementKind::float32 || info.shape != set.shape() || !info.written)
      throw Error(fmt::format("holds {} of shape {}{}, expected 32-bit floating numbers of shape {}", info.type_text,
                              hdf5::shape_text(info.shape), info.written ? "" : " (not all were written)",
                              hdf5::shape_text(set.shape())),
                  fmt::format("{}: {}", file.path(), set.dataset), "reduce the part again with `recovery: yes`");
  }
}

FieldRows read_field(const hdf5::InputFile& file, const FieldSet& set, int first, int count) {
  FieldRows rows(static_cast<Eigen::Index>(set.width) * count, set.columns);
  if (count == 0 || set.columns == 0) return rows;
  file.read_rows(set.dataset, static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(count), rows.data());
  if (!rows.allFinite())
    throw Error(fmt::format("items {} to {} hold values that are not finite", first, first + count - 1),
                fmt::format("{}: {}", file.path(), set.dataset), "reduce the part again");
  return rows;
}

}  // namespace

struct RecoveryReader::Impl {
  explicit Impl(const std::string& path) : file(path, hdf5::Completeness::closed) {}

  FieldRows read(const FieldSet& set, int first, int count) const {
    TISSERAND_ENSURE(first >= 0 && count >= 0 && first + count <= set.items, "items {} + {} of {}", first, count,
                     set.dataset);
    return read_field(file, set, first, count);
  }
  /// Columns of the inertia loads, followed by those of the applied loads.
  FieldRows read_loads(const FieldSet& inertia, const FieldSet& applied, int first, int count) const {
    FieldRows rows(static_cast<Eigen::Index>(inertia.width) * count, inertia.columns + applied.columns);
    rows.leftCols(inertia.columns) = read(inertia, first, count);
    if (applied.columns > 0) rows.rightCols(applied.columns) = read(applied, first, count);
    return rows;
  }

  hdf5::InputFile file;
  Recovery recovery;
};

RecoveryReader::RecoveryReader(const std::string& path) {
  impl_ = std::make_unique<Impl>(path);
  hdf5::check_format(impl_->file, recovery_kind);
  impl_->recovery = read_tables(impl_->file);
  check(impl_->recovery, path);
  check_field_shapes(impl_->file, impl_->recovery);
}

RecoveryReader::~RecoveryReader() = default;

const std::string& RecoveryReader::path() const { return impl_->file.path(); }

const Recovery& RecoveryReader::recovery() const { return impl_->recovery; }

FieldRows RecoveryReader::read(RecoveryField field, int first, int count) const {
  return impl_->read(of_coordinates(impl_->recovery, field), first, count);
}

FieldRows RecoveryReader::read_loads(RecoveryField field, int first, int count) const {
  TISSERAND_ENSURE(impl_->recovery.loads, "{} has no loads", path());
  return impl_->read_loads(of_loads(impl_->recovery, field), of_applied(impl_->recovery, field), first, count);
}

FieldRows RecoveryReader::read_forces(NodalForce force, int first, int count) const {
  TISSERAND_ENSURE(impl_->recovery.loads && impl_->recovery.loads->has_forces(), "{} has no nodal forces", path());
  const FieldSet set = of_forces(impl_->recovery, force);
  if (force == NodalForce::mode_force || force == NodalForce::mode_moment) return impl_->read(set, first, count);
  return impl_->read_loads(set, of_applied_forces(impl_->recovery, force), first, count);
}

FieldRows RecoveryReader::read_second_order(RecoveryField field, int first, int count) const {
  return impl_->read(of_second_order(impl_->recovery, field), first, count);
}

}  // namespace tisserand::formats
