// Recovery files between memory and disk: tables at once, fields by blocks.
#include <algorithm>
#include <limits>

#include "common/error.hpp"
#include "formats/hdf5/head.hpp"
#include "formats/hdf5/packed.hpp"
#include "formats/recovery/field_sets.hpp"

namespace tisserand::formats {

namespace {

using Numbers = std::vector<double>;

constexpr hdf5::FileKind recovery_kind{"tisserand-recovery", "recovery file",
                                       "give a *.recovery.h5 file, as `reducer run` writes it with `recovery: yes`",
                                       "reduce the part again with a program of the same major version"};
constexpr std::uint64_t most_entries = 200'000'000;  // of a table; bounds memory before it is taken

/// Tables of a file; every length is looked at before memory is taken.
class Tables {
 public:
  explicit Tables(const hdf5::InputFile& file) : file_(file) {}

  bool has(const std::string& dataset) const { return file_.has(dataset); }
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
        throw Error(fmt::format("entry {} is {}, beyond 32-bit integers", i, wide[i]),
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
  /// The shape is looked at before memory is taken.
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

RecoveryLoads read_loads_table(const Tables& tables, std::uint64_t coordinates) {
  RecoveryLoads loads;
  loads.reference_point = Eigen::Map<const Eigen::Vector3d>(tables.numbers("/loads/reference_point", {3}).data());
  const Numbers share = tables.numbers("/loads/share", {coordinates, static_cast<std::uint64_t>(inertia_loads)});
  loads.share = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      share.data(), static_cast<Eigen::Index>(coordinates), inertia_loads);
  const Numbers stiffness = tables.numbers("/loads/stiffness", {coordinates});
  loads.stiffness = Eigen::Map<const Eigen::VectorXd>(stiffness.data(), static_cast<Eigen::Index>(coordinates));
  loads.left_out = tables.numbers("/loads/left_out", {1})[0];
  if (!tables.has("/loads/boundary_stiffness")) return loads;
  const std::uint64_t boundary = tables.length("/loads/boundary_stiffness");
  const Numbers S = tables.numbers("/loads/boundary_stiffness", {boundary, boundary});
  loads.boundary_stiffness = Eigen::Map<const Eigen::MatrixXd>(S.data(), static_cast<Eigen::Index>(boundary),
                                                               static_cast<Eigen::Index>(boundary));
  return loads;
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
  return r;
}

void check_field_shapes(const hdf5::InputFile& file, const Recovery& recovery) {
  for (const FieldSet& set : field_sets(recovery)) {
    const hdf5::DatasetInfo info = file.info(set.dataset);
    if (info.kind != hdf5::ElementKind::float32 || info.shape != set.shape() || !info.written)
      throw Error(fmt::format("holds {} of shape {}{}, expected 32-bit floating numbers of shape {}", info.type_text,
                              hdf5::shape_text(info.shape), info.written ? "" : ", not all of them written",
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

std::vector<double> rows_of(const std::vector<Eigen::Matrix3d>& axes) {
  std::vector<double> values;
  for (const Eigen::Matrix3d& one : axes)
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index k = 0; k < 3; ++k) values.push_back(one(i, k));
  return values;
}

/// The oldest version that knows all that is in the file.
const char* version_of(const Recovery& r) {
  if (!r.node_number.empty() || (r.loads && r.loads->has_forces())) return "1.2";
  return r.loads ? "1.1" : "1.0";
}

void write_head(hdf5::Id file, const Recovery& r, const std::string& where) {
  hdf5::write_text_attribute(file, "/", "format", recovery_kind.format, where);
  hdf5::write_text_attribute(file, "/", "version", version_of(r), where);
  hdf5::write_text_attribute(file, "/", "name", r.name, where);
  hdf5::write_text_attribute(file, "/", "producer", r.producer, where);
  hdf5::write_text_attribute(file, "/", "content_id", r.content_id, where);
  hdf5::write_texts(file, "/mirror/content_id", {r.mirror_content_id.begin(), r.mirror_content_id.end()}, where);
  hdf5::write_units(file, r.units, where);
}

/// Writes tables, all of them compressed.
class TableWriter {
 public:
  TableWriter(hdf5::Id file, const std::string& where) : file_(file), where_(where) {}

  void integers(const std::string& dataset, const hdf5::Shape& shape, const int* values) const {
    hdf5::write_packed(file_, dataset, shape, values, where_);
  }
  void integers(const std::string& dataset, const std::vector<int>& values) const {
    integers(dataset, {values.size()}, values.data());
  }
  void numbers(const std::string& dataset, const hdf5::Shape& shape, const double* values) const {
    hdf5::write_packed(file_, dataset, shape, values, where_);
  }
  void texts(const std::string& dataset, const std::vector<std::string>& values) const {
    hdf5::write_packed_texts(file_, dataset, values, where_);
  }

 private:
  hdf5::Id file_;
  std::string where_;
};

void write_mesh(const TableWriter& table, const Recovery& r) {
  const auto nodes = static_cast<std::uint64_t>(r.nodes());
  table.texts("/boundary/name", r.boundary_name);
  table.integers("/boundary/node", r.boundary_node);
  table.integers("/dof/node", r.dof_node);
  table.integers("/dof/component", r.dof_component);
  table.numbers("/nodes/position", {nodes, 3}, r.position.data());
  table.texts("/nodes/label", r.node_label);
  table.integers("/nodes/rotates", r.rotates);
  if (!r.node_number.empty()) table.integers("/nodes/number", r.node_number);
  table.texts("/groups/name", r.group_name);
  std::vector<int> shapes;
  for (const ElementShape shape : r.elements.shape) shapes.push_back(static_cast<int>(shape));
  table.integers("/elements/shape", shapes);
  table.integers("/elements/group", r.elements.group);
  table.integers("/elements/id", r.elements.id);
  table.integers("/elements/first", r.elements.first);
  table.integers("/elements/node", r.elements.node);
  table.integers("/surface/triangle", {static_cast<std::uint64_t>(r.triangle.cols()), 3}, r.triangle.data());
  table.integers("/surface/element", r.triangle_element);
  table.integers("/stress_points/node", r.stress_node);
  table.integers("/stress_points/group", r.stress_group);
}

void write_loads(const TableWriter& table, const RecoveryLoads& loads) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> share = loads.share;
  const auto n = static_cast<std::uint64_t>(loads.stiffness.size());
  table.numbers("/loads/reference_point", {3}, loads.reference_point.data());
  table.numbers("/loads/share", {n, static_cast<std::uint64_t>(inertia_loads)}, share.data());
  table.numbers("/loads/stiffness", {n}, loads.stiffness.data());
  table.numbers("/loads/left_out", {1}, &loads.left_out);
  const auto boundary = static_cast<std::uint64_t>(loads.boundary_stiffness.rows());
  if (loads.has_forces())
    table.numbers("/loads/boundary_stiffness", {boundary, boundary}, loads.boundary_stiffness.data());
}

void write_properties(const TableWriter& table, const Recovery& r) {
  const auto beams = static_cast<std::uint64_t>(r.beams()), shells = static_cast<std::uint64_t>(r.shells());
  table.numbers("/beams/axes", {beams, 3, 3}, rows_of(r.beam_axes).data());
  table.numbers("/beams/offset", {beams, 2, 3}, r.beam_offset.data());
  table.integers("/beams/section", {beams, 2}, r.beam_section.data());
  std::vector<double> constants, outline;
  std::vector<int> known, first{0};
  for (const RecoverySection& s : r.sections) {
    constants.insert(constants.end(),
                     {s.area, s.second_moment_y, s.second_moment_z, s.second_moment_yz, s.centroid_y, s.centroid_z});
    for (const Eigen::Vector2d& point : s.outline) outline.insert(outline.end(), {point.x(), point.y()});
    known.push_back(s.outline_known ? 1 : 0);
    first.push_back(static_cast<int>(outline.size() / 2));
  }
  table.numbers("/sections/constants", {r.sections.size(), 6}, constants.data());
  table.integers("/sections/outline_known", known);
  table.integers("/sections/outline_first", first);
  table.numbers("/sections/outline", {outline.size() / 2, 2}, outline.data());
  table.numbers("/shells/axes", {shells, 3, 3}, rows_of(r.shell_axes).data());
  table.numbers("/shells/thickness", {shells}, r.shell_thickness.data());
  table.numbers("/shells/offset", {shells}, r.shell_offset.data());
}

}  // namespace

struct RecoveryWriter::Impl {
  struct Growing {
    hdf5::Handle dataset;
    FieldSet set;
    int written = 0;
  };

  Impl(const std::string& path, const Recovery& recovery) : file(path) {
    for (const FieldSet& set : field_sets(recovery))
      fields.push_back(
          {hdf5::create_packed(file.id(), set.dataset, set.shape(), static_cast<std::uint64_t>(set.chunk), file.path()),
           set, 0});
  }

  void append(Growing& growing, const Eigen::Ref<const Eigen::MatrixXd>& rows) const {
    const FieldSet& set = growing.set;
    const int count = static_cast<int>(rows.rows()) / set.width, end = growing.written + count;
    TISSERAND_ENSURE(rows.rows() == count * set.width && rows.cols() == set.columns && end <= set.items &&
                         (end == set.items || count % set.chunk == 0),
                     "{} x {} values for {} after {} of {}", rows.rows(), rows.cols(), set.dataset, growing.written,
                     set.items);
    const FieldRows values = rows.cast<float>();
    if (!values.allFinite())
      throw Error(
          fmt::format("a value for {} is {:.3g}, beyond 32-bit numbers", set.dataset, rows.cwiseAbs().maxCoeff()),
          file.path(), "use units in which the numbers of the part are of ordinary size");
    if (count > 0)
      hdf5::write_packed_rows(growing.dataset, static_cast<std::uint64_t>(growing.written),
                              static_cast<std::uint64_t>(count), values.data(), file.path());
    growing.written = end;
  }

  void close_fields() {
    for (Growing& growing : fields) {
      TISSERAND_ENSURE(growing.written == growing.set.items, "{} of {} items", growing.written, growing.set.items);
      growing.dataset.reset();
    }
  }

  hdf5::OutputFile file;
  std::vector<Growing> fields;  ///< of field_sets()
};

RecoveryWriter::RecoveryWriter(const std::string& path, const Recovery& recovery) {
  check(recovery, path);
  impl_ = std::make_unique<Impl>(path, recovery);
  write_head(impl_->file.id(), recovery, path);
  const TableWriter table(impl_->file.id(), path);
  write_mesh(table, recovery);
  write_properties(table, recovery);
  if (recovery.loads) write_loads(table, *recovery.loads);
}

RecoveryWriter::~RecoveryWriter() = default;

void RecoveryWriter::append(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  impl_->append(impl_->fields[static_cast<std::size_t>(field)], rows);
}

void RecoveryWriter::append_loads(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  impl_->append(impl_->fields.at(recovery_fields.size() + static_cast<std::size_t>(field)), rows);
}

void RecoveryWriter::append_forces(NodalForce force, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  if (rows.cols() == 0) return;  // of no modes
  impl_->append(impl_->fields.at(2 * recovery_fields.size() + static_cast<std::size_t>(force)), rows);
}

std::string RecoveryWriter::stage() {
  impl_->close_fields();
  return impl_->file.stage();
}

void RecoveryWriter::finish() {
  impl_->close_fields();
  impl_->file.publish();
}

struct RecoveryReader::Impl {
  explicit Impl(const std::string& path) : file(path, hdf5::Completeness::closed) {}

  FieldRows read(const FieldSet& set, int first, int count) const {
    TISSERAND_ENSURE(first >= 0 && count >= 0 && first + count <= set.items, "items {} + {} of {}", first, count,
                     set.dataset);
    return read_field(file, set, first, count);
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
  return impl_->read(of_loads(impl_->recovery, field), first, count);
}

FieldRows RecoveryReader::read_forces(NodalForce force, int first, int count) const {
  TISSERAND_ENSURE(impl_->recovery.loads && impl_->recovery.loads->has_forces(), "{} has no nodal forces", path());
  return impl_->read(of_forces(impl_->recovery, force), first, count);
}

}  // namespace tisserand::formats
