// SPDX-License-Identifier: GPL-3.0-or-later
// Writes recovery files: tables at once, fields in blocks.
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

/// Oldest version that supports all contents of the file.
const char* version_of(const Recovery& r) {
  if (r.second_order || (r.loads && !r.loads->applied.empty())) return "1.3";
  if (!r.node_number.empty() || (r.loads && r.loads->has_forces())) return "1.2";
  return r.loads ? "1.1" : "1.0";
}

void write_head(const hdf5::Output& out, const Recovery& r) {
  hdf5::write_attribute(out, "/", "format", recovery_format);
  hdf5::write_attribute(out, "/", "version", version_of(r));
  hdf5::write_attribute(out, "/", "name", r.name);
  hdf5::write_attribute(out, "/", "producer", r.producer);
  hdf5::write_attribute(out, "/", "content_id", r.content_id);
  hdf5::write_texts(out, "/mirror/content_id", {r.mirror_content_id.begin(), r.mirror_content_id.end()});
  hdf5::write_units(out, r.units);
}

void write_mesh(const hdf5::Output& out, const Recovery& r) {
  const auto nodes = static_cast<std::uint64_t>(r.nodes());
  hdf5::write_texts(out, "/boundary/name", r.boundary_name);
  hdf5::write_dataset(out, "/boundary/node", r.boundary_node);
  hdf5::write_dataset(out, "/dof/node", r.dof_node);
  hdf5::write_dataset(out, "/dof/component", r.dof_component);
  hdf5::write_dataset(out, "/nodes/position", {nodes, 3}, r.position.data());
  hdf5::write_texts(out, "/nodes/label", r.node_label);
  hdf5::write_dataset(out, "/nodes/rotates", r.rotates);
  if (!r.node_number.empty()) hdf5::write_dataset(out, "/nodes/number", r.node_number);
  hdf5::write_texts(out, "/groups/name", r.group_name);
  std::vector<int> shapes;
  for (const ElementShape shape : r.elements.shape) shapes.push_back(static_cast<int>(shape));
  hdf5::write_dataset(out, "/elements/shape", shapes);
  hdf5::write_dataset(out, "/elements/group", r.elements.group);
  hdf5::write_dataset(out, "/elements/id", r.elements.id);
  hdf5::write_dataset(out, "/elements/first", r.elements.first);
  hdf5::write_dataset(out, "/elements/node", r.elements.node);
  hdf5::write_dataset(out, "/surface/triangle", {static_cast<std::uint64_t>(r.triangle.cols()), 3}, r.triangle.data());
  hdf5::write_dataset(out, "/surface/element", r.triangle_element);
  hdf5::write_dataset(out, "/stress_points/node", r.stress_node);
  hdf5::write_dataset(out, "/stress_points/group", r.stress_group);
}

void write_loads(const hdf5::Output& out, const RecoveryLoads& loads) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor share = loads.share.leftCols(inertia_loads);
  const auto n = static_cast<std::uint64_t>(loads.stiffness.size());
  hdf5::write_dataset(out, "/loads/reference_point", loads.reference_point);
  hdf5::write_dataset(out, "/loads/share", {n, static_cast<std::uint64_t>(inertia_loads)}, share.data());
  hdf5::write_dataset(out, "/loads/stiffness", loads.stiffness);
  hdf5::write_dataset(out, "/loads/left_out", {1}, &loads.left_out);
  const auto boundary = static_cast<std::uint64_t>(loads.boundary_stiffness.rows());
  if (loads.has_forces())
    hdf5::write_dataset(out, "/loads/boundary_stiffness", {boundary, boundary}, loads.boundary_stiffness.data());
  if (loads.applied.empty()) return;
  const RowMajor applied = loads.share.rightCols(static_cast<Eigen::Index>(loads.applied.size()));
  std::vector<std::string> cases, nodes;
  std::vector<int> component;
  for (const AppliedLoad& load : loads.applied) {
    cases.push_back(load.load_case);
    nodes.push_back(load.node);
    component.push_back(load.component);
  }
  hdf5::write_texts(out, "/applied/load_case", cases);
  hdf5::write_texts(out, "/applied/node", nodes);
  hdf5::write_dataset(out, "/applied/component", component);
  hdf5::write_dataset(out, "/applied/share", {n, cases.size()}, applied.data());
}

void write_second_order(const hdf5::Output& out, const SecondOrderForms& forms, std::uint64_t n) {
  const auto write = [&](const std::string& dataset, const std::vector<Eigen::MatrixXd>& all) {
    Numbers values;
    for (const Eigen::MatrixXd& one : all)
      for (Eigen::Index k = 0; k < one.rows(); ++k)
        for (Eigen::Index l = k; l < one.cols(); ++l) values.push_back(one(k, l));
    hdf5::write_dataset(out, dataset, {all.size(), n * (n + 1) / 2}, values.data());
  };
  write("/second_order/shape_form", forms.of_shape);
  write("/second_order/coordinate_form", forms.of_coordinate);
  hdf5::write_dataset(out, "/second_order/coordinate", forms.coordinate);
}

void write_properties(const hdf5::Output& out, const Recovery& r) {
  const auto beams = static_cast<std::uint64_t>(r.beams()), shells = static_cast<std::uint64_t>(r.shells());
  hdf5::write_dataset(out, "/beams/axes", {beams, 3, 3}, rows_of(r.beam_axes).data());
  hdf5::write_dataset(out, "/beams/offset", {beams, 2, 3}, r.beam_offset.data());
  hdf5::write_dataset(out, "/beams/section", {beams, 2}, r.beam_section.data());
  std::vector<double> constants, outline;
  std::vector<int> known, first{0};
  for (const RecoverySection& s : r.sections) {
    constants.insert(constants.end(),
                     {s.area, s.second_moment_y, s.second_moment_z, s.second_moment_yz, s.centroid_y, s.centroid_z});
    for (const Eigen::Vector2d& point : s.outline) outline.insert(outline.end(), {point.x(), point.y()});
    known.push_back(s.outline_known ? 1 : 0);
    first.push_back(count_of(outline) / 2);
  }
  hdf5::write_dataset(out, "/sections/constants", {r.sections.size(), 6}, constants.data());
  hdf5::write_dataset(out, "/sections/outline_known", known);
  hdf5::write_dataset(out, "/sections/outline_first", first);
  hdf5::write_dataset(out, "/sections/outline", {outline.size() / 2, 2}, outline.data());
  hdf5::write_dataset(out, "/shells/axes", {shells, 3, 3}, rows_of(r.shell_axes).data());
  hdf5::write_dataset(out, "/shells/thickness", r.shell_thickness);
  hdf5::write_dataset(out, "/shells/offset", r.shell_offset);
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
          {hdf5::create_packed(file.output(), set.dataset, set.shape(), static_cast<std::uint64_t>(set.chunk)), set,
           0});
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
      throw Error(fmt::format("a value for {} is {:.3g}, outside the range of 32-bit floating numbers", set.dataset,
                              rows.cwiseAbs().maxCoeff()),
                  file.path(),
                  "choose units in which lengths, forces and masses are neither very large nor very small");
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

  /// Appends the columns of the inertia loads, then those of the applied loads.
  void append_loads(const FieldSet& inertia, const FieldSet& applied, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
    TISSERAND_ENSURE(rows.cols() == inertia.columns + applied.columns, "{} columns for {}", rows.cols(),
                     inertia.dataset);
    append(of(inertia), rows.leftCols(inertia.columns));
    if (applied.columns > 0) append(of(applied), rows.rightCols(applied.columns));
  }

  hdf5::OutputFile file;
  Recovery head;
  std::vector<Growing> fields;  ///< datasets of field_sets()
};

RecoveryWriter::RecoveryWriter(const std::string& path, const Recovery& recovery) {
  check(recovery, path);
  impl_ = std::make_unique<Impl>(path, recovery);
  const hdf5::Output out = impl_->file.output();
  write_head(out, recovery);
  write_mesh(out, recovery);
  write_properties(out, recovery);
  if (recovery.loads) write_loads(out, *recovery.loads);
  if (recovery.second_order) write_second_order(out, *recovery.second_order, recovery.dof_node.size());
}

RecoveryWriter::~RecoveryWriter() = default;

void RecoveryWriter::append(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  impl_->append(impl_->of(of_coordinates(impl_->head, field)), rows);
}

void RecoveryWriter::append_loads(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  impl_->append_loads(of_loads(impl_->head, field), of_applied(impl_->head, field), rows);
}

void RecoveryWriter::append_forces(NodalForce force, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  if (rows.cols() == 0) return;  // no modes
  const FieldSet set = of_forces(impl_->head, force);
  if (force == NodalForce::load_force || force == NodalForce::load_moment)
    impl_->append_loads(set, of_applied_forces(impl_->head, force), rows);
  else
    impl_->append(impl_->of(set), rows);
}

void RecoveryWriter::append_second_order(RecoveryField field, const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  if (rows.cols() == 0) return;  // no shapes
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
