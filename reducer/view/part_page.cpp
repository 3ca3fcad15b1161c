// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies and modes of a page from groups of elements and shapes of coordinates.
#include "reducer/view/part_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/program/version.hpp"
#include "common/text.hpp"
#include "formats/modal_body/modal_body.hpp"
#include "formats/page/header_parts.hpp"
#include "formats/page/page.hpp"
#include "formats/page/skin.hpp"
#include "formats/superelement/superelement.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using formats::Json;
using formats::PageBlocks;
using formats::PageRows;
using formats::Recovery;

constexpr double relative_error = 1e-3;        // of the largest displacement of a mode
constexpr std::size_t most_spider_legs = 500;  // drawn legs of one spider

/// A body of the page.
struct Piece {
  std::string name, kind, colour;  ///< colour empty: a colour of the page
  formats::Surface surface;
  std::vector<formats::SkinCarrier> carriers;
  int all_vertices = 0;
  MatrixXd shapes;              ///< 3 V x n per unit of each coordinate; empty without modes
  std::vector<int> elements{};  ///< element of each triangle; empty: unknown
};

/// Collects vertices of the skin in pieces, each once.
class Pieces {
 public:
  Pieces(const formats::Skin& skin, std::size_t count) : skin_(skin), vertex_(count), pieces_(count) {}

  int vertex(std::size_t piece, int v) {
    const auto [at, is_new] = vertex_[piece].try_emplace(v, pieces_[piece].surface.size());
    if (is_new) {
      pieces_[piece].surface.vertices.push_back(skin_.surface.vertices[v]);
      pieces_[piece].carriers.push_back(skin_.carriers[v]);
    }
    return at->second;
  }
  std::vector<Piece>& all() { return pieces_; }

 private:
  const formats::Skin& skin_;
  std::vector<std::map<int, int>> vertex_;
  std::vector<Piece> pieces_;
};

const char* kind_of(formats::ElementShape shape) {
  if (shape == formats::ElementShape::beam) return "beams";
  return shape == formats::ElementShape::triangle || shape == formats::ElementShape::quadrilateral ? "shells"
                                                                                                   : "solids";
}

/// Groups in order, followed by the faulty elements.
std::vector<Piece> groups_of(const ViewedPart& part) {
  const Recovery& r = part.tables;
  const formats::Skin skin = formats::skin_of(r);
  std::vector<std::size_t> piece(r.elements.group.begin(), r.elements.group.end());
  for (const int element : part.faulty) piece[element] = r.group_name.size();
  Pieces pieces(skin, r.group_name.size() + 1);
  for (std::size_t t = 0; t < skin.surface.triangles.size(); ++t) {
    const std::size_t of = piece[skin.triangle_element[t]];
    const auto& [a, b, c] = skin.surface.triangles[t];
    const std::array<int, 3> triangle{pieces.vertex(of, a), pieces.vertex(of, b), pieces.vertex(of, c)};
    pieces.all()[of].surface.triangles.push_back(triangle);
    pieces.all()[of].elements.push_back(skin.triangle_element[t]);
  }
  for (std::size_t l = 0; l < skin.surface.lines.size(); ++l) {
    const std::size_t of = piece[skin.line_element[l]];
    const std::array<int, 2> line{pieces.vertex(of, skin.surface.lines[l][0]),
                                  pieces.vertex(of, skin.surface.lines[l][1])};
    pieces.all()[of].surface.lines.push_back(line);
  }
  for (std::size_t g = 0; g < r.group_name.size(); ++g) pieces.all()[g].name = r.group_name[g];
  for (int e = 0; e < r.elements.count(); ++e) pieces.all()[r.elements.group[e]].kind = kind_of(r.elements.shape[e]);
  for (std::size_t g = 0; g < part.looks.size(); ++g) {
    pieces.all()[g].kind = part.looks[g].kind;
    pieces.all()[g].colour = part.looks[g].colour;
  }
  pieces.all().back().name = fmt::format("{} faulty elements", part.faulty.size());
  pieces.all().back().kind = "faulty";
  pieces.all().back().colour = "#d62728";
  return std::move(pieces.all());
}

/// Lines from the reference node to its legs.
Piece spider_of(const Recovery& r, const Spider& spider) {
  Piece piece;
  piece.name = "spider " + spider.name;
  piece.kind = spider.kind == SpiderKind::rigid ? "rigid spider" : "averaging spider";
  const auto add = [&](int node) {
    piece.surface.vertices.push_back(r.position.col(node));
    piece.carriers.push_back({node, Vector3d::Zero()});
  };
  add(spider.reference);
  const std::size_t step = std::max<std::size_t>(1, spider.nodes.size() / most_spider_legs);
  for (std::size_t k = 0; k < spider.nodes.size(); k += step) {
    piece.surface.lines.push_back({0, piece.surface.size()});
    add(spider.nodes[k]);
  }
  return piece;
}

void thin(int most, Piece& piece) {
  piece.all_vertices = piece.surface.size();
  if (piece.all_vertices <= most) return;
  formats::Thinned few = formats::thinned(piece.surface, most);
  formats::Surface kept{{}, std::move(few.triangles), std::move(few.lines)};
  std::vector<formats::SkinCarrier> carriers;
  for (const int v : few.kept) {
    kept.vertices.push_back(piece.surface.vertices[v]);
    carriers.push_back(piece.carriers[v]);
  }
  piece.surface = std::move(kept);
  piece.elements.clear();
  piece.carriers = std::move(carriers);
}

/// Motions u + θ x arm of the carriers, 3 V x shapes.
MatrixXd motions_at(const std::vector<ViewedShape>& shapes, const std::vector<formats::SkinCarrier>& carriers) {
  MatrixXd motions(3 * static_cast<Index>(carriers.size()), static_cast<Index>(shapes.size()));
  for (std::size_t k = 0; k < shapes.size(); ++k)
    for (std::size_t v = 0; v < carriers.size(); ++v) {
      const auto node = shapes[k].motion.segment<6>(6 * carriers[v].node);
      motions.block<3, 1>(3 * static_cast<Index>(v), static_cast<Index>(k)) =
          node.head<3>() + Vector3d(node.tail<3>()).cross(carriers[v].arm);
    }
  return motions;
}

std::vector<Piece> pieces_of(const ViewedPart& part) {
  std::vector<Piece> pieces = groups_of(part);
  for (const Spider& spider : part.spiders) pieces.push_back(spider_of(part.tables, spider));
  std::erase_if(pieces, [](const Piece& piece) { return piece.surface.vertices.empty(); });
  for (Piece& piece : pieces) {
    thin(part.vertices, piece);
    if (!part.shapes.empty())
      piece.shapes = motions_at(part.shapes, piece.carriers);
    else if (part.recovery != nullptr)
      piece.shapes = formats::shapes_at(*part.recovery, piece.carriers);
  }
  return pieces;
}

/// Largest displacement of any vertex per unit of each coordinate.
Eigen::VectorXd largest_displacements(const std::vector<Piece>& pieces, Index coordinates) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(coordinates);
  for (const Piece& piece : pieces)
    for (Index k = 0; k < piece.shapes.cols(); ++k)
      for (Index v = 0; v < piece.shapes.rows(); v += 3)
        largest[k] = std::max(largest[k], piece.shapes.col(k).segment<3>(v).norm());
  return largest;
}

Json list_of(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Name of a mode: "base x", "base rx", "internal 3".
std::string mode_name(const Recovery& r, int coordinate) {
  constexpr std::array<const char*, 6> components{"x", "y", "z", "rx", "ry", "rz"};
  const int node = r.dof_node[coordinate], component = r.dof_component[coordinate];
  return node < 0 ? fmt::format("internal {}", component + 1)
                  : fmt::format("{} {}", r.boundary_name[node], components[component]);
}

/// Adds the body, its shape, and its motion in each mode: coordinate k times 1 / largest[k].
void add_piece(const Piece& piece, const Eigen::VectorXd& largest, PageBlocks& blocks, Json& json) {
  formats::Deformation deformation;
  if (piece.shapes.size() > 0) {
    deformation.modes = piece.shapes;
    deformation.amplitudes = (largest.array() > 0.0).select(largest.cwiseInverse(), 0.0).matrix().asDiagonal();
  }
  const formats::FewModes few = formats::few_modes(deformation, relative_error, formats::size_of(piece.surface));
  const Index count = few.count();
  Json body{{"name", piece.name},
            {"kind", piece.kind},
            {"shape", json["shapes"].size()},
            {"position", blocks.add_track(PageRows::Zero(1, 3))},
            {"rotation", blocks.add_rotations(PageRows(Eigen::RowVector4d(1.0, 0.0, 0.0, 0.0)))},
            {"amplitudes", nullptr},
            {"mass", nullptr}};
  if (!piece.colour.empty()) body["colour"] = piece.colour;
  if (count > 0) body["amplitudes"] = blocks.add_floats(PageRows::Zero(1, count), {1, count});
  json["shapes"].push_back(
      formats::shape_json({piece.surface, "recovery", false, piece.all_vertices, 0.0, piece.elements}, few, blocks));
  for (std::size_t k = 0; count > 0 && k < json["modes"].size(); ++k) {
    Json amplitudes = Json::array();
    for (Index j = 0; j < count; ++j) amplitudes.push_back(few.amplitudes(static_cast<Index>(k), j));
    const Json still = {list_of(Vector3d::Zero()), list_of(Vector3d::Zero())};
    json["modes"][k]["bodies"].push_back({{"body", json["bodies"].size()},
                                          {"translation", still},
                                          {"rotation", still},
                                          {"amplitudes", {amplitudes, std::vector<double>(count, 0.0)}}});
  }
  json["bodies"].push_back(std::move(body));
  blocks.next();
}

void add_modes(const ViewedPart& part, Json& json) {
  json["modes"] = nullptr;
  if (part.recovery == nullptr && part.shapes.empty()) return;
  json["modes"] = Json::array();
  for (const ViewedShape& shape : part.shapes)
    json["modes"].push_back(
        {{"name", shape.name}, {"frequency", nullptr}, {"damping", nullptr}, {"bodies", Json::array()}});
  if (!part.shapes.empty()) return;
  for (int k = 0; k < part.tables.coordinates(); ++k) {
    const double frequency = k < count_of(part.frequency) ? part.frequency[k] : 0.0;
    json["modes"].push_back({{"name", mode_name(part.tables, k)},
                             {"frequency", frequency > 0.0 ? Json(frequency) : Json()},
                             {"damping", nullptr},
                             {"bodies", Json::array()}});
  }
}

/// Adds boundary nodes and faces to the first body.
void add_nodes(const ViewedPart& part, PageBlocks& blocks, Json& json) {
  if (json["bodies"].empty()) return;
  const auto add = [&](const std::string& name, const Vector3d& place) {
    json["nodes"].push_back(
        {{"name", name},
         {"body", 0},
         {"place",
          {{"body", 0}, {"position", blocks.add_track(PageRows(place.transpose()))}, {"rest", list_of(place)}}}});
  };
  const Recovery& r = part.tables;
  for (std::size_t i = 0; i < r.boundary_name.size(); ++i) add(r.boundary_name[i], r.position.col(r.boundary_node[i]));
  for (const FacePlace& face : part.faces) add(face.name, face.position);
  blocks.next();
}

/// Lines about the mesh; for groups with looks, about their kinds.
Json report_lines(const ViewedPart& part) {
  const Recovery& r = part.tables;
  Json lines = Json::array({Json::array({"nodes", std::to_string(r.nodes())}),
                            Json::array({"elements", std::to_string(r.elements.count())})});
  if (part.looks.empty()) lines.push_back(Json::array({"boundary nodes", listed(r.boundary_name)}));
  for (std::size_t g = 0; g < part.looks.size(); ++g)
    lines.push_back(Json::array({r.group_name[g], part.looks[g].kind}));
  return lines;
}

}  // namespace

std::string part_page(const ViewedPart& part) {
  const Recovery& r = part.tables;
  PageBlocks blocks;
  Json json{{"name", r.name.empty() ? part.title : r.name},
            {"file", std::filesystem::path(part.file).filename().string()},
            {"kind", "part"},
            {"completed", true},
            {"reason", ""},
            {"units", formats::units_json(part.units)},
            {"up", list_of(Vector3d::UnitZ())},
            {"gravity", list_of(Vector3d::Zero())},
            {"times", blocks.add_times(Eigen::VectorXd::Zero(1))},
            {"thinned", nullptr},
            {"scene", nullptr},
            {"channels_left_out", nullptr}};
  for (const char* list : {"bodies", "shapes", "nodes", "joints", "springs", "arrows", "channels", "references"})
    json[list] = Json::array();
  json["box"] = {list_of(r.position.rowwise().minCoeff()), list_of(r.position.rowwise().maxCoeff())};
  add_modes(part, json);
  const std::vector<Piece> pieces = pieces_of(part);
  const Eigen::VectorXd largest =
      largest_displacements(pieces, part.shapes.empty() ? r.coordinates() : static_cast<Index>(part.shapes.size()));
  for (const Piece& piece : pieces) add_piece(piece, largest, blocks, json);
  add_nodes(part, blocks, json);
  json["report"] = {{"notes", part.notes}, {"lines", report_lines(part)}};
  blocks.next();
  const Json header{{"format", "tisserand-page"},
                    {"version", 1},
                    {"title", part.title},
                    {"program", producer("reducer")},
                    {"runs", Json::array({json})}};
  return formats::page_text(formats::viewer_bundle(), header, blocks);
}

std::vector<double> frequencies_beside(const formats::RecoveryReader& recovery) {
  constexpr std::string_view ending = ".recovery.h5", modal = ".modal.recovery.h5";
  if (!recovery.path().ends_with(ending)) return {};
  const std::string stem = recovery.path().substr(0, recovery.path().size() - ending.size());
  const std::string& id = recovery.recovery().content_id;
  if (recovery.path().ends_with(modal) && std::filesystem::is_regular_file(stem + ".h5")) {
    const formats::ModalBody body = formats::read_modal_body(stem + ".h5").body;
    if (formats::content_id(body) != id) return {};
    std::vector<double> frequency;
    for (const double value : body.omega2) frequency.push_back(std::sqrt(value) / (2.0 * std::numbers::pi));
    return frequency;
  }
  if (!std::filesystem::is_regular_file(stem + ".superelement.h5")) return {};
  const formats::Superelement element = formats::read_superelement(stem + ".superelement.h5").superelement;
  if (formats::content_id(element) != id) return {};
  std::vector<double> frequency(element.dof_node.size(), 0.0);
  for (std::size_t k = 0; k < frequency.size(); ++k)
    if (element.dof_node[k] < 0) {
      const auto i = static_cast<Index>(k);
      const double ratio = element.stiffness(i, i) / element.mass(i, i);  // 1 in canonical form
      frequency[k] = ratio > 0.0 ? std::sqrt(ratio) / (2.0 * std::numbers::pi) : 0.0;
    }
  return frequency;
}

}  // namespace tisserand::reducer
