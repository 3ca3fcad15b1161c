// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes of the mesh from GRID, GRDSET and the coordinate systems of a Nastran deck.
#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "reducer/decks/nastran/model.hpp"

namespace tisserand::reducer {
namespace {

constexpr int deepest_chain = 200;
constexpr double farthest = 1e30;

/// CORD card before its axes are known: three points in another system, or three grid points.
struct FrameCard {
  CardFields fields;
  long id = 0;
  FrameKind kind = FrameKind::rectangular;
  bool by_grids = false;
  std::array<long, 3> grids{};  ///< ids
  long reference = 0;           ///< id of the points' system
  std::array<Eigen::Vector3d, 3> points;
  enum class State { open, busy, done, failed } state = State::open;
};

struct GridCard {
  int position_frame = 0;
  Eigen::Vector3d x;
};

/// Follows references between systems and grid points until all are placed in the part frame.
class Placement {
 public:
  explicit Placement(NastranModel& model) : model_(model) {}
  void read_frames();
  void read_grids();
  void place();

 private:
  void add_frame(FrameCard card);
  void add_by_grids(CardFields& fields, FrameKind kind, int first);
  void add_by_points(CardFields& fields, FrameKind kind);
  void read_grid(CardFields& fields, const GridDefaults& defaults);
  GridDefaults read_defaults();
  int frame_field(CardFields& fields, int index, std::string_view name, int if_blank);
  bool resolve(int frame, CardFields& asked, int depth);
  std::optional<Eigen::Vector3d> corner(FrameCard& card, std::size_t i, int depth);

  NastranModel& model_;
  std::vector<FrameCard> frames_;  ///< index = index in NastranFrames − 1
  std::vector<GridCard> grids_;
};

void Placement::add_frame(FrameCard card) {
  if (!card.fields.ok()) return;
  const int row = count_of(model_.frames.frames);
  if (!model_.frames.row_of_id.emplace(card.id, row).second)
    return card.fields.fault(fmt::format("coordinate system {} is defined twice", card.id), "remove one of the cards");
  NastranFrame frame;
  frame.kind = card.kind;
  model_.frames.frames.push_back(frame);
  frames_.push_back(std::move(card));
}

void Placement::add_by_grids(CardFields& fields, FrameKind kind, int first) {
  FrameCard card{fields, 0, kind, true, {}, 0, {}, FrameCard::State::open};
  card.id = fields.id(first, "CID");
  for (int i = 0; i < 3; ++i) card.grids[i] = fields.id(first + 1 + i, "G");
  card.fields = fields;
  add_frame(std::move(card));
}

void Placement::add_by_points(CardFields& fields, FrameKind kind) {
  FrameCard card{fields, 0, kind, false, {}, 0, {}, FrameCard::State::open};
  card.id = fields.id(0, "CID");
  card.reference = fields.id_or_none(1, "RID");
  card.points = {fields.vector(2, "A"), fields.vector(5, "B"), fields.vector(8, "C")};
  card.fields = fields;
  add_frame(std::move(card));
}

void Placement::read_frames() {
  const std::array<std::pair<char, FrameKind>, 3> kinds{
      {{'R', FrameKind::rectangular}, {'C', FrameKind::cylindrical}, {'S', FrameKind::spherical}}};
  for (const auto& [letter, of_letter] : kinds) {
    const FrameKind kind = of_letter;
    model_.for_each(fmt::format("CORD1{}", letter), [&](CardFields& fields) {
      add_by_grids(fields, kind, 0);
      if (fields.ok() && !fields.blank(4)) add_by_grids(fields, kind, 4);
    });
    model_.for_each(fmt::format("CORD2{}", letter), [&](CardFields& fields) { add_by_points(fields, kind); });
  }
}

int Placement::frame_field(CardFields& fields, int index, std::string_view name, int if_blank) {
  if (fields.blank(index)) return if_blank;
  return std::max(0, model_.frame(fields, index, name));
}

GridDefaults Placement::read_defaults() {
  GridDefaults defaults;
  bool seen = false;
  model_.for_each("GRDSET", [&](CardFields& fields) {
    if (seen) fields.fault("a deck can have only one GRDSET", "remove the others");
    seen = true;
    defaults.position_frame = frame_field(fields, 1, "CP", 0);
    defaults.displacement_frame = frame_field(fields, 5, "CD", 0);
    defaults.fixed = fields.components(6, "PS", 0);
  });
  return defaults;
}

void Placement::read_grid(CardFields& fields, const GridDefaults& defaults) {
  GridCard grid;
  const long id = fields.id(0, "ID");
  grid.position_frame = frame_field(fields, 1, "CP", defaults.position_frame);
  grid.x = fields.vector(2, "X");
  const int displacement_frame = frame_field(fields, 5, "CD", defaults.displacement_frame);
  const Components fixed = fields.components(6, "PS", defaults.fixed);
  if (id == 0) return;
  grids_.push_back(grid);
  model_.grid_id.push_back(id);
  model_.grid_card.push_back(model_.row(fields));
  model_.displacement_frame.push_back(displacement_frame);
  model_.fixed.push_back(fixed);
}

void Placement::read_grids() {
  const GridDefaults defaults = read_defaults();
  model_.for_each("GRID", [&](CardFields& fields) { read_grid(fields, defaults); });
  for (const int row : model_.grid_rows.build(model_.grid_id)) {
    CardFields fields = model_.card(model_.grid_card[row]);
    fields.fault("this grid point is defined twice", "remove one of the cards");
  }
}

/// Position of one of the three points of a system; empty after a fault.
std::optional<Eigen::Vector3d> Placement::corner(FrameCard& card, std::size_t i, int depth) {
  int frame = model_.frames.find(card.reference);
  Eigen::Vector3d x = card.points[i];
  if (card.by_grids) {
    const int node = model_.node_of(card.fields, card.grids[i], "G");
    if (node < 0) return std::nullopt;
    frame = grids_[node].position_frame;
    x = grids_[node].x;
  } else if (frame < 0)
    return card.fields.refuse(fmt::format("RID names coordinate system {}, which is missing", card.reference),
                              "add its CORD card");
  if (!resolve(frame, card.fields, depth + 1)) return std::nullopt;
  return frame_point(model_.frames.frames[frame], x);
}

/// Computes the axes of a system: z from A to B; C lies in the half-plane of positive x.
bool Placement::resolve(int row, CardFields& asked, int depth) {
  if (row == 0) return true;
  FrameCard& card = frames_[row - 1];
  if (card.state == FrameCard::State::done) return true;
  if (card.state == FrameCard::State::failed) return false;
  if (card.state == FrameCard::State::busy || depth > deepest_chain) {
    asked.fault(card.state == FrameCard::State::busy
                    ? fmt::format("coordinate system {} depends on itself", card.id)
                    : fmt::format("more than {} coordinate systems depend on each other in a chain", deepest_chain),
                "define one of the systems in basic coordinates");
    card.state = FrameCard::State::failed;
    return false;
  }
  card.state = FrameCard::State::busy;
  std::array<Eigen::Vector3d, 3> p;
  bool known = true;
  for (std::size_t i = 0; i < 3 && known; ++i) {
    const std::optional<Eigen::Vector3d> point = corner(card, i, depth);
    known = point.has_value();
    if (point) p[i] = *point;
  }
  const bool failed = !known || card.state == FrameCard::State::failed;
  card.state = FrameCard::State::failed;
  if (failed) return false;
  const Eigen::Vector3d z = (p[1] - p[0]).normalized();
  const Eigen::Vector3d y = z.cross(p[2] - p[0]);
  if (!(y.norm() > 1e-9 * (p[2] - p[0]).norm()) || !(p[1] - p[0]).allFinite()) {
    card.fields.fault(fmt::format("the three points of coordinate system {} lie on a line", card.id),
                      "move the third point away from the z axis");
    return false;
  }
  NastranFrame& frame = model_.frames.frames[row];
  frame.origin = p[0];
  frame.axes.col(2) = z;
  frame.axes.col(1) = y.normalized();
  frame.axes.col(0) = frame.axes.col(1).cross(z);
  card.state = FrameCard::State::done;
  return true;
}

void Placement::place() {
  for (int i = 0; i < std::ssize(frames_); ++i) resolve(i + 1, frames_[i].fields, 0);
  Mesh& mesh = model_.deck.mesh;
  mesh.position.resize(3, static_cast<Eigen::Index>(grids_.size()));
  mesh.node_label.reserve(grids_.size());
  for (std::size_t i = 0; i < grids_.size(); ++i) {
    const NastranFrame& frame = model_.frames.frames[grids_[i].position_frame];
    const Eigen::Vector3d position = frame_point(frame, grids_[i].x);
    if (!(position.cwiseAbs().maxCoeff() < farthest)) {
      CardFields fields = model_.card(model_.grid_card[i]);
      fields.fault(fmt::format("a coordinate exceeds {:g}", farthest), "correct the coordinates");
    }
    mesh.position.col(i) = position;
    mesh.node_label.push_back("node " + std::to_string(model_.grid_id[i]));
  }
}

}  // namespace

void place_grids(NastranModel& model) {
  Placement placement(model);
  placement.read_frames();
  placement.read_grids();
  placement.place();
}

int NastranModel::node_of(CardFields& fields, long id, std::string_view name) {
  if (!fields.ok()) return -1;
  const int row = grid_rows.find(id);
  if (row < 0)
    fields.fault(fmt::format("{} names GRID {}, which is missing", name, id), "add the GRID or correct the number");
  return row;
}

int NastranModel::node(CardFields& fields, int index, std::string_view name) {
  const long id = fields.id(index, name);
  return id > 0 ? node_of(fields, id, name) : -1;
}

int NastranModel::element_id(CardFields& fields, int index) {
  const long id = fields.id(index, "EID");
  if (id > 0) element_card.emplace_back(id, row(fields));
  return static_cast<int>(id);
}

int NastranModel::frame(CardFields& fields, int index, std::string_view name) {
  if (fields.blank(index)) return 0;
  const long id = fields.id_or_none(index, name);
  if (!fields.ok()) return -1;
  const int found = frames.find(id);
  if (found < 0)
    fields.fault(fmt::format("{} names coordinate system {}, which is missing", name, id), "add its CORD card");
  return found;
}

Eigen::Matrix3d NastranModel::displacement_axes(int node) const {
  const int row = displacement_frame[node];
  if (row == 0) return Eigen::Matrix3d::Identity();
  return frame_axes_at(frames.frames[row], position(node));
}

}  // namespace tisserand::reducer
