// SPDX-License-Identifier: GPL-3.0-or-later
// *EQUATION: sums of components of nodes that are zero.
#include <cmath>

#include <fmt/format.h>

#include "reducer/decks/abaqus/sets.hpp"
#include "reducer/decks/abaqus/surfaces.hpp"
#include "reducer/decks/abaqus/ties.hpp"

namespace tisserand::reducer::abaqus {
namespace {

/// Term as written: node or set, degree of freedom, coefficient.
struct Term {
  std::vector<int> nodes;
  int component = 0;
  double coefficient = 0.0;
};

/// Adds u in the direction of a component of the node, with *TRANSFORM: one to three terms in part axes.
void add_term(const Model& model, int node, const Term& term, TieEquation& equation) {
  const auto axes = model.node_axes.find(node);
  if (axes == model.node_axes.end()) {
    equation.terms.push_back({node, term.component, term.coefficient});
    return;
  }
  const int first = term.component / 3 * 3;
  const Eigen::Vector3d direction = axes->second.col(term.component - first);
  const std::size_t start = equation.terms.size();
  std::size_t largest = start;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) continue;
    equation.terms.push_back({node, first + k, term.coefficient * direction[k]});
    if (std::abs(equation.terms.back().coefficient) > std::abs(equation.terms[largest].coefficient))
      largest = equation.terms.size() - 1;
  }
  std::swap(equation.terms[start], equation.terms[largest]);  // the largest term is the one to eliminate
}

/// Reads the numbers of one block in sequence, across its lines.
class EquationReader {
 public:
  EquationReader(Model& model, int scope, const Block& block) : model_(model), scope_(scope), block_(block) {}

  void read() {
    while (line_ < block_.data.size()) {
      const Line& line = block_.data[line_];
      const std::vector<std::string_view> fields = split(line.text);
      const std::optional<long> count = fields.size() == 1 ? to_integer(fields[0]) : std::nullopt;
      ++line_;
      if (!count || *count < 1) {
        model_.fault(fmt::format("*EQUATION: '{}' is not a number of terms", line.text.substr(0, 60)), line,
                     "begin every equation with a line that holds its number of terms");
        return;
      }
      if (!read_terms(static_cast<std::size_t>(*count), line)) return;
      add_equations(line);
    }
  }

 private:
  bool read_terms(std::size_t count, const Line& start) {
    terms_.clear();
    while (terms_.size() < count && line_ < block_.data.size()) {
      const Line& line = block_.data[line_++];
      const std::vector<std::string_view> fields = split(line.text);
      if (fields.empty() || fields.size() % 3 != 0) {
        model_.fault("*EQUATION: each term needs a node, a degree of freedom and a coefficient", line,
                     "write three values for each term");
        return false;
      }
      for (std::size_t k = 0; k < fields.size(); k += 3)
        if (!read_term(line, fields[k], fields[k + 1], fields[k + 2])) return false;
    }
    if (terms_.size() == count) return true;
    model_.fault(fmt::format("*EQUATION: {} terms are announced, but {} are given", count, terms_.size()), start,
                 "correct the number");
    return false;
  }

  bool read_term(const Line& line, std::string_view node, std::string_view dof, std::string_view value) {
    const auto nodes = find_nodes(model_, scope_, node, model_.where(line));
    if (!nodes) return false;
    const std::optional<long> component = to_integer(dof);
    const std::optional<double> coefficient = to_number(value);
    if (!component || *component < 1 || *component > 6 || !coefficient) {
      model_.fault(fmt::format("*EQUATION: degree of freedom '{}' or coefficient '{}' is not valid", dof, value), line,
                   "write a degree of freedom from 1 to 6 and a finite coefficient");
      return false;
    }
    terms_.push_back({*nodes, static_cast<int>(*component) - 1, *coefficient});
    return true;
  }

  void add_equations(const Line& line) {
    const std::size_t count = terms_.front().nodes.size();
    for (const Term& term : terms_)
      if (term.nodes.size() != 1 && term.nodes.size() != count) {
        model_.fault(
            fmt::format("*EQUATION: the first set has {} nodes, but another one has {}", count, term.nodes.size()),
            line, "give all sets the same number of nodes, or name single nodes");
        return;
      }
    if (terms_.front().coefficient == 0.0) {
      model_.fault("*EQUATION: the first coefficient is 0", line,
                   "begin with a term whose coefficient is not 0: it is eliminated");
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      TieEquation equation;
      equation.name = fmt::format("equation at {}", model_.where(line));
      for (const Term& term : terms_) {
        const int node = term.nodes[term.nodes.size() == 1 ? 0 : i];
        if (!has_directions(model_, node, model_.where(line))) return;
        add_term(model_, node, term, equation);
      }
      model_.deck.mesh.equations.push_back(std::move(equation));
    }
  }

  Model& model_;
  int scope_;
  const Block& block_;
  std::size_t line_ = 0;
  std::vector<Term> terms_;
};

}  // namespace

void read_equation(Model& model, int scope, const Block& block) { EquationReader(model, scope, block).read(); }

}  // namespace tisserand::reducer::abaqus
