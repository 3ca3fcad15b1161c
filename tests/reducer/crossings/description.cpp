// SPDX-License-Identifier: GPL-3.0-or-later
// Decks of Nastran and of Abaqus, numbers with all their digits.
#include "tests/reducer/crossings/description.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Geometry>

namespace tisserand::testing::crossings {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Steel, and the tape of the laminate.
constexpr double E = 2.1e11, nu = 0.3, density = 7800.0, thickness = 0.006;
constexpr int axes_of_bushing = 20, axes_of_link = 21;

/// Corners in the other sense; of a quad such that its first edge stays.
std::vector<int> turned_over(const Element& element) {
  const std::vector<int>& n = element.nodes;
  switch (element.shape) {
    case Shape::bar:
      return n;
    case Shape::triangle:
      return {n[1], n[0], n[2]};
    case Shape::quad:
      return {n[1], n[0], n[3], n[2]};
    case Shape::tetrahedron:
      return {n[1], n[0], n[2], n[3]};
    case Shape::prism:
      return {n[1], n[0], n[2], n[4], n[3], n[5]};
    case Shape::brick:
      return {n[0], n[3], n[2], n[1], n[4], n[7], n[6], n[5]};
    case Shape::brick20:
      return {n[0], n[3], n[2],  n[1],  n[4],  n[7],  n[6],  n[5],  n[11], n[10],
              n[9], n[8], n[12], n[15], n[14], n[13], n[19], n[18], n[17], n[16]};
  }
  return n;
}

std::vector<int> nodes_of(const Element& element, const Description& d) {
  std::vector<int> nodes = d.handedness() < 0.0 ? turned_over(element) : element.nodes;
  for (int& node : nodes) node = d.number(node);
  return nodes;
}

/// Cards with fields between commas, eight a line.
class Deck {
 public:
  Deck& card(const std::string& name) {
    if (!text_.empty()) text_ += '\n';
    text_ += name;
    column_ = 0;
    return *this;
  }
  template <class Value>
  Deck& operator()(const Value& value) {
    if (column_++ == 8) {
      text_ += "\n+";
      column_ = 1;
    }
    text_ += ',';
    if constexpr (std::is_floating_point_v<Value>)
      text_ += fmt::format("{:#.17g}", value);
    else
      text_ += fmt::format("{}", value);
    return *this;
  }
  Deck& operator()(const Vector3d& v) { return (*this)(v.x())(v.y())(v.z()); }
  Deck& operator()(const std::vector<int>& list) {
    for (const int value : list) (*this)(value);
    return *this;
  }
  std::string text() const { return text_ + "\n"; }

 private:
  std::string text_;
  int column_ = 0;
};

/// Rectangular axes with x along `x`, z near `z`.
void add_axes(int number, const Vector3d& origin, const Vector3d& x, const Vector3d& z, Deck& deck) {
  const Vector3d normal = (z - x * (x.dot(z) / x.squaredNorm())).normalized();
  const double size = x.norm();
  deck.card("CORD2R")(number)("")(origin)(Vector3d(origin + size * normal))(Vector3d(origin + x));
}

void add_grids(const PartModel& model, const Description& d, Deck& deck) {
  for (int i = 0; i < static_cast<int>(model.nodes.size()); ++i) {
    deck.card("GRID")(d.number(i))("")(d.place(model.nodes[i]));
    if (model.link && (i == model.link->front() || i == model.link->back())) deck(axes_of_link);
  }
}

void add_element(const Element& element, int number, const PartModel& model, const Description& d, Deck& deck) {
  static constexpr std::array<const char*, 7> cards{"CBAR", "CQUAD4", "CTRIA3", "CHEXA", "CHEXA", "CTETRA", "CPENTA"};
  deck.card(cards[static_cast<std::size_t>(element.shape)])(number);
  const std::vector<int> nodes = nodes_of(element, d);
  if (element.shape == Shape::bar) {
    deck(2)(nodes)(Vector3d(d.Q * model.across))("BGG")("")("");  // in basic axes, whatever those of its node
    deck(Vector3d(d.length * (d.Q * model.bar_offset)))(Vector3d(Vector3d::Zero()));
  } else if (element.shape == Shape::quad || element.shape == Shape::triangle) {
    deck(1)(nodes)(d.handedness() * model.turn)(d.length * model.shell_offset);
  } else {
    deck(3)(nodes);
  }
}

void add_properties(const PartModel& model, const Description& d, Deck& deck) {
  const double l2 = d.length * d.length, l4 = l2 * l2, rho = d.mass / (l2 * d.length);
  deck.card("MAT1")(1)(E * d.stress())("")(nu)(density * rho);
  deck.card("MAT8")(2)(1.3e11 * d.stress())(9e9 * d.stress())(0.3)(5e9 * d.stress())(5e9 * d.stress())(3e9 *
                                                                                                       d.stress());
  deck(1600.0 * rho);
  deck.card("PBAR")(2)(1)(8e-4 * l2)(1.2e-7 * l4)(4e-8 * l4)(9e-8 * l4)(0.0)("");
  for (int k = 0; k < 8; ++k) deck("");
  deck(0.85)(0.8);
  deck.card("PSOLID")(3)(1);
  if (!model.is_laminate) {
    deck.card("PSHELL")(1)(1)(thickness * d.length)(1)("")(1);
    return;
  }
  deck.card("PCOMP")(1)("")("")("")("")("")("")("");
  for (const double angle : {0.0, 50.0, -20.0}) deck(2)(0.3 * thickness * d.length)(d.handedness() * angle)("");
}

void add_ties(const PartModel& model, const Description& d, Deck& deck) {
  int number = 1000;
  for (const Spider& spider : model.spiders) {
    std::vector<int> nodes;
    for (const int node : spider.nodes) nodes.push_back(d.number(node));
    if (spider.is_rigid)
      deck.card("RBE2")(number++)(d.number(spider.reference))(spider.with_rotations ? 123456 : 123)(nodes);
    else
      deck.card("RBE3")(number++)("")(d.number(spider.reference))(123456)(1.0)(123)(nodes);
  }
  if (model.link) {
    const auto& [a, b] = *model.link;
    const Vector3d from = d.place(model.nodes[a]), to = d.place(model.nodes[b]);
    add_axes(axes_of_link, from, to - from, d.Q * Vector3d(0.3, -0.2, 1.0), deck);
    deck.card("MPC")(1)(d.number(a))(1)(1.0)(d.number(b))(1)(-1.0);
  }
}

void add_extras(const PartModel& model, const Description& d, Deck& deck) {
  const double l2 = d.length * d.length;
  if (model.mass) {
    const Matrix3d J = d.mass * l2 * d.Q * PartModel::mass_inertia() * d.Q.transpose();
    deck.card("CONM2")(2000)(d.number(*model.mass))("")(d.mass * PartModel::mass_value);
    deck(Vector3d(d.length * (d.Q * PartModel::mass_offset())))("");
    deck(J(0, 0))(-J(1, 0))(J(1, 1))(-J(2, 0))(-J(2, 1))(J(2, 2));
  }
  if (model.bushing) {
    const auto& [a, b] = *model.bushing;
    add_axes(axes_of_bushing, d.place(Vector3d::Zero()), d.length * (d.Q * Vector3d(1.0, 0.3, 0.2)),
             d.Q * Vector3d(0.0, 0.4, 1.0), deck);
    deck.card("CBUSH")(2001)(9)(d.number(a))(d.number(b))("")("")("")(axes_of_bushing);
    deck.card("PBUSH")(9)("K");
    for (const double k : {2e5, 5e5, 9e5}) deck(k * d.mass);
    for (const double k : {300.0, 800.0, 500.0}) deck(k * d.mass * l2);
  }
}

std::string nastran_text(const PartModel& model, const Description& d) {
  Deck deck;
  deck.card("BEGIN BULK").card("PARAM")("COUPMASS")(1);
  add_grids(model, d, deck);
  std::vector<int> order(model.elements.size());
  for (int i = 0; i < static_cast<int>(order.size()); ++i) order[i] = i;
  if (d.renumbered) std::ranges::reverse(order);
  for (const int i : order) add_element(model.elements[i], d.number(i), model, d, deck);
  add_properties(model, d, deck);
  add_ties(model, d, deck);
  add_extras(model, d, deck);
  return deck.card("ENDDATA").text();
}

std::string abaqus_text(const PartModel& model, const Description& d) {
  static constexpr std::array<const char*, 7> types{"B31", "S4", "S3", "C3D8", "C3D20", "C3D4", "C3D6"};
  std::string text = "*NODE\n";
  for (int i = 0; i < static_cast<int>(model.nodes.size()); ++i) {
    const Vector3d x = d.place(model.nodes[i]);
    text += fmt::format("{}, {:.17g}, {:.17g}, {:.17g}\n", d.number(i), x.x(), x.y(), x.z());
  }
  const Shape shape = model.elements.front().shape;
  text += fmt::format("*ELEMENT, TYPE={}, ELSET=ALL\n", types[static_cast<std::size_t>(shape)]);
  int number = 0;
  for (const Element& element : model.elements) {
    std::vector<int> nodes = nodes_of(element, d);
    if (element.shape == Shape::brick20) std::ranges::rotate(nodes.begin() + 12, nodes.begin() + 16, nodes.end());
    text += fmt::format("{}, ", ++number);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      text += fmt::format("{}{}", nodes[k], k + 1 == nodes.size() ? "\n" : k == 12 ? ",\n" : ", ");
  }
  const bool is_shell = shape == Shape::quad || shape == Shape::triangle;
  text += is_shell ? fmt::format("*SHELL SECTION, ELSET=ALL, MATERIAL=STEEL\n{:.17g}\n", thickness * d.length)
                   : std::string("*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n");
  text += fmt::format("*MATERIAL, NAME=STEEL\n*ELASTIC\n{:.17g}, {:.17g}\n*DENSITY\n{:.17g}\n", E, nu, density);
  number = 0;
  for (const Spider& spider : model.spiders) {
    ++number;
    text += fmt::format("*NSET, NSET=N{}\n", number);
    for (const int node : spider.nodes) text += fmt::format("{}\n", d.number(node));
    if (spider.is_rigid)
      text += fmt::format("*RIGID BODY, REF NODE={}, {} NSET=N{}\n", d.number(spider.reference),
                          spider.with_rotations ? "TIE" : "PIN", number);
    else
      text += fmt::format(
          "*SURFACE, TYPE=NODE, NAME=S{0}\nN{0}\n*COUPLING, CONSTRAINT NAME=C{0}, REF NODE={1}, "
          "SURFACE=S{0}\n*DISTRIBUTING\n",
          number, d.number(spider.reference));
  }
  return text;
}

std::string way_text(Way way) {
  switch (way) {
    case Way::modes:
      return "modes: 8\n";
    case Way::moments:
      return "modes: 5\nmoments: 6\n";
    case Way::rubin:
      return "method: rubin\nmodes: 8\n";
    case Way::macneal:
      return "method: macneal\nmodes: 8\n";
    case Way::krylov_schur:
      return "eigensolver: krylov_schur\nmodes: 8\n";
    case Way::lapack:
      return "eigensolver: lapack\nmodes: 8\n";
    case Way::block_lanczos:
      return "eigensolver: block_lanczos\nmodes: 8\n";
  }
  return "";
}

}  // namespace

Description description_of(Change change) {
  Description d;
  const Matrix3d turn = Eigen::AngleAxisd(1.1, Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  const Vector3d normal = Vector3d(0.6, 0.2, -0.5).normalized();
  if (change == Change::turned) d.Q = turn;
  if (change == Change::mirrored) d.Q = Matrix3d::Identity() - 2.0 * normal * normal.transpose();
  if (change == Change::units) d.length = 1e3, d.mass = 1e-3;
  if (change == Change::renumbered) d.renumbered = true;
  if (change == Change::far) d.shift = {600.0, -500.0, 620.0};
  if (change == Change::abaqus) d.is_abaqus = true;
  return d;
}

std::string deck_text(const PartModel& model, const Description& d) {
  return d.is_abaqus ? abaqus_text(model, d) : nastran_text(model, d);
}

std::string part_text(const PartModel& model, const Description& d, Way way, const std::string& deck) {
  std::string text = fmt::format("part: crossing\nmesh: {{file: {}}}\n", deck);
  if (d.length != 1.0) text += "units: {length: mm, mass: t, time: s}\n";
  text += "points:\n";
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < model.boundary.size(); ++i) {
    text += fmt::format("  p{}: {{node: {}}}\n", i, d.number(model.boundary[i]));
    kept.push_back(fmt::format("p{}: {}", i, model.is_bare ? "translations" : "all"));
  }
  text += fmt::format("  load: {{node: {}}}\n", d.number(model.loaded));
  text += fmt::format("boundary: {{{}}}\n", fmt::join(kept, ", "));
  text += way_text(way);
  const std::vector<std::string> held(kept.begin(), model.is_bare ? kept.end() : kept.begin() + 1);
  text += fmt::format("supports: {{{}}}\n", fmt::join(held, ", "));
  const Vector3d force = d.force() * (d.Q * Vector3d(-900.0, 70.0, 110.0));
  const Vector3d gravity = d.length * (d.Q * Vector3d(3.0, -4.0, -9.0));
  text += fmt::format(
      "load_cases:\n  push: {{forces: {{load: [{:.17g}, {:.17g}, {:.17g}]}}, gravity: [{:.17g}, {:.17g}, "
      "{:.17g}]}}\n",
      force.x(), force.y(), force.z(), gravity.x(), gravity.y(), gravity.z());
  return text;
}

}  // namespace tisserand::testing::crossings
