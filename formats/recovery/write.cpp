// Recovery files to disk: tables at once, fields by blocks.
#include <algorithm>

#include "common/error.hpp"
#include "formats/hdf5/head.hpp"
#include "formats/hdf5/packed.hpp"
#include "formats/recovery/field_sets.hpp"

namespace tisserand::formats {

namespace {

using Numbers = std::vector<double>;

std::vector<double> rows_of(const std::vector<Eigen::Matrix3d>& axes) {
  std::vector<double> values;
  for (const Eigen::Matrix3d& one : axes)
    for (Eigen::Index i = 0; i < 3; ++i)
      for (Eigen::Index k = 0; k < 3; ++k) values.push_back(one(i, k));
  return values;
}

/// The oldest version that knows all that is in the file.
const char* version_of(const Recovery& r) {
  if (r.second_order || (r.loads && !r.loads->applied.empty())) return "1.3";
  if (!r.node_number.empty() || (r.loads && r.loads->has_forces())) return "1.2";
  return r.loads ? "1.1" : "1.0";
}

void write_head(hdf5::Id file, const Recovery& r, const std::string& where) {
  hdf5::write_text_attribute(file, "/", "format", recovery_format, where);
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
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor share = loads.share.leftCols(inertia_loads);
  const auto n = static_cast<std::uint64_t>(loads.stiffness.size());
  table.numbers("/loads/reference_point", {3}, loads.reference_point.data());
  table.numbers("/loads/share", {n, static_cast<std::uint64_t>(inertia_loads)}, share.data());
  table.numbers("/loads/stiffness", {n}, loads.stiffness.data());
  table.numbers("/loads/left_out", {1}, &loads.left_out);
  const auto boundary = static_cast<std::uint64_t>(loads.boundary_stiffness.rows());
  if (loads.has_forces())
    table.numbers("/loads/boundary_stiffness", {boundary, boundary}, loads.boundary_stiffness.data());
  if (loads.applied.empty()) return;
  const RowMajor applied = loads.share.rightCols(static_cast<Eigen::Index>(loads.applied.size()));
  std::vector<std::string> cases, nodes;
  std::vector<int> component;
  for (const AppliedLoad& load : loads.applied) {
    cases.push_back(load.load_case);
    nodes.push_back(load.node);
    component.push_back(load.component);
  }
  table.texts("/applied/load_case", cases);
  table.texts("/applied/node", nodes);
  table.integers("/applied/component", component);
  table.numbers("/applied/share", {n, cases.size()}, applied.data());
}

void write_second_order(const TableWriter& table, const SecondOrderForms& forms, std::uint64_t n) {
  const auto write = [&](const std::string& dataset, const std::vector<Eigen::MatrixXd>& all) {
    Numbers values;
    for (const Eigen::MatrixXd& one : all)
      for (Eigen::Index k = 0; k < one.rows(); ++k)
        for (Eigen::Index l = k; l < one.cols(); ++l) values.push_back(one(k, l));
    table.numbers(dataset, {all.size(), n * (n + 1) / 2}, values.data());
  };
  write("/second_order/shape_form", forms.of_shape);
  write("/second_order/coordinate_form", forms.of_coordinate);
  table.integers("/second_order/coordinate", forms.coordinate);
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

  Impl(const std::string& path, const Recovery& recovery) : file(path), head(recovery) {
    for (const FieldSet& set : field_sets(recovery))
      fields.push_back(
          {hdf5::create_packed(file.id(), set.dataset, set.shape(), static_cast<std::uint64_t>(set.chunk), file.path()),
           set, 0});
  }

  void append(Growing& growing, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
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

  Growing& of(const FieldSet& set) {
    const auto found = std::ranges::find_if(fields, [&](const Growing& one) { return one.set.dataset == set.dataset; });
    TISSERAND_ENSURE(found != fields.end(), "{} has no {}", file.path(), set.dataset);
    return *found;
  }

  void close_fields() {
    for (Growing& growing : fields) {
      TISSERAND_ENSURE(growing.written == growing.set.items, "{} of {} items", growing.written, growing.set.items);
      hdf5::close_packed(growing.dataset, growing.set.dataset, file.path());
    }
  }

  /// Columns of the inertia loads, then those of the applied loads.
  void append_loads(const FieldSet& inertia, const FieldSet& applied, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
    TISSERAND_ENSURE(rows.cols() == inertia.columns + applied.columns, "{} columns for {}", rows.cols(),
                     inertia.dataset);
    append(of(inertia), rows.leftCols(inertia.columns));
    if (applied.columns > 0) append(of(applied), rows.rightCols(applied.columns));
  }

  hdf5::OutputFile file;
  Recovery head;
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
  if (recovery.second_order) write_second_order(table, *recovery.second_order, recovery.dof_node.size());
}

RecoveryWriter::~RecoveryWriter() = default;

void RecoveryWriter::append(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  impl_->append(impl_->of(of_coordinates(impl_->head, field)), rows);
}

void RecoveryWriter::append_loads(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  impl_->append_loads(of_loads(impl_->head, field), of_applied(impl_->head, field), rows);
}

void RecoveryWriter::append_forces(NodalForce force, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  if (rows.cols() == 0) return;  // of no modes
  const FieldSet set = of_forces(impl_->head, force);
  if (force == NodalForce::load_force || force == NodalForce::load_moment)
    impl_->append_loads(set, of_applied_forces(impl_->head, force), rows);
  else
    impl_->append(impl_->of(set), rows);
}

void RecoveryWriter::append_second_order(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  if (rows.cols() == 0) return;  // of no shapes
  impl_->append(impl_->of(of_second_order(impl_->head, field)), rows);
}

std::string RecoveryWriter::stage() {
  impl_->close_fields();
  return impl_->file.stage();
}

void RecoveryWriter::finish() {
  impl_->close_fields();
  impl_->file.publish();
}

}  // namespace tisserand::formats
