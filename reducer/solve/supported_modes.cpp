// Eigenpairs, their basis, their effective masses.
#include "reducer/solve/supported_modes.hpp"

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/modes/full_model.hpp"
#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {
namespace {

[[noreturn]] void fail_count(int asked, int available, const std::string& where) {
  throw Error(fmt::format("{} modes asked for, but only {} exist", asked, available), where,
              "ask for fewer, or use more elements");
}

Spectrum lowest(const Supported& s, int count, int available, const formats::ModeSelection& asked,
                const std::function<void(double)>& share) {
  return lowest_pairs({s.S, s.M, s.factor, 0.0, share}, count, available,
                      choose_solver(s.partition.n_I(), count, asked), Count::if_cheap);
}

/// Elastic ones of the free part; a first eigenvalue on six held coordinates lies below them and gives their scale.
void free_modes(const System& system, const Supported& s, int count, int available,
                const formats::ModeSelection& asked, const std::string& where,
                const std::function<void(double)>& share, SupportedModes& modes) {
  const double scale = lowest(s, 1, available, asked, [](double /*done*/) {}).pairs.value[0];
  const std::optional<FreeModes> pairs = full_free_modes(
      system, {.scale = scale, .count = count, .finite = available}, asked, Count::if_cheap, share);
  if (!pairs)
    throw Error("some rigid motion of the part moves no mass, so it has no free modes", where,
                "give supports, or inertia about every axis");
  if (pairs->value.size() < count) fail_count(count, static_cast<int>(pairs->value.size()), where);
  modes.rigid = 6;
  modes.lambda = pairs->value;
  modes.q = pairs->vector;
  modes.solver = pairs->solver;
}

void held_modes(const System& system, const Supported& s, int count, int available,
                const formats::ModeSelection& asked, const std::function<void(double)>& share, SupportedModes& modes) {
  const Spectrum spectrum = lowest(s, count, available, asked, share);
  modes.lambda = spectrum.pairs.value.head(spectrum.kept);
  modes.q.setZero(system.size(), spectrum.kept);
  modes.q(s.partition.internal, Eigen::all) = spectrum.pairs.vector.leftCols(spectrum.kept);
  modes.counted = spectrum.counted;
  modes.solver = report_of(spectrum);
}

}  // namespace

SupportedModes supported_modes(const Mesh& mesh, const System& system, const Supported& s, int count,
                               const formats::ModeSelection& asked, const std::string& where,
                               const std::function<void(double)>& share) {
  const int available = finite_mode_count(s.M);
  if (count > available) fail_count(count, available, where);
  SupportedModes modes;
  if (s.is_free)
    free_modes(system, s, count, available, asked, where, share, modes);
  else
    held_modes(system, s, count, available, asked, share, modes);
  Partition all;
  for (int q = 0; q < system.size(); ++q) all.internal.push_back(q);
  const Blocks none;
  fix_basis({mesh, system, all, none, s.factor, where}, modes.lambda, modes.q);
  const Eigen::MatrixXd MR = rigid_momenta_about(system, full_rigid_properties(system).center_of_mass);
  modes.effective = (MR.transpose() * modes.q).array().square().matrix();
  return modes;
}

}  // namespace tisserand::reducer
