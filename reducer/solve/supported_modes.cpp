// SPDX-License-Identifier: GPL-3.0-or-later
// Eigenpairs of the supported part, their basis and effective masses.
#include "reducer/solve/supported_modes.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/modes/full_model.hpp"
#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {
namespace {

[[noreturn]] void fail_count(int asked, int available, const std::string& where) {
  throw Error(fmt::format("{} modes asked for, but only {} exist", asked, available), where,
              "ask for fewer modes, or use more elements");
}

Spectrum lowest(const Supported& s, int count, int available, const formats::ModeSelection& asked,
                const std::function<void(double)>& share) {
  return lowest_pairs({s.S, s.M, s.factor, 0.0, share}, count, available,
                      choose_solver(s.partition.n_I(), count, asked), Count::if_cheap);
}

/// Elastic modes of the free part. The first eigenvalue with six held coordinates is below them and gives their scale.
SupportedModes free_modes(const Supported& s, int count, int available, const formats::ModeSelection& asked,
                          const std::function<void(double)>& share) {
  const double scale = lowest(s, 1, available, asked, [](double /*done*/) {}).pairs.value[0];
  const std::optional<FreeModes> pairs =
      full_free_modes(s.system, {.scale = scale, .count = count, .finite = available}, asked, Count::if_cheap, share);
  if (!pairs)
    throw Error("the mass or inertia of a rigid motion is zero, so the part has no free modes", s.where,
                "add supports, or give the part inertia about every axis");
  if (pairs->value.size() < count) fail_count(count, count_of(pairs->value), s.where);
  return {6, pairs->value, pairs->vector, {}, {}, pairs->solver};
}

SupportedModes held_modes(const Supported& s, int count, int available, const formats::ModeSelection& asked,
                          const std::function<void(double)>& share) {
  const Spectrum spectrum = lowest(s, count, available, asked, share);
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(s.system.size(), spectrum.kept);
  q(s.partition.internal, Eigen::all) = spectrum.pairs.vector.leftCols(spectrum.kept);
  return {0, spectrum.pairs.value.head(spectrum.kept), std::move(q), {}, spectrum.counted, report_of(spectrum)};
}

}  // namespace

SupportedModes supported_modes(const Supported& s, int count, const formats::ModeSelection& asked,
                               const std::function<void(double)>& share) {
  const int available = finite_mode_count(s.M);
  if (count > available) fail_count(count, available, s.where);
  SupportedModes modes =
      s.is_free ? free_modes(s, count, available, asked, share) : held_modes(s, count, available, asked, share);
  Partition all;
  for (int q = 0; q < s.system.size(); ++q) all.internal.push_back(q);
  const Blocks none;
  fix_basis({{s.mesh, s.system, all}, none, s.factor, s.where}, modes.lambda, modes.q);
  const Eigen::MatrixXd MR = rigid_momenta_about(s.system, full_rigid_properties(s.system).center_of_mass);
  modes.effective = (MR.transpose() * modes.q).array().square().matrix();
  return modes;
}

}  // namespace tisserand::reducer
