// SPDX-License-Identifier: GPL-3.0-or-later
// Geometric stiffness: elements, then ties and offset masses, in the pattern of the stiffness.
#include "reducer/second_order/geometric_stiffness.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "common/parallel.hpp"
#include "common/text.hpp"
#include "formats/sections/monosymmetry.hpp"
#include "reducer/elements/each_element.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/second_order.hpp"
#include "reducer/second_order/inertia.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t most_averaged = 3000;  ///< coordinates of an average, whose block is dense

/// A symmetric block and the free coordinates of its rows.
struct FreeBlock {
  std::vector<int> row;
  MatrixXd K;
};

/// Converts gradients for coordinates x of the mesh to blocks over free coordinates.
class FreeBlocks {
 public:
  explicit FreeBlocks(const StressedPart& part) : T_(part.system.T), place_(static_cast<std::size_t>(T_.independent)) {
    std::ranges::fill(place_, -1);
    for (int i = 0; i < std::ssize(part.free); ++i) place_[part.free[i]] = i;
  }

  /// K_g of stresses σ; `gradient` has a column for each of `x`.
  FreeBlock block(const std::vector<int>& x, const std::vector<StrainSection>& sections, const MatrixXd& gradient,
                  const VectorXd& sigma) const {
    std::map<int, Index> column;
    for (const int one : x) for_each_term(one, [&](int free, double /*coefficient*/) { column.try_emplace(free, 0); });
    FreeBlock result;
    for (auto& [free, at] : column) {
      at = static_cast<Index>(result.row.size());
      result.row.push_back(free);
    }
    MatrixXd moved = MatrixXd::Zero(gradient.rows(), static_cast<Index>(result.row.size()));
    for (std::size_t k = 0; k < x.size(); ++k)
      for_each_term(x[k], [&](int free, double coefficient) {
        moved.col(column.at(free)) += coefficient * gradient.col(static_cast<Index>(k));
      });
    result.K = geometric_stiffness(sections, moved, sigma);
    return result;
  }

 private:
  template <class Use>
  void for_each_term(int x, const Use& use) const {
    const int row = T_.row[x];
    if (row >= 0) {
      if (place_[row] >= 0) use(place_[row], 1.0);
      return;
    }
    for (const Term& term : T_.dependent[-1 - row])
      if (place_[term.coordinate] >= 0) use(place_[term.coordinate], term.coefficient);
  }

  const Transformation& T_;
  std::vector<int> place_;  ///< row of each q; −1: held
};

/// Pattern of S with the blocks of ties added; values of S, K_g zero.
SymmetricPair widened(const SymmetricRows& S, const std::vector<FreeBlock>& blocks) {
  std::map<int, std::vector<int>> more;  // columns by row
  for (const FreeBlock& block : blocks)
    for (std::size_t a = 0; a < block.row.size(); ++a) {
      std::vector<int>& columns = more[block.row[a]];
      columns.insert(columns.end(), block.row.begin() + static_cast<std::ptrdiff_t>(a), block.row.end());
    }
  SymmetricPair pair;
  pair.begin.reserve(static_cast<std::size_t>(S.size) + 1);
  std::vector<int> columns;
  for (int i = 0; i < S.size; ++i) {
    const int* const begin = S.column + S.begin[i];
    const int* const end = S.column + S.begin[i + 1];
    columns.assign(begin, end);
    if (const auto found = more.find(i); found != more.end()) {
      columns.insert(columns.end(), found->second.begin(), found->second.end());
      std::ranges::sort(columns);
      columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    }
    const int* own = begin;
    for (const int column : columns) {
      const bool stored = own != end && *own == column;
      pair.column.push_back(column);
      pair.S.push_back(stored ? S.value[own - S.column] : 0.0);
      if (stored) ++own;
    }
    check_entry_count(static_cast<long>(pair.column.size()));
    pair.begin.push_back(count_of(pair.column));
  }
  pair.M.assign(pair.S.size(), 0.0);
  return pair;
}

/// Adds a block, whose rows ascend, to K_g.
void add_block(const FreeBlock& block, SymmetricPair& pair) {
  for (std::size_t a = 0; a < block.row.size(); ++a) {
    auto at = pair.column.begin() + pair.begin[block.row[a]];
    const auto end = pair.column.begin() + pair.begin[block.row[a] + 1];
    for (std::size_t b = a; b < block.row.size(); ++b) {
      at = std::lower_bound(at, end, block.row[b]);
      TISSERAND_ENSURE(at != end && *at == block.row[b], "no entry ({}, {})", block.row[a], block.row[b]);
      pair.M[at - pair.column.begin()] += block.K(static_cast<Index>(a), static_cast<Index>(b));
    }
  }
}

/// Adds elements by groups: all threads compute blocks, which are added in the order of the elements.
void add_elements(const StressedPart& part, const FreeBlocks& free, const MatrixXd& w,
                  const std::function<void(double)>& share, SymmetricPair& pair) {
  constexpr int at_once = 256;
  const Mesh& mesh = part.mesh;
  const int threads = core_count();
  std::vector<FreeBlock> blocks(at_once);
  for (int first = 0; first < mesh.elements(); first += at_once) {
    share(static_cast<double>(first) / mesh.elements());
    const int count = std::min(at_once, mesh.elements() - first);
    on_threads(threads, [&](int t) {
      thread_local SecondOrderRows rows;
      const Share own = share_of(count, t, threads);
      for (int e = own.first; e < own.end; ++e) {
        with_element(mesh, first + e, [&](const auto& kind) { second_order(mesh, kind, rows); });
        const ElementRows at = element_rows(mesh, part.system.coordinates, first + e, rows.stress.cols());
        MatrixXd d(rows.stress.cols(), 1);
        gather(at, w, d);
        std::vector<int> x;
        for (int i = 0; i < at.nodes; ++i)
          for (int c = 0; c < at.size; ++c) x.push_back(at.first[i] + c);
        blocks[e] = free.block(x, rows.sections, rows.gradient, rows.stress * d);
      }
    });
    for (int e = 0; e < count; ++e) add_block(blocks[e], pair);
  }
}

/// Blocks of ties under the forces that they transmit.
std::vector<FreeBlock> tie_blocks(const StressedPart& part, const FreeBlocks& free, const MatrixXd& w,
                                  const MatrixXd& g) {
  std::vector<FreeBlock> blocks;
  if (part.ties.empty()) return blocks;
  const MatrixXd residual = tie_residual(part.mesh, part.system.coordinates, part.ties, w, g);
  for (const TieForm& form : tie_forms(part.mesh, part.system, part.ties, multipliers(part.ties, residual))) {
    if (form.x.size() > most_averaged)
      throw Error(fmt::format("spider '{}' averages {} coordinates, but buckling allows at most {}",
                              part.mesh.spiders[form.spider].name, form.x.size(), most_averaged),
                  part.where, "connect the spider to fewer nodes, or make it rigid");
    blocks.push_back(free.block(form.x, form.batch.sections, form.batch.gradient, form.batch.stress.col(0)));
  }
  return blocks;
}

/// Blocks of masses with an offset under gravity, by the second order ½ θ × (θ × c) of their arms.
std::vector<FreeBlock> offset_masses(const StressedPart& part, const FreeBlocks& free, const LoadedState& state) {
  std::vector<FreeBlock> blocks;
  if (state.gravity.isZero(0.0)) return blocks;
  const Coordinates& coordinates = part.system.coordinates;
  for (const NodalMass& mass : part.mesh.masses) {
    if (mass.offset.isZero(0.0) || !coordinates.rotates(mass.node)) continue;
    std::vector<int> x;
    for (int c = 0; c < 6; ++c) x.push_back(coordinates.of(mass.node, c));
    MatrixXd gradient = MatrixXd::Zero(9, 6);
    gradient.block<3, 3>(0, 3).setIdentity();
    gradient.block<3, 3>(3, 3) = -0.5 * skew<double>(mass.offset);
    VectorXd sigma = VectorXd::Zero(6);
    sigma.head<3>() = nodal_mass_matrix(mass).topLeftCorner<3, 3>() * state.gravity;
    blocks.push_back(free.block(x, {{&turned_point(), 1}}, gradient, sigma));
  }
  return blocks;
}

}  // namespace

SymmetricPair stiffness_pair(const StressedPart& part, const LoadedState& state, const SymmetricRows& S,
                             const std::function<void(double)>& share) {
  const FreeBlocks free(part);
  const MatrixXd w = expand(part.system.T, state.q), g = state.force;
  std::vector<FreeBlock> blocks = tie_blocks(part, free, w, g);
  for (FreeBlock& block : offset_masses(part, free, state)) blocks.push_back(std::move(block));
  SymmetricPair pair = widened(S, blocks);
  add_elements(part, free, w, share, pair);
  for (const FreeBlock& block : blocks) add_block(block, pair);
  return pair;
}

std::string monosymmetry_note(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const BeamProperty& property : mesh.beam_properties) {
    const BeamElementData& data = property.data;
    formats::Section section = data.section;
    if (!data.stations.empty()) {
      section = data.stations.front();
      section.shape.clear();  // along a taper only the constants are known
    }
    if (!formats::lacks_monosymmetry(section)) continue;
    const std::string name =
        fmt::format("section '{}'{}", data.section.name, data.stations.empty() ? "" : " (tapered)");
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  if (names.empty()) return "";
  return fmt::format(
      "Wagner's beta of {} is computed from the shear centre alone, because the outline is not known. In bending, the "
      "true loads of lateral buckling differ. Define the section as a named shape, polygon or walls, without taper.",
      listed(names));
}

MatrixXd mesh_weights(const Mesh& mesh, const System& system) { return translation_loads(mesh, system.coordinates); }

}  // namespace tisserand::reducer
