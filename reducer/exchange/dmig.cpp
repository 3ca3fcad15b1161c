// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices from DMIG header and column cards, and the reverse.
#include "reducer/exchange/dmig.hpp"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/decks/nastran/model.hpp"
#include "reducer/exchange/places.hpp"
#include "reducer/exchange/text_lines.hpp"

namespace tisserand::reducer::exchange {
namespace {

constexpr long first_scalar_point = 1000001;
constexpr int first_term = 4;  ///< fields 0 to 3 are name, GJ, CJ, blank; then four per term
constexpr long largest_range = 100000;

/// Points of the cards: grids have places, scalar points have none.
struct Points {
  Places places;
  std::set<long> scalar;
};

void read_scalar_points(NastranModel& model, Points& points) {
  const auto all = [](long first, long last, std::vector<long>& ids) {
    for (long id = first; id <= last && id - first < largest_range; ++id) ids.push_back(id);
  };
  for (const char* name : {"SPOINT", "EPOINT"})
    model.for_each(name, [&](CardFields& fields) {
      for (const long id : fields.id_list(0, "ID", all)) points.scalar.insert(id);
    });
}

/// A fault, and the number of further cards that have it.
struct Repeated {
  std::string text, where, remedy;
  std::size_t more = 0;
};

struct Reader {
  NastranModel& model;
  const Points& points;
  std::map<std::string, TextMatrix> matrices = {};  ///< key: name in capitals
  std::set<std::string> refused = {};               ///< matrices with a fault in the header: their columns are skipped
  std::map<std::string, Repeated> faults = {};      ///< key: kind of fault; a wrong value may occur in many columns

  void fault(CardFields& fields, const std::string& what, const std::string& remedy);
  void raise_faults();

  void header(CardFields& fields, const std::string& name);
  void column(CardFields& fields, const std::string& name);
  RowKey key(CardFields& fields, int index);
};

void Reader::fault(CardFields& fields, const std::string& what, const std::string& remedy) {
  fields.mark_faulty();
  const auto [found, is_new] = faults.try_emplace(what, Repeated{fields.label() + ": " + what, fields.where(), remedy});
  if (!is_new) ++found->second.more;
}

void Reader::raise_faults() {
  for (const auto& [what, f] : faults)
    model.faults.add(f.more == 0 ? f.text : fmt::format("{} (and {} more cards)", f.text, f.more), f.where, f.remedy);
  model.faults.raise();
}

void Reader::header(CardFields& fields, const std::string& name) {
  const long form = fields.integer(2, "IFO", 0), type = fields.integer(3, "TIN", 0);
  const long polar = fields.integer(5, "POLAR", 0);
  refused.insert(name);  // until the header is accepted
  if (!fields.ok()) return;
  if (form != 1 && form != 6)
    return fields.fault(fmt::format("IFO is {}, expected 6 (symmetric) or 1 (square)", form), "give a square matrix");
  if ((type != 1 && type != 2) || polar != 0)
    return fields.fault(fmt::format("TIN is {}, POLAR {}: expected a real matrix, TIN 1 or 2", type, polar),
                        "export stiffness and mass without damping");
  TextMatrix matrix{
      name, model.cards.files[fields.card().file], form == 6 ? Storage::one_triangle : Storage::square, {}};
  if (!matrices.emplace(name, std::move(matrix)).second)
    return fields.fault(fmt::format("matrix {} has a second header", name), "keep one matrix of that name in the file");
  refused.erase(name);
}

RowKey Reader::key(CardFields& fields, int index) {
  const long id = fields.id(index, "G");
  const long component = fields.integer(index + 1, "C", 0);
  if (!fields.ok()) return {};
  const bool grid = points.places.contains(id);
  const bool scalar = points.scalar.contains(id) || (points.scalar.empty() && !grid && component == 0);
  if (scalar && component <= 1) return {id, scalar_component};
  if (component < 1 || component > 6) {
    fault(fields,
          grid ? fmt::format("component {} of GRID {}, expected 1 to 6", component, id)
               : fmt::format("point {} with component {} is not an SPOINT or EPOINT", id, component),
          grid ? "correct the component" : "add the SPOINT card, here or in the file of positions");
    return {};
  }
  if (scalar)
    fault(fields, fmt::format("component {} of scalar point {}, expected 0 or 1", component, id),
          "correct the component");
  return {id, static_cast<int>(component) - 1};
}

void Reader::column(CardFields& fields, const std::string& name) {
  if (refused.contains(name)) return;
  const auto found = matrices.find(name);
  if (found == matrices.end())
    return fault(fields, fmt::format("this column of {} comes before its header", name),
                 "begin the matrix with a card DMIG, name, 0, IFO, TIN");
  const RowKey column = key(fields, 1);
  for (int i = first_term; i < fields.size() && fields.ok(); i += 4) {
    if (fields.blank(i) && fields.blank(i + 1) && fields.blank(i + 2)) continue;
    const RowKey row = key(fields, i);
    const double value = fields.real(i + 2, "A"), imaginary = fields.real(i + 3, "B", 0.0);
    if (fields.ok() && imaginary != 0.0) fault(fields, "has an imaginary part", "export real matrices");
    if (fields.ok()) add_entry(found->second, {row, column, value, fields.card().line});
  }
}

const TextMatrix& find_matrix(const Reader& reader, const std::string& wanted, const std::string& path) {
  const auto found = reader.matrices.find(capitals(wanted));
  if (found != reader.matrices.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, matrix] : reader.matrices) names.push_back(name);
  throw Error(fmt::format("holds no DMIG matrix {}{}", wanted,
                          names.empty() ? std::string() : fmt::format(", only {}", listed(names))),
              path, "name the matrices with --matrices K,M");
}

/// Comment with the number of terms before a matrix, in files of this program: a text that lost a line is still valid.
std::string count_comment(const std::string& name, std::size_t terms) {
  return fmt::format("$ {} below has {} terms", name, terms);
}

/// Throws Error if the comment before the matrix gives another number of terms than were read.
void check_count(const NastranModel& model, const TextMatrix& matrix) {
  const std::string before = fmt::format("$ {} below has ", matrix.title);
  for (const std::unique_ptr<std::string>& text : model.cards.texts) {
    const std::size_t at = text->find(before);
    if (at == std::string::npos || (at > 0 && (*text)[at - 1] != '\n')) continue;
    const long terms = std::atol(text->c_str() + at + before.size());
    if (count_comment(matrix.title, static_cast<std::size_t>(terms)) !=
        trimmed(std::string_view(*text).substr(at, text->find('\n', at) - at)))
      continue;
    if (static_cast<std::size_t>(terms) != matrix.entries.size())
      throw Error(
          fmt::format("{} has {} terms, but the comment before it says {}", matrix.title, matrix.entries.size(), terms),
          matrix.file, "lines are missing or were added: export the matrix again, or remove the comment");
  }
}

std::string table(const std::vector<long>& values, const std::string& card, const std::string& before) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); i += 6) {
    text += fmt::format("{:<8}{}", card, before);
    for (std::size_t k = i; k < std::min(i + 6, values.size()); ++k) text += fmt::format("{:>8}", values[k]);
    text += "\n";
  }
  return text;
}

std::string matrix_text(const std::string& name, const Eigen::MatrixXd& A, const std::vector<RowKey>& keys) {
  std::string text = fmt::format("DMIG    {:<8}{:>8}{:>8}{:>8}{:>8}\n", name, 0, 6, 2, 0);
  std::size_t terms = 0;
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    std::string column;
    for (Eigen::Index i = j; i < A.rows(); ++i) {
      const RowKey& row = keys[i];
      if (A(i, j) == 0.0) continue;
      ++terms;
      column += fmt::format("*       {:>16}{:>16}{:>16}\n", row.node, row.component + 1, real_field(A(i, j), 'D'));
    }
    const RowKey& key = keys[j];
    if (!column.empty())
      text += fmt::format("DMIG*   {:<16}{:>16}{:>16}\n{}", name, key.node, key.component + 1, column);
  }
  return count_comment(name, terms) + "\n" + text;
}

}  // namespace

ReducedMatrices read_dmig(const DmigSource& source) {
  NastranModel model;
  read_cards(source.path, model);
  Points points{places_of(model), {}};
  read_scalar_points(model, points);
  if (!source.positions.empty()) {
    NastranModel second;
    read_cards(source.positions, second);
    points.places.merge(places_of(second));
    read_scalar_points(second, points);
    second.faults.raise();
  }
  for (const long id : points.scalar)
    if (points.places.contains(id))
      throw Error(fmt::format("point {} is both a GRID and a scalar point", id), source.path,
                  "remove one of the cards");

  Reader reader{model, points};
  model.for_each("DMIG", [&](CardFields& fields) {
    const std::string name = capitals(fields.text(0));
    if (name.empty()) return fields.fault("the matrix has no name", "give the matrix a name");
    if (fields.text(1) == "0")
      reader.header(fields, name);
    else
      reader.column(fields, name);
  });
  reader.raise_faults();
  for (const auto& [name, matrix] : reader.matrices) check_count(model, matrix);
  ReducedMatrices matrices;
  matrices.format = "dmig";
  matrices.source = source.path;
  matrices.places = points.places;
  const TextMatrix& stiffness = find_matrix(reader, source.stiffness, source.path);
  assemble(stiffness, find_matrix(reader, source.mass, source.path), matrices);
  return matrices;
}

std::string real_field(double value, char letter) {
  for (int digits = 16; digits >= 0; --digits) {
    const std::string text = fmt::format("{:.{}e}", value, digits);
    const std::size_t e = text.find('e');
    std::string mantissa = text.substr(0, e);
    if (mantissa.find('.') == std::string::npos) mantissa += ".0";
    while (mantissa.back() == '0' && mantissa[mantissa.size() - 2] != '.') mantissa.pop_back();
    const int exponent = std::atoi(text.c_str() + e + 1);
    std::string field = fmt::format("{}{}{}", mantissa, letter, exponent);
    if (field.size() > 16 && exponent < 0) field = fmt::format("{}{}", mantissa, exponent);
    if (field.size() <= 16) return field;
  }
  return "";
}

std::string dmig_text(const formats::Superelement& element) {
  std::vector<RowKey> keys;
  std::vector<long> scalar;
  for (std::size_t i = 0; i < element.dof_node.size(); ++i) {
    const int node = element.dof_node[i];
    keys.push_back(node >= 0 ? RowKey{node + 1, element.dof_component[i]}
                             : RowKey{first_scalar_point + element.dof_component[i], scalar_component});
    if (node < 0) scalar.push_back(keys.back().node);
  }
  std::string text = fmt::format("$ {}, by {}\n$ units: {}\n", element.name, element.producer,
                                 element.units.named() ? fmt::format("{}, {}, {}", element.units.length.label,
                                                                     element.units.mass.label, element.units.time.label)
                                                       : "consistent, without names");
  for (std::size_t b = 0; b < element.node_name.size(); ++b) {
    const Eigen::RowVector3d x = element.node_position.row(b);
    text += fmt::format("$ node {}\nGRID*   {:>16}{:>16}{:>16}{:>16}\n*       {:>16}\n", element.node_name[b], b + 1,
                        "", real_field(x[0], 'E'), real_field(x[1], 'E'), real_field(x[2], 'E'));
  }
  text += table(scalar, "SPOINT", "");
  for (int b = 0; b < std::ssize(element.node_name); ++b) {
    std::string components;
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (element.dof_node[i] == b) components += static_cast<char>('1' + element.dof_component[i]);
    std::sort(components.begin(), components.end());
    text += fmt::format("ASET1   {:>8}{:>8}\n", components, b + 1);
  }
  text += table(scalar, "ASET1", "        ");
  return text + matrix_text("KAAX", element.stiffness, keys) + matrix_text("MAAX", element.mass, keys);
}

}  // namespace tisserand::reducer::exchange
