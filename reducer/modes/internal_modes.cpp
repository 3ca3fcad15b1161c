// SPDX-License-Identifier: GPL-3.0-or-later
// Internal modes: their number, selection and basis.
#include "reducer/modes/internal_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "common/error.hpp"
#include "reducer/modes/ritz_vectors.hpp"

namespace tisserand::reducer {
namespace {

/// Fixed numbers without simple ratios, so that x, y and z never have equal roles. Rotations ascend, so that bending in
/// x-y (translation y, rotation z) comes before bending in x-z.
const Eigen::Matrix<double, 6, 1> component_weight =
    (Eigen::Matrix<double, 6, 1>() << 1.0, 0.83, 0.67, 0.31, 0.41, 0.53).finished();

/// Fixed functions that choose the basis inside clusters, and signs. They depend on the body, not on its node numbers.
struct Gauge {
  Eigen::MatrixXd rigid;   ///< n_I x 6: (M R)_I, weighted; R about the centre of mass, rotations scaled
  Eigen::VectorXd square;  ///< coordinates of the mesh: weights of a quadratic form
  Eigen::VectorXd linear;  ///< coordinates of the mesh: weights of a linear form
  double mass = 0.0;
};

/// Sets weights by place on the coordinates of the mesh, independent of which of them ties made dependent.
void set_place_weights(const InternalProblem& problem, const Eigen::Vector3d& center, Gauge& gauge) {
  const System& system = problem.system;
  gauge.square.resize(system.coordinates.count());
  gauge.linear.resize(system.coordinates.count());
  for (int x = 0; x < system.coordinates.count(); ++x) {
    const Eigen::Vector3d X = (problem.mesh.position.col(system.coordinates.node[x]) - center) / system.length;
    const int component = system.coordinates.component[x];
    const double place = X.dot(Eigen::Vector3d(0.9, 0.7, 0.5));  // exp has all powers: no symmetry hides a mode
    gauge.square[x] = system.mesh_mass[x] * component_weight[component] * std::exp(place);
    gauge.linear[x] = gauge.square[x] * (component < 3 ? 1.0 : 1.0 / system.length);
  }
}

Gauge make_gauge(const InternalProblem& problem) {
  const System& system = problem.system;
  const Partition& p = problem.partition;
  Gauge gauge;
  const Eigen::MatrixXd rigid_mass =
      rigid_motions_about(system, system.middle).transpose() * rigid_momenta_about(system, system.middle);
  gauge.mass = rigid_mass(0, 0);
  const Eigen::Matrix3d first = rigid_mass.topRightCorner<3, 3>() / gauge.mass;  // −skew(center − middle)
  const Eigen::Vector3d center = system.middle + Eigen::Vector3d(first(1, 2), first(2, 0), first(0, 1));
  Eigen::MatrixXd MR = rigid_momenta_about(system, center);
  MR.rightCols<3>() /= system.length;
  gauge.rigid = rows(MR, p.internal) * component_weight.asDiagonal();
  set_place_weights(problem, center, gauge);
  return gauge;
}

/// Motion of the mesh's coordinates for motions `Phi` of the inside with the boundary held.
Eigen::MatrixXd mesh_motion(const InternalProblem& problem, const Eigen::MatrixXd& Phi) {
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(problem.system.size(), Phi.cols());
  q(problem.partition.internal, Eigen::all) = Phi;
  return expand(problem.system.T, q).topRows(problem.system.coordinates.count());
}

/// Orthogonal basis (k x k) that diagonalises `form`, largest value first, and these values.
std::pair<Eigen::MatrixXd, Eigen::VectorXd> descending_basis(const Eigen::MatrixXd& form) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(form);
  return {solver.eigenvectors().rowwise().reverse(), solver.eigenvalues().reverse()};
}

void rotate_cluster(const InternalProblem& problem, const Gauge& gauge, Eigen::Ref<Eigen::MatrixXd> Phi) {
  const Eigen::MatrixXd L = Phi.transpose() * gauge.rigid;
  const auto [basis, value] = descending_basis(L * L.transpose());
  Phi = (Phi * basis).eval();
  for (Eigen::Index first = 0; first < Phi.cols();) {
    Eigen::Index end = first + 1;
    while (end < Phi.cols() && value[first] - value[end] < 1e-6 * gauge.mass) ++end;
    if (end - first > 1) {
      auto equal = Phi.middleCols(first, end - first);
      const Eigen::MatrixXd moved = mesh_motion(problem, equal);
      equal = (equal * descending_basis(moved.transpose() * gauge.square.asDiagonal() * moved).first).eval();
    }
    first = end;
  }
}

/// Number whose sign a mode gets: the first of participation, place and largest entry that is not close to 0.
double decisive_number(const InternalProblem& problem, const Gauge& gauge, const Eigen::VectorXd& phi) {
  const double limit = 1e-5 * std::sqrt(gauge.mass);
  const double participation = (gauge.rigid.transpose() * phi).sum();
  if (std::abs(participation) > limit) return participation;
  const Eigen::VectorXd moved = mesh_motion(problem, phi);
  const double place = gauge.linear.dot(moved);
  if (std::abs(place) > limit) return place;
  Eigen::Index largest = 0;
  moved.cwiseAbs().maxCoeff(&largest);
  return moved[largest];
}

double eigenvalue_of(double frequency) { return std::pow(2.0 * std::numbers::pi * frequency, 2); }

Pencil pencil_of(const InternalProblem& problem) {
  return {problem.blocks.S_II, problem.blocks.M_II, problem.S_II, 0.0, problem.share, problem.begin};
}

/// ω² below which modes are requested.
double limit_of(const formats::ModeSelection& selection) {
  return eigenvalue_of(selection.cutoff ? *selection.cutoff : selection.accuracy->up_to);
}

/// Initial number of modes from the selection.
int wanted_modes(const InternalProblem& problem, const formats::ModeSelection& selection, int available) {
  if (selection.cutoff || selection.accuracy) {
    if (problem.partition.n_I() == 0) return 0;
    return std::min(available, count_below(pencil_of(problem), limit_of(selection)));
  }
  if (selection.count <= available) return selection.count;
  throw Error(fmt::format("{} internal modes asked for, but only {} exist", selection.count, available),
              selection.where.empty() ? problem.where : selection.where,
              fmt::format("ask for at most {} modes, or use more elements{}", available,
                          available < problem.partition.n_I() ? " or masses with rotary inertia" : ""));
}

/// Lowest pairs and their coupling to the boundary, before their basis is fixed.
struct Candidates {
  Spectrum spectrum;
  Eigen::MatrixXd coupling;  ///< n_B x pairs
  int available = 0;         ///< total number of finite eigenvalues
  int kept = 0;              ///< number of kept modes
  int moments = 0;           ///< number of moment vectors in addition
};

/// G of LeftOut if these pairs are kept.
Eigen::MatrixXd dropped_flexibility(const BoundaryModes& boundary, const Eigen::MatrixXd& coupling,
                                    const Eigen::VectorXd& lambda) {
  return boundary.flexibility - coupling * lambda.cwiseInverse().asDiagonal() * coupling.transpose();
}

/// Lower bound of the omitted eigenvalues whose modes move the boundary, if the first `kept` are kept. Other modes,
/// such as those of a cylinder between two rings, do not affect the bodies attached to it.
double first_coupled(const BoundaryModes& boundary, const Candidates& c, Eigen::Index kept, double lambda) {
  constexpr double negligible = 1e-10;  ///< share of a mode's mass
  const Eigen::VectorXd& all = c.spectrum.pairs.value;
  const Eigen::VectorXd value = all.head(kept);
  const Eigen::MatrixXd L = c.coupling.leftCols(kept);
  const Eigen::VectorXd share =
      boundary_shares({boundary.S, boundary.M, value, L}, lambda, c.coupling.rightCols(c.coupling.cols() - kept));
  Eigen::Index first = kept;
  while (first < all.size() && all[first] > lambda && share[first - kept] < negligible) ++first;
  return first < all.size() ? all[first] : least_dropped(all, all.size(), c.available);
}

/// Bound of the error up to the frequency of `accuracy` with the first `kept` candidates and no other vectors.
double error_with(const BoundaryModes& boundary, const Candidates& c, int kept, const formats::Accuracy& accuracy) {
  const Eigen::VectorXd value = c.spectrum.pairs.value.head(kept);
  const Eigen::MatrixXd L = c.coupling.leftCols(kept);
  const double lambda = eigenvalue_of(accuracy.up_to);
  LeftOut out;
  out.first_dropped = least_dropped(c.spectrum.pairs.value, kept, c.available);
  out.G = dropped_flexibility(boundary, L, value);
  out.coupling.resize(L.rows(), 0);
  return attached_error({boundary.S, boundary.M, value, L}, out, first_coupled(boundary, c, kept, lambda), lambda);
}

/// Least number in [least, most] that meets the accuracy; −1 if `most` does not.
template <class Meets>
int fewest(int least, int most, const Meets& meets) {
  int fails = least - 1, good = most;
  if (!meets(good)) return -1;
  while (good - fails > 1) {
    const int middle = fails + (good - fails) / 2;
    (meets(middle) ? good : fails) = middle;
  }
  return good;
}

/// Least number of moment vectors that meets the accuracy with the first `kept` candidates; −1 if all of them do not.
int moments_for(const InternalProblem& problem, const BoundaryModes& boundary, const Candidates& c, int kept,
                const formats::Accuracy& accuracy) {
  const Eigen::VectorXd &all = c.spectrum.pairs.value, value = all.head(kept);
  const Eigen::MatrixXd L = c.coupling.leftCols(kept);
  const Eigen::MatrixXd G = dropped_flexibility(boundary, L, value);
  const MomentSpace moments =
      moment_space(problem, boundary, c.spectrum.pairs.vector.leftCols(kept), G, eigenvalue_of(accuracy.up_to));
  const double dropped = least_dropped(all, kept, c.available), lambda = eigenvalue_of(accuracy.up_to);
  const double coupled = first_coupled(boundary, c, kept, lambda);
  const RitzSpace& space = moments.space;
  const int count = fewest(0, count_of(space), [&](int p) {
    const LeftOut out = space.left_out(space.values(p), G, dropped);
    return attached_error({boundary.S, boundary.M, value, L}, out, coupled, lambda) <= accuracy.error;
  });
  return count < 0 ? count : static_cast<int>(moments.whole(count));
}

/// Chooses the option with fewer coordinates: more of the pairs, or the `least` pairs and moment vectors. Returns
/// success.
bool meets_accuracy(const InternalProblem& problem, const BoundaryModes& boundary,
                    const formats::ModeSelection& selection, int least, Candidates& c) {
  const formats::Accuracy& accuracy = *selection.accuracy;
  const auto whole = [&](int kept) { return kept == 0 ? 0 : cluster_end(c.spectrum.pairs.value, kept, 0.0); };
  const int enough = fewest(least, c.spectrum.kept,
                            [&](int kept) { return error_with(boundary, c, kept, accuracy) <= accuracy.error; });
  const int lowest = whole(least);
  const bool by_modes = selection.moments && *selection.moments == 0;
  const int moments = by_modes || enough == least ? -1 : moments_for(problem, boundary, c, lowest, accuracy);
  if (enough < 0 && moments < 0) return false;
  const bool modes_are_fewer = moments < 0 || (enough >= 0 && whole(enough) <= lowest + moments);
  c.kept = modes_are_fewer ? whole(enough) : lowest;
  c.moments = modes_are_fewer ? 0 : moments;
  return true;
}

/// Whether no kept mode is missing. If the kept modes are those below the frequency of the accuracy, the first count
/// `below` shows it, otherwise one more, which is noted.
bool none_missing(const Pencil& pencil, const formats::ModeSelection& selection, int below, Candidates& c) {
  std::optional<int>& counted = c.spectrum.counted;
  if (counted) return true;
  const Eigen::VectorXd& value = c.spectrum.pairs.value;
  const double limit = limit_of(selection);
  const bool all_below =
      c.kept == below && (below == 0 || value[below - 1] < limit) && (below == value.size() || value[below] >= limit);
  const int count = all_below || c.kept == 0 ? below : count_kept(pencil, c.spectrum.pairs, c.kept);
  if (count == c.kept) counted = count;
  return count == c.kept;
}

/// Computes more and more pairs until they meet the accuracy.
Candidates candidates_for(const InternalProblem& problem, const BoundaryModes& boundary,
                          const formats::ModeSelection& selection, int least, int available) {
  constexpr int most = 1000;
  const Pencil pencil = pencil_of(problem);
  const int below = least;
  const auto n_I = static_cast<Eigen::Index>(problem.partition.n_I());
  Count verify = Count::if_cheap;
  for (int sought = least + 4;; sought = 2 * sought) {
    sought = std::min(sought, available);
    problem.seek(sought);
    Candidates c;
    c.available = available;
    c.spectrum = lowest_pairs(pencil, sought, available, choose_solver(n_I, sought, selection), verify);
    c.coupling = mass_coupling(problem.blocks, boundary, c.spectrum.pairs.vector);
    if (meets_accuracy(problem, boundary, selection, least, c)) {
      if (none_missing(pencil, selection, below, c)) return c;
      verify = Count::always;  // searches for the missing modes
      sought = (sought + 1) / 2;
      continue;
    }
    if (2 * sought > most || c.spectrum.kept == available)
      throw Error(fmt::format("the accuracy of {:g} up to the frequency {:g} is not reached: {} internal modes leave "
                              "an error of {:.2g}",
                              selection.accuracy->error, selection.accuracy->up_to, c.spectrum.kept,
                              error_with(boundary, c, c.spectrum.kept, *selection.accuracy)),
                  selection.where, "request a larger error or a lower frequency");
    least = std::max(least, sought / 2);  // moment vectors with more modes, too
  }
}

/// Adds the leading `count` moment vectors after the modes, fewer if there are no more.
void add_moment_vectors(const InternalProblem& problem, const BoundaryModes& boundary, int count, double lambda,
                        InternalModes& modes) {
  const MomentSpace moments = moment_space(problem, boundary, modes.Phi, modes.left_out.G, lambda);
  const Eigen::Index m = modes.lambda.size(), p = moments.whole(std::min<Eigen::Index>(count, moments.order.size()));
  const RitzSpace::Values values = moments.space.values(p);
  modes.moments = static_cast<int>(p);
  modes.left_out = moments.space.left_out(values, modes.left_out.G, modes.left_out.first_dropped);
  modes.lambda.conservativeResize(m + p);
  modes.lambda.tail(p) = values.theta;
  modes.Phi.conservativeResize(Eigen::NoChange, m + p);
  modes.Phi.rightCols(p) = moments.space.vectors(values);
}

/// Spectrum for a selection. The count for a cut-off also verifies the search, unless the search found too few.
Spectrum spectrum_for(const Pencil& pencil, const formats::ModeSelection& selection, Eigen::Index n_I, int sought,
                      int available) {
  const EigenSolver solver = choose_solver(n_I, sought, selection);
  if (!selection.cutoff) return lowest_pairs(pencil, sought, available, solver, Count::if_cheap);
  Spectrum spectrum = lowest_pairs(pencil, sought, available, solver, Count::never);
  if (spectrum.pairs.value[sought - 1] >= eigenvalue_of(*selection.cutoff))
    return lowest_pairs(pencil, sought, available, solver, Count::always);
  spectrum.counted = spectrum.kept;
  return spectrum;
}

}  // namespace

void fail_low_cutoff(const formats::ModeSelection& selection, const char* kind, double lowest) {
  throw Error(fmt::format("cutoff {:g} is below the first {} mode ({:.4g}), so no mode would be kept",
                          *selection.cutoff, kind, std::sqrt(std::max(0.0, lowest)) / (2.0 * std::numbers::pi)),
              selection.where, "increase `cutoff`, or write `modes: 0` in its place if you need no modes");
}

int finite_mode_count(const Matrix& M) {
  constexpr Eigen::Index factored = 20000;
  constexpr double null_pivot = 1e-10, clearly_definite = 1e-8;
  const Eigen::VectorXd mass = diagonal(M);
  const auto with_mass = static_cast<int>((mass.array() > 0.0).count());
  if (with_mass == 0 || mass.size() > factored) return with_mass;
  const Eigen::VectorXd scale = (mass.array() > 0.0).select(mass.cwiseMax(1e-300).cwiseSqrt().cwiseInverse(), 1.0);
  const Matrix unit = scaled(M, scale);
  if (Cholesky(symmetric_rows(unit)).factor() > clearly_definite) return M.size();
  return M.size() - Factor::indefinite(unit, null_pivot).null();
}

double least_dropped(const Eigen::VectorXd& value, Eigen::Index kept, Eigen::Index available) {
  if (kept < value.size()) return value[kept];
  return kept < available ? value[kept - 1] : std::numeric_limits<double>::infinity();
}

void fix_basis(const InternalProblem& problem, Eigen::VectorXd& lambda, Eigen::MatrixXd& Phi) {
  if (lambda.size() == 0) return;
  const Gauge gauge = make_gauge(problem);
  for (int first = 0; first < lambda.size();) {
    const int end = cluster_end(lambda, first + 1, 0.0);
    if (end - first > 1) {
      rotate_cluster(problem, gauge, Phi.middleCols(first, end - first));
      lambda.segment(first, end - first).setConstant(lambda.segment(first, end - first).mean());
    }
    for (int k = first; k < end; ++k)
      if (decisive_number(problem, gauge, Phi.col(k)) < 0.0) Phi.col(k) = -Phi.col(k);
    first = end;
  }
}

InternalModes internal_modes(const InternalProblem& problem, const BoundaryModes& boundary,
                             const formats::ModeSelection& selection) {
  if (selection.method != formats::ReductionMethod::craig_bampton)
    return free_boundary_vectors(problem, boundary, selection);
  InternalModes modes;
  const Eigen::Index n_I = problem.partition.n_I();
  modes.available = n_I > 0 ? finite_mode_count(problem.blocks.M_II) : 0;
  modes.requested = wanted_modes(problem, selection, modes.available);
  modes.Phi.resize(n_I, 0);
  modes.coupling.resize(boundary.Psi.cols(), 0);
  modes.left_out.G = boundary.flexibility;
  if (modes.available == 0) return modes;
  Spectrum spectrum;
  int kept = 0, moments = selection.moments.value_or(0);
  if (selection.accuracy) {
    Candidates c = candidates_for(problem, boundary, selection, modes.requested, modes.available);
    spectrum = std::move(c.spectrum);
    modes.requested = kept = c.kept;
    moments = c.moments;
  } else {
    problem.seek(std::max(1, modes.requested));
    spectrum = spectrum_for(pencil_of(problem), selection, n_I, std::max(1, modes.requested), modes.available);
    if (selection.cutoff && modes.requested == 0) fail_low_cutoff(selection, "internal", spectrum.pairs.value[0]);
    kept = modes.requested == 0 ? 0 : spectrum.kept;
  }
  modes.solver = report_of(spectrum);
  if (spectrum.counted) modes.counted = std::min(*spectrum.counted, kept);
  if (kept < spectrum.pairs.value.size()) modes.first_dropped = spectrum.pairs.value[kept];
  modes.lambda = spectrum.pairs.value.head(kept);
  modes.Phi = spectrum.pairs.vector.leftCols(kept);
  modes.coupling = mass_coupling(problem.blocks, boundary, modes.Phi);
  modes.left_out.G = dropped_flexibility(boundary, modes.coupling, modes.lambda);
  modes.left_out.first_dropped = least_dropped(spectrum.pairs.value, kept, modes.available);
  if (moments > 0 && kept < modes.available) {
    const double lambda = selection.accuracy ? eigenvalue_of(selection.accuracy->up_to) : modes.left_out.first_dropped;
    add_moment_vectors(problem, boundary, moments, lambda, modes);
  }
  fix_basis(problem, modes.lambda, modes.Phi);
  modes.coupling = mass_coupling(problem.blocks, boundary, modes.Phi);
  return modes;
}

}  // namespace tisserand::reducer
