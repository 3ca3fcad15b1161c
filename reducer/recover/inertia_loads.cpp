// SPDX-License-Identifier: GPL-3.0-or-later
// Loads on the omitted part of the deformation, from the motion of the floating frame.
#include "reducer/recover/inertia_loads.hpp"

#include <algorithm>

#include "formats/recovery/load_factors.hpp"
#include "reducer/recover/stresses.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double no_share = 1e-9;  ///< share of loads in a mode that is only round-off

/// d²f/dt² by three successive instants at possibly unequal distances; zero for fewer than three.
MatrixXd second_rates(const MatrixXd& f, const std::vector<double>& time) {
  MatrixXd rates = MatrixXd::Zero(f.rows(), f.cols());
  if (f.cols() < 3) return rates;
  for (Index t = 1; t + 1 < f.cols(); ++t) {
    const double before = time[t] - time[t - 1], after = time[t + 1] - time[t];
    if (!(before > 0.0 && after > 0.0)) continue;
    rates.col(t) = 2.0 / (before + after) * ((f.col(t + 1) - f.col(t)) / after - (f.col(t) - f.col(t - 1)) / before);
  }
  rates.col(0) = rates.col(1);
  rates.col(f.cols() - 1) = rates.col(f.cols() - 2);
  return rates;
}

/// Raises `largest` to the von Mises stresses (beams: normal) of a block, whose instants are the loads.
void raise_largest(const formats::Recovery& r, const BodyMotion& unit, const FieldBlock& block, VectorXd& largest) {
  for (Index i = 0; i < block.count; ++i)
    for (Index t = 0; t < block.values.cols(); ++t) {
      Measures measures;
      if (block.field == formats::RecoveryField::beam_force)
        measures = beam_measures(r, block.first + static_cast<int>(i), block.item<12>(i, t), unit.stress_factor());
      else if (block.field == formats::RecoveryField::shell_stress)
        measures = shell_measures(block.item<6>(i, t));
      else if (block.field == formats::RecoveryField::solid_stress)
        measures.von_mises.value = static_cast<float>(von_mises(block.item<6>(i, t).cast<double>()));
      largest[t] = std::max(largest[t], static_cast<double>(measures.von_mises.value));
    }
}

/// Largest stress of the mesh under each load with factor 1.
VectorXd stress_of_loads(const formats::RecoveryReader& file, const BodyMotion& still) {
  BodyMotion unit = still;
  const Index columns = file.recovery().loads->columns();
  unit.y = unit.y_strain = MatrixXd::Zero(file.recovery().coordinates(), columns);
  unit.load_factor = MatrixXd::Identity(columns, columns);
  unit.second_order.resize(0, columns);
  unit.mirror.setOnes();
  VectorXd largest = VectorXd::Zero(columns);
  for_field_blocks(file, unit, [&](const FieldBlock& block) { raise_largest(file.recovery(), unit, block, largest); });
  return largest;
}

/// ω² of the lowest omitted mode: that of the file, or of the modes that the body of the scene dropped.
double lowest_left_out(const formats::Recovery& recovery, const MotionReader& motion) {
  double lowest = recovery.loads->left_out;
  for (const Index k : motion.dropped())
    if (const double stiffness = recovery.loads->stiffness[k]; lowest == 0.0 || stiffness < lowest) lowest = stiffness;
  return lowest;
}

}  // namespace

bool may_have_loads(const formats::Recovery& recovery, std::vector<std::string>& notes) {
  if (recovery.loads) return true;
  notes.push_back(
      "the recovery file has no static answers to inertia loads, so stress that the modes omit is not added. Reduce "
      "the part again with `recovery: yes`, but not with method: macneal, which has no static answers.");
  return false;
}

std::string unknown_loads_note() {
  return "the results do not hold the acceleration of the floating frame, so stress that the modes omit is not added. "
         "They were written before version 1.10 (modal bodies: 1.11), without these channels, or by an analysis "
         "without accelerations. Run the scene again with these channels.";
}

void add_load_factors(const formats::Recovery& recovery, const formats::ResultsReader& results,
                      const std::vector<std::size_t>& rows, const BodyRow& body, BodyMotion& motion) {
  const formats::LoadFactors loads = formats::load_factors(
      recovery, results, rows, {body.row, motion.mirror, motion.origin, motion.to_scene, body.is_modal});
  if (!loads.known()) return;
  motion.load_factor = loads.factor;
  motion.spin_squared = loads.spin_squared;
}

VectorXd reach_of_loads(const formats::Recovery& recovery, const BodyMotion& motion) {
  return (recovery.loads->share.cwiseAbs() * motion.load_factor.cwiseAbs()).rowwise().maxCoeff();
}

std::vector<Index> moved_by_loads(const VectorXd& reach, const std::vector<Index>& zero) {
  std::vector<Index> moved;
  for (const Index k : zero)
    if (reach[k] > no_share * reach.maxCoeff()) moved.push_back(k);
  return moved;
}

void add_static_modes(const formats::Recovery& recovery, const std::vector<Index>& zero, BodyMotion& motion) {
  for (const Index k : zero)
    motion.y.row(k) = motion.y_strain.row(k) =
        recovery.loads->share.row(k) * motion.load_factor / recovery.loads->stiffness[k];
}

LeftOutStress left_out_stress(const formats::RecoveryReader& file, const MotionReader& reader) {
  constexpr Index around = 2;  // the second differences at both ends of a run are copies of their neighbours
  LeftOutStress stress;
  if (reader.read(0, 1).load_factor.cols() == 0) return stress;
  stress.known = true;
  const VectorXd of_load = stress_of_loads(file, reader.still());
  const double lowest = lowest_left_out(file.recovery(), reader);
  for (Index first = 0; first < reader.instants(); first += reader.batch()) {
    const Index begin = std::max<Index>(first - around, 0), end = std::min(first + reader.batch(), reader.instants());
    const BodyMotion motion = reader.read(begin, std::min(end + around, reader.instants()) - begin);
    const auto own = [&](const MatrixXd& all) { return all.middleCols(first - begin, end - first); };
    const MatrixXd size = own(motion.load_factor).cwiseAbs();
    stress.added = std::max(stress.added, (of_load.transpose() * size).maxCoeff());
    if (!(lowest > 0.0)) continue;
    std::vector<double> time = motion.time;
    for (double& t : time) t /= motion.to_scene.time;
    const MatrixXd missing = own(second_rates(motion.load_factor, time)).cwiseAbs() / lowest +
                             size * (motion.spin_squared.segment(first - begin, end - first) / lowest).asDiagonal();
    stress.remaining = std::max(stress.remaining, (of_load.transpose() * missing).maxCoeff());
  }
  return stress;
}

}  // namespace tisserand::reducer
