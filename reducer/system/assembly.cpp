// SPDX-License-Identifier: GPL-3.0-or-later
// Assembly: graph of the nodes, then element matrices in batches, computed and added by all threads. If there are
// several ranks, each computes the rows of its share of the nodes.
#include "reducer/system/assembly.hpp"

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>

#include "common/error.hpp"
#include "common/parallel.hpp"
#include "reducer/algebra/ranks.hpp"
#include "reducer/elements/each_element.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {
namespace {

constexpr int batch_size = 1024;  ///< elements whose matrices are held together: at most 60 MB (20-node bricks)

/// Neighbours with a number not below its own for each node of a share, the node itself first, and the places of their
/// columns in the node's first row.
struct NodeGraph {
  Share nodes;
  std::vector<int> begin{0};  ///< ... of the share's first node, and so on
  std::vector<int> neighbour;
  std::vector<int> shift;
};

/// Elements at each node: those of node n are element[begin[n]] ... element[begin[n + 1] − 1], ascending.
struct Incidence {
  std::vector<int> begin;
  std::vector<int> element;
};

Incidence find_incidence(const Mesh& mesh) {
  Incidence incidence{std::vector<int>(static_cast<std::size_t>(mesh.nodes()) + 1, 0), {}};
  long total = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    const ElementNodes nodes = element_nodes(mesh, e);
    total += nodes.count;
    for (const int n : nodes) ++incidence.begin[n + 1];
  }
  check_entry_count(total);
  for (std::size_t n = 1; n < incidence.begin.size(); ++n) incidence.begin[n] += incidence.begin[n - 1];
  incidence.element.resize(static_cast<std::size_t>(total));
  std::vector<int> next(incidence.begin);
  for (int e = 0; e < mesh.elements(); ++e)
    for (const int n : element_nodes(mesh, e)) incidence.element[next[n]++] = e;
  return incidence;
}

NodeGraph share_of_graph(const Mesh& mesh, const Coordinates& coordinates, const Incidence& incidence, Share share) {
  NodeGraph graph;
  graph.nodes = share;
  std::vector<int> found;
  for (int n = share.first; n < share.end; ++n) {
    found.assign(1, n);
    for (int k = incidence.begin[n]; k < incidence.begin[n + 1]; ++k)
      for (const int m : element_nodes(mesh, incidence.element[k]))
        if (m > n) found.push_back(m);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    int width = 0;
    for (const int m : found) {
      graph.neighbour.push_back(m);
      graph.shift.push_back(width);
      width += coordinates.rotates(m) ? 6 : 3;
    }
    graph.begin.push_back(count_of(graph.neighbour));
  }
  return graph;
}

/// Share of thread t of `threads` in those nodes.
Share part_of(Share nodes, int t, int threads) {
  const Share part = share_of(nodes.end - nodes.first, t, threads);
  return {nodes.first + part.first, nodes.first + part.end};
}

NodeGraph find_graph(const Mesh& mesh, const Coordinates& coordinates, Share nodes, int threads) {
  const Incidence incidence = find_incidence(mesh);
  std::vector<NodeGraph> part(static_cast<std::size_t>(threads));
  on_threads(threads,
             [&](int t) { part[t] = share_of_graph(mesh, coordinates, incidence, part_of(nodes, t, threads)); });
  NodeGraph graph = std::move(part[0]);
  graph.nodes = nodes;
  for (std::size_t t = 1; t < part.size(); ++t) {
    const int offset = graph.begin.back();
    for (std::size_t n = 1; n < part[t].begin.size(); ++n) graph.begin.push_back(offset + part[t].begin[n]);
    graph.neighbour.insert(graph.neighbour.end(), part[t].neighbour.begin(), part[t].neighbour.end());
    graph.shift.insert(graph.shift.end(), part[t].shift.begin(), part[t].shift.end());
  }
  return graph;
}

/// Pattern of the rows of the graph's nodes, with values 0. Row c of a node omits the first c columns of the node
/// itself.
SymmetricPair empty_pair(const Coordinates& coordinates, const NodeGraph& graph) {
  SymmetricPair pair;
  long entries = 0;
  const auto size = [&](int n) { return coordinates.rotates(n) ? 6 : 3; };
  const int first = coordinates.first[graph.nodes.first], end = coordinates.first[graph.nodes.end];
  for (int i = first; i < end; ++i) {
    const int last = graph.begin[coordinates.node[i] - graph.nodes.first + 1] - 1;
    entries += graph.shift[last] + size(graph.neighbour[last]) - coordinates.component[i];
    check_entry_count(entries);
    pair.begin.push_back(static_cast<int>(entries));
  }
  pair.column.resize(static_cast<std::size_t>(entries));
  pair.S.resize(static_cast<std::size_t>(entries));
  pair.M.resize(static_cast<std::size_t>(entries));
  for (int i = first; i < end; ++i) {
    const int n = coordinates.node[i];
    int k = pair.begin[i - first];
    for (int p = graph.begin[n - graph.nodes.first]; p < graph.begin[n - graph.nodes.first + 1]; ++p) {
      const int m = graph.neighbour[p];
      for (int c = m == n ? coordinates.component[i] : 0; c < size(m); ++c) pair.column[k++] = coordinates.of(m, c);
    }
  }
  return pair;
}

void compute(const Mesh& mesh, int element, ElementMatrices& out) {
  with_element(mesh, element, [&](const auto& kind) { element_matrices(mesh, kind, out); });
}

/// Rows of S and M of some nodes during the summation.
struct Rows {
  const Mesh& mesh;
  const Coordinates& coordinates;
  Share nodes;
  int threads = 1;
  NodeGraph graph = find_graph(mesh, coordinates, nodes, threads);
  SymmetricPair pair = empty_pair(coordinates, graph);

  void add(const ElementNodes& of, const ElementMatrices& element, Share share);
  void add_elements(Share share, const std::function<void(double)>& done);
  void add_masses();
};

/// Adds the contribution of an element to the rows of the nodes of `share`.
void Rows::add(const ElementNodes& of, const ElementMatrices& element, Share share) {
  const int size = static_cast<int>(element.S.rows()) / of.count;
  const int first_row = coordinates.first[graph.nodes.first];
  for (int i = 0; i < of.count; ++i) {
    const int a = of.node[i];
    if (a < share.first || a >= share.end) continue;
    const auto row = graph.neighbour.begin() + graph.begin[a - graph.nodes.first],
               row_end = graph.neighbour.begin() + graph.begin[a - graph.nodes.first + 1];
    for (int j = 0; j < of.count; ++j) {
      const int b = of.node[j];
      if (b < a) continue;
      const int shift = graph.shift[std::lower_bound(row, row_end, b) - graph.neighbour.begin()];
      for (int c = 0; c < size; ++c) {
        const int first = a == b ? c : 0;
        const int at = pair.begin[coordinates.of(a, c) - first_row] - c + shift;
        for (int d = first; d < size; ++d) {
          pair.S[at + d] += element.S(size * j + d, size * i + c);
          pair.M[at + d] += element.M(size * j + d, size * i + c);
        }
      }
    }
  }
}

/// Numbers of the elements that have a node among these, ascending.
std::vector<int> elements_at(const Mesh& mesh, Share nodes) {
  std::vector<int> elements;
  for (int e = 0; e < mesh.elements(); ++e) {
    const ElementNodes of = element_nodes(mesh, e);
    if (std::any_of(of.begin(), of.end(), [&](int n) { return n >= nodes.first && n < nodes.end; }))
      elements.push_back(e);
  }
  return elements;
}

/// Adds the elements to the rows of the nodes of `share`.
void Rows::add_elements(Share share, const std::function<void(double)>& done) {
  const std::vector<int> elements = elements_at(mesh, share);
  const int total = count_of(elements);
  std::vector<ElementMatrices> batch(static_cast<std::size_t>(std::min(batch_size, total)));
  for (int first = 0; first < total; first += batch_size) {
    const int count = std::min(batch_size, total - first);
    on_threads(threads, [&](int t) {
      const Share batched = share_of(count, t, threads);
      for (int k = batched.first; k < batched.end; ++k) compute(mesh, elements[first + k], batch[k]);
    });
    on_threads(threads, [&](int t) {
      const Share part = part_of(share, t, threads);
      for (int k = 0; k < count; ++k) add(element_nodes(mesh, elements[first + k]), batch[k], part);
    });
    done(static_cast<double>(first + count) / total);
  }
}

void Rows::add_masses() {
  for (const NodalMass& mass : mesh.masses) {
    const Eigen::Matrix<double, 6, 6> M = nodal_mass_matrix(mass);
    const int size = coordinates.rotates(mass.node) ? 6 : 3;
    for (int c = 0; c < size; ++c)
      for (int d = c; d < size; ++d) pair.M[pair.begin[coordinates.of(mass.node, c)] + d - c] += M(c, d);
  }
}

/// Hash value of a mesh, by which ranks verify that all have made the same mesh.
int fingerprint(const Mesh& mesh) {
  std::size_t hash = std::hash<std::string_view>()({reinterpret_cast<const char*>(mesh.position.data()),
                                                    sizeof(double) * static_cast<std::size_t>(mesh.position.size())});
  for (int e = 0; e < mesh.elements(); ++e)
    for (const int n : element_nodes(mesh, e)) hash = 31 * hash + static_cast<std::size_t>(n);
  return static_cast<int>(hash >> 33);
}

/// Adds elements on all ranks: each adds those of its own nodes, and the leader collects the rows.
void add_by_ranks(const std::function<void(double)>& share, Rows& all) {
  const int nodes = all.mesh.nodes();
  call_followers({Task::assemble, 0, fingerprint(all.mesh)});
  all_or_none([&] {
    all.add_elements(share_of(nodes, 0, rank_count()), share);
    for (int r = 1; r < rank_count(); ++r) {
      const Share part = share_of(nodes, r, rank_count());
      const std::vector<int>& row = all.coordinates.first;
      const int first = all.pair.begin[row[part.first]], end = all.pair.begin[row[part.end]];
      for (std::vector<double>* const values : {&all.pair.S, &all.pair.M})
        receive_from(r, values->data() + first, static_cast<std::size_t>(end - first));
    }
  });
}

}  // namespace

SymmetricPair assemble(const Mesh& mesh, const Coordinates& coordinates, int threads,
                       const std::function<void(double)>& share) {
  Rows all{mesh, coordinates, {0, mesh.nodes()}, threads};
  if (rank_count() > 1 && coordinates.count() >= fewest_shared_rows)
    add_by_ranks(share, all);
  else
    all.add_elements(all.nodes, share);
  all.add_masses();
  return std::move(all.pair);
}

void help_to_assemble(const Mesh& mesh, int leaders_fingerprint) {
  if (fingerprint(mesh) != leaders_fingerprint)
    throw Error("this process made a mesh that differs from the mesh of the first process", "assembly",
                "start all processes on machines of the same kind, with the same files and programs");
  const Coordinates coordinates = number_coordinates(mesh);
  const Share nodes = share_of(mesh.nodes(), rank_number(), rank_count());
  Rows rows{mesh, coordinates, nodes, core_count()};
  rows.add_elements(nodes, [](double /*done*/) {});
  send_to_leader(rows.pair.S.data(), rows.pair.S.size());
  send_to_leader(rows.pair.M.data(), rows.pair.M.size());
}

}  // namespace tisserand::reducer
